// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/facings.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace weft::mesh {
namespace {

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector mm_of(Point3 p) {
  return {p.x / 1000.0, p.y / 1000.0, p.z / 1000.0};
}

/// Normal times area, mm².
Vector area_vector(Point3 a, Point3 b, Point3 c) {
  const Vector u{(double(b.x) - a.x) / 1000, (double(b.y) - a.y) / 1000, (double(b.z) - a.z) / 1000};
  const Vector v{(double(c.x) - a.x) / 1000, (double(c.y) - a.y) / 1000, (double(c.z) - a.z) / 1000};
  return {(u[1] * v[2] - u[2] * v[1]) / 2, (u[2] * v[0] - u[0] * v[2]) / 2, (u[0] * v[1] - u[1] * v[0]) / 2};
}

/// Areas by direction, those of nearly the same one together: largest first.
class Directions {
 public:
  void add(const Vector& area) {
    const double mm2 = std::sqrt(dot(area, area));
    if (mm2 <= 0) return;
    constexpr double steps = 60;  // of a degree
    auto& sum = sums_[{std::lround(area[0] / mm2 * steps), std::lround(area[1] / mm2 * steps),
                       std::lround(area[2] / mm2 * steps)}];
    for (std::size_t i = 0; i < 3; ++i) sum[i] += area[i];
  }
  std::vector<Facing> largest() const {
    std::vector<Facing> out;
    for (const auto& [key, sum] : sums_) {
      const double mm2 = std::sqrt(dot(sum, sum));
      if (mm2 > 0) out.push_back({{sum[0] / mm2, sum[1] / mm2, sum[2] / mm2}, mm2});
    }
    std::stable_sort(out.begin(), out.end(), [](const Facing& a, const Facing& b) { return a.mm2 > b.mm2; });
    return out;
  }

 private:
  std::map<std::array<long, 3>, Vector> sums_;
};

/// Adds the largest that are no neighbours of those that are there.
void add_new(const std::vector<Facing>& from, std::size_t most, std::vector<Facing>& to) {
  static const double near = std::cos(3 * std::numbers::pi / 180);
  for (const Facing& facing : from) {
    if (most == 0) return;
    if (std::any_of(to.begin(), to.end(), [&](const Facing& other) { return dot(other.down, facing.down) > near; }))
      continue;
    to.push_back(facing), --most;
  }
}

}  // namespace

std::vector<Facing> facings_of(const Mesh& mesh, const Hull& around, std::size_t hull, std::size_t flat) {
  Directions resting, flats;
  for (const auto& [a, b, c] : around.triangles)
    resting.add(area_vector(around.corners[a], around.corners[b], around.corners[c]));
  for (const auto& [a, b, c] : mesh.triangles)
    flats.add(area_vector(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]));
  std::vector<Facing> out(1);
  add_new(resting.largest(), hull, out);
  add_new(flats.largest(), flat, out);
  return out;
}

Facets::Facets(const Mesh& mesh, const Hull& around) : outmost_(around.corners) {
  facets_.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Point3 p = mesh.vertices[a], q = mesh.vertices[b], r = mesh.vertices[c];
    const Vector area = area_vector(p, q, r);
    const double mm2 = std::sqrt(dot(area, area));
    if (mm2 <= 0) continue;
    const auto third = [](Um u, Um v, Um w) { return static_cast<float>((double(u) + v + w) / 3000); };
    facets_.push_back(
        {{static_cast<float>(area[0] / mm2), static_cast<float>(area[1] / mm2), static_cast<float>(area[2] / mm2)},
         {third(p.x, q.x, r.x), third(p.y, q.y, r.y), third(p.z, q.z, r.z)},
         static_cast<float>(mm2)});
  }
}

Laid Facets::laid(const std::array<double, 3>& down, double degrees) const {
  double lowest = -1e12, highest = 1e12;  // along `down`: the lowest is furthest
  for (const Point3 p : outmost_) {
    const double at = dot(mm_of(p), down);
    lowest = std::max(lowest, at), highest = std::min(highest, at);
  }
  constexpr double on_bed_mm = 0.1;
  const double steep = std::sin(degrees * std::numbers::pi / 180);
  Laid out;
  out.height_mm = lowest - highest;
  for (const Facet& f : facets_) {
    const double leans = f.normal[0] * down[0] + f.normal[1] * down[1] + f.normal[2] * down[2];
    if (leans <= steep) continue;
    const double above = lowest - (f.centre[0] * down[0] + f.centre[1] * down[1] + f.centre[2] * down[2]);
    if (above < on_bed_mm && leans > 0.999) {
      out.foot_mm2 += f.mm2;
      continue;
    }
    out.steep_mm2 += f.mm2 * leans;
    out.steep_mm3 += f.mm2 * leans * above;
  }
  return out;
}

}  // namespace weft::mesh
