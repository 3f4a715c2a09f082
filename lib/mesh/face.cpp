// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/face.h"

#include "mesh/face_delaunay.h"

#include <cmath>
#include <numeric>

namespace weft::mesh {
namespace {

/// The face as seen along the axis that is nearest to its normal, counter-clockwise.
std::vector<Point> seen_largest(const std::vector<Point3>& corners) {
  double x = 0, y = 0, z = 0;  // Newell's normal: right for any planar face, convex or not
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    x += (static_cast<double>(a.y) - b.y) * (static_cast<double>(a.z) + b.z);
    y += (static_cast<double>(a.z) - b.z) * (static_cast<double>(a.x) + b.x);
    z += (static_cast<double>(a.x) - b.x) * (static_cast<double>(a.y) + b.y);
  }
  const double ax = std::abs(x), ay = std::abs(y), az = std::abs(z);
  std::vector<Point> seen;
  for (const Point3& p : corners) {
    if (ax > ay && ax > az)
      seen.push_back(x > 0 ? Point{p.y, p.z} : Point{p.z, p.y});
    else if (ay > az)
      seen.push_back(y > 0 ? Point{p.z, p.x} : Point{p.x, p.z});
    else
      seen.push_back(z > 0 ? Point{p.x, p.y} : Point{p.y, p.x});
  }
  return seen;
}

bool convex(const std::vector<Point>& ring) {
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i)
    if (orient(ring[i], ring[(i + 1) % n], ring[(i + 2) % n]) < 0) return false;
  return true;
}

/// Whether b, between a and c, can be cut off: it turns left, and no other corner lies in abc.
bool is_ear(const std::vector<Point>& ring, const std::vector<std::uint32_t>& left, std::size_t at) {
  const std::size_t n = left.size();
  const Point a = ring[left[(at + n - 1) % n]], b = ring[left[at]], c = ring[left[(at + 1) % n]];
  if (orient(a, b, c) <= 0) return false;
  for (std::size_t i = 2; i + 1 < n; ++i) {
    const Point p = ring[left[(at + i) % n]];
    if (p == a || p == b || p == c) continue;
    if (orient(a, b, p) >= 0 && orient(b, c, p) >= 0 && orient(c, a, p) >= 0) return false;
  }
  return true;
}

/// Corners beyond which cutting ear by ear, each of which looks at all that are left, is no longer quick.
constexpr std::size_t many_corners = 500;

}  // namespace

std::vector<Triangle> triangulated(const std::vector<Point3>& corners) {
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> left(corners.size());
  std::iota(left.begin(), left.end(), 0u);
  const auto cut = [&](std::size_t at) {
    const std::size_t n = left.size();
    triangles.push_back({left[(at + n - 1) % n], left[at], left[(at + 1) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
  };
  if (corners.size() > 3) {
    const std::vector<Point> ring = seen_largest(corners);
    const bool many = corners.size() > many_corners, round = convex(ring);
    if (many && !round)
      if (auto cut_up = triangulated_by_delaunay(ring)) return *std::move(cut_up);
    std::size_t patience = many || round ? 0 : 4 * corners.size();  // tests; each costs at most a round of the face
    for (std::size_t at = 0; patience > 0 && left.size() > 3; --patience) {
      if (is_ear(ring, left, at))
        cut(at);
      else
        ++at;
      if (at >= left.size()) at = 0;
    }
  }
  for (std::size_t i = 2; i < left.size(); ++i) triangles.push_back({left[0], left[i - 1], left[i]});
  return triangles;
}

}  // namespace weft::mesh
