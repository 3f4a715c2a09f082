// SPDX-License-Identifier: GPL-3.0-or-later
#include "contour/surface.h"

#include "core/stop.h"

#include <algorithm>
#include <cmath>

namespace weft::contour {
namespace {

/// Is the point to the left of the edge, or on it where that side of the edge owns its points? So each place of a
/// surface lies in one facet, whatever edges meet there.
bool within(Point a, Point b, Point p) {
  const auto side = orient(a, b, p);
  if (side != 0) return side > 0;
  return b.y < a.y || (b.y == a.y && b.x < a.x);
}

}  // namespace

Surface::Surface(std::span<const Mesh* const> meshes) {
  StopNowAndThen stop(4096);
  for (const Mesh* mesh : meshes)
    for (const Triangle& t : mesh->triangles) {
      stop.step();
      const Point3 a = mesh->vertices[t[0]], b = mesh->vertices[t[1]], c = mesh->vertices[t[2]];
      const auto twice = orient(flat(a), flat(b), flat(c));
      if (twice == 0) continue;  // upright
      const double x1 = b.x - a.x, y1 = b.y - a.y, z1 = b.z - a.z, x2 = c.x - a.x, y2 = c.y - a.y, z2 = c.z - a.z;
      const double area = x1 * y2 - x2 * y1, along_x = (z1 * y2 - z2 * y1) / area, along_y = (x1 * z2 - x2 * z1) / area;
      const bool up = twice > 0;
      const auto [bottom, top] = std::minmax({a.z, b.z, c.z});
      facets_.push_back({flat(a), flat(up ? b : c), flat(up ? c : b), a.z - along_x * a.x - along_y * a.y, along_x,
                         along_y, bottom, top, up});
      for (const Point3 p : {a, b, c}) box_.add(flat(p));
    }
  if (facets_.empty()) return;
  // About as many cells as facets.
  const double mm2 = static_cast<double>(box_.size().x) * box_.size().y / static_cast<double>(facets_.size());
  cell_ = std::clamp(rounded(std::sqrt(mm2)), Um{200}, Um{20'000});
  columns_ = static_cast<std::size_t>(box_.size().x / cell_) + 1,
  rows_ = static_cast<std::size_t>(box_.size().y / cell_) + 1;
  const auto cells_of = [&](const Facet& f, auto see) {
    const auto [x0, x1] = std::minmax({f.a.x, f.b.x, f.c.x});
    const auto [y0, y1] = std::minmax({f.a.y, f.b.y, f.c.y});
    const std::size_t first = cell_of(x0, y0), last = cell_of(x1, y1), width = last % columns_ - first % columns_;
    for (std::size_t row = first / columns_; row <= last / columns_; ++row)
      for (std::size_t k = 0; k <= width; ++k) see(row * columns_ + first % columns_ + k);
  };
  starts_.assign(columns_ * rows_ + 1, 0);
  for (const Facet& facet : facets_) cells_of(facet, [&](std::size_t cell) { ++starts_[cell + 1]; });
  for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  in_cell_.resize(starts_.back());
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (std::size_t i = 0; i < facets_.size(); ++i)
    cells_of(facets_[i], [&](std::size_t cell) { in_cell_[next[cell]++] = static_cast<std::uint32_t>(i); });
}

std::size_t Surface::cell_of(Um x, Um y) const {
  return static_cast<std::size_t>((y - box_.min.y) / cell_) * columns_ +
         static_cast<std::size_t>((x - box_.min.x) / cell_);
}

std::span<const std::uint32_t> Surface::facets_over(Point at) const {
  if (facets_.empty() || !box_.contains(at)) return {};
  const std::size_t cell = cell_of(at.x, at.y);
  return std::span(in_cell_).subspan(starts_[cell], starts_[cell + 1] - starts_[cell]);
}

std::optional<Surface::Height> Surface::between(Point at, double low_um, double high_um) const {
  const auto near = facets_over(at);
  // Within a body, where most beads lie, there is none: that is seen without looking at where they are.
  if (std::none_of(near.begin(), near.end(), [&](std::uint32_t i) {
        const Facet& f = facets_[i];
        return f.up && f.bottom < high_um && f.top >= low_um;
      }))
    return std::nullopt;
  struct Crossing {
    double z, slope;
    bool up;
  };
  std::vector<Crossing> found;
  for (const std::uint32_t i : near) {
    const Facet& f = facets_[i];
    if (f.top < low_um || !within(f.a, f.b, at) || !within(f.b, f.c, at) || !within(f.c, f.a, at)) continue;
    const double z = f.z0 + f.along_x * at.x + f.along_y * at.y;
    if (z >= low_um) found.push_back({z, std::hypot(f.along_x, f.along_y), f.up});
  }
  std::sort(found.begin(), found.end(), [](const Crossing& a, const Crossing& b) { return a.z > b.z; });
  int inside = 0;
  for (const Crossing& each : found) {  // from above
    if (each.up && inside == 0 && each.z < high_um) return Height{each.z, each.slope};
    inside += each.up ? 1 : -1;
  }
  return std::nullopt;
}

}  // namespace weft::contour
