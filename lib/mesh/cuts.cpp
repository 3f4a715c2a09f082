#include "mesh/cuts.h"

#include "core/stop.h"

#include <algorithm>
#include <array>

namespace weft::mesh {
namespace {

using Vector = std::array<double, 3>;

Vector between(Point3 a, Point3 b) {
  return {static_cast<double>(b.x - a.x), static_cast<double>(b.y - a.y), static_cast<double>(b.z - a.z)};
}

/// Six times the volume of a tetrahedron, µm³: > 0 when d lies behind a, b, c seen counter-clockwise. Its sign is right
/// but for what is flatter than a thousandth of a micron.
double six_volumes(Point3 a, Point3 b, Point3 c, Point3 d) {
  const Vector u = between(a, b), v = between(a, c), w = between(a, d);
  return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
}

/// Whether a segment passes through the inside of a triangle.
bool passes(Point3 p, Point3 q, Point3 a, Point3 b, Point3 c) {
  const double before = six_volumes(a, b, c, p), behind = six_volumes(a, b, c, q);
  if (before == 0 || behind == 0 || (before > 0) == (behind > 0)) return false;
  const double x = six_volumes(p, q, a, b), y = six_volumes(p, q, b, c), z = six_volumes(p, q, c, a);
  return (x > 0 && y > 0 && z > 0) || (x < 0 && y < 0 && z < 0);
}

struct Facet {
  std::uint32_t triangle;
  Box3 box;
};

bool apart(const Box3& a, const Box3& b) {
  return a.max.x < b.min.x || b.max.x < a.min.x || a.max.y < b.min.y || b.max.y < a.min.y || a.max.z < b.min.z ||
         b.max.z < a.min.z;
}

Box3 box_of(const Mesh& mesh, std::uint32_t triangle) {
  Box3 box;
  for (const std::uint32_t corner : mesh.triangles[triangle]) box.add(mesh.vertices[corner]);
  return box;
}

/// Those that reach into `room`, by their least X.
std::vector<Facet> facets_in(const Mesh& mesh, const std::vector<std::uint32_t>& triangles, const Box3& room) {
  std::vector<Facet> out;
  for (const std::uint32_t t : triangles)
    if (const Box3 box = box_of(mesh, t); !apart(box, room)) out.push_back({t, box});
  std::sort(out.begin(), out.end(), [](const Facet& a, const Facet& b) {
    return a.box.min.x != b.box.min.x ? a.box.min.x < b.box.min.x : a.triangle < b.triangle;
  });
  return out;
}

bool edges_pass(const Mesh& mesh, std::uint32_t edges_of, std::uint32_t through) {
  const auto at = [&](std::uint32_t t, std::size_t k) { return mesh.vertices[mesh.triangles[t][k % 3]]; };
  for (std::size_t k = 0; k < 3; ++k)
    if (passes(at(edges_of, k), at(edges_of, k + 1), at(through, 0), at(through, 1), at(through, 2))) return true;
  return false;
}

}  // namespace

bool cut_each_other(const Mesh& mesh, const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
  Box3 of_a, of_b;
  for (const std::uint32_t t : a) of_a.add(box_of(mesh, t));
  for (const std::uint32_t t : b) of_b.add(box_of(mesh, t));
  if (of_a.empty() || of_b.empty() || apart(of_a, of_b)) return false;
  const auto ours = facets_in(mesh, a, of_b), theirs = facets_in(mesh, b, of_a);
  StopNowAndThen stop(1024);
  std::size_t first = 0;
  Um widest = 0;  // along X, of theirs
  for (const Facet& f : theirs) widest = std::max(widest, f.box.max.x - f.box.min.x);
  for (const Facet& f : ours) {
    while (first < theirs.size() && theirs[first].box.min.x + widest < f.box.min.x) ++first;
    for (std::size_t i = first; i < theirs.size() && theirs[i].box.min.x <= f.box.max.x; ++i) {
      stop.step();
      if (apart(f.box, theirs[i].box)) continue;
      if (edges_pass(mesh, f.triangle, theirs[i].triangle) || edges_pass(mesh, theirs[i].triangle, f.triangle))
        return true;
    }
  }
  return false;
}

}  // namespace weft::mesh
