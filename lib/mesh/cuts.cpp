// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/cuts.h"

#include "core/stop.h"

#include <algorithm>
#include <array>
#include <iterator>

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

enum class Crossing { none, inside, on_edge };

/// Where a segment crosses a triangle's plane, with an end on either side of it: inside the triangle, or on an edge.
Crossing crossing(Point3 p, Point3 q, Point3 a, Point3 b, Point3 c) {
  const double before = six_volumes(a, b, c, p), behind = six_volumes(a, b, c, q);
  if (before == 0 || behind == 0 || (before > 0) == (behind > 0)) return Crossing::none;
  const double turns[] = {six_volumes(p, q, a, b), six_volumes(p, q, b, c), six_volumes(p, q, c, a)};
  const auto count = [&](auto is) { return std::count_if(std::begin(turns), std::end(turns), is); };
  const auto left = count([](double t) { return t > 0; }), right = count([](double t) { return t < 0; });
  if (left > 0 && right > 0) return Crossing::none;
  return left + right == 3 ? Crossing::inside : left + right == 2 ? Crossing::on_edge : Crossing::none;
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

bool in_one_plane(const Mesh& mesh, std::uint32_t t, std::uint32_t u) {
  const auto at = [&](std::uint32_t triangle, std::size_t k) { return mesh.vertices[mesh.triangles[triangle][k]]; };
  for (std::size_t k = 0; k < 3; ++k)
    if (six_volumes(at(t, 0), at(t, 1), at(t, 2), at(u, k)) != 0) return false;
  return true;
}

/// Whether an edge of a triangle passes through the surface that others are of: inside one of them, or between two that
/// lie in one plane. On any other edge bodies may merely touch.
bool edges_pass(const Mesh& mesh, std::uint32_t edges_of, const std::vector<std::uint32_t>& others) {
  const auto at = [&](std::uint32_t t, std::size_t k) { return mesh.vertices[mesh.triangles[t][k % 3]]; };
  std::vector<std::uint32_t> on_edge;
  for (std::size_t k = 0; k < 3; ++k, on_edge.clear())
    for (const std::uint32_t t : others) {
      const Crossing here = crossing(at(edges_of, k), at(edges_of, k + 1), at(t, 0), at(t, 1), at(t, 2));
      if (here == Crossing::inside) return true;
      if (here == Crossing::none) continue;
      for (const std::uint32_t other : on_edge)
        if (in_one_plane(mesh, other, t)) return true;
      on_edge.push_back(t);
    }
  return false;
}

/// Whether edges of `edges` pass through `surface`; both sorted by their least X.
bool any_edge_passes(const Mesh& mesh, const std::vector<Facet>& edges, const std::vector<Facet>& surface) {
  Um widest = 0;  // along X
  for (const Facet& f : surface) widest = std::max(widest, f.box.max.x - f.box.min.x);
  StopNowAndThen stop(1024);
  std::vector<std::uint32_t> near;
  std::size_t first = 0;
  for (const Facet& f : edges) {
    while (first < surface.size() && surface[first].box.min.x + widest < f.box.min.x) ++first;
    near.clear();
    for (std::size_t i = first; i < surface.size() && surface[i].box.min.x <= f.box.max.x; ++i) {
      stop.step();
      if (!apart(f.box, surface[i].box)) near.push_back(surface[i].triangle);
    }
    if (edges_pass(mesh, f.triangle, near)) return true;
  }
  return false;
}

}  // namespace

bool cut_each_other(const Mesh& mesh, const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
  Box3 of_a, of_b;
  for (const std::uint32_t t : a) of_a.add(box_of(mesh, t));
  for (const std::uint32_t t : b) of_b.add(box_of(mesh, t));
  if (of_a.empty() || of_b.empty() || apart(of_a, of_b)) return false;
  const auto ours = facets_in(mesh, a, of_b), theirs = facets_in(mesh, b, of_a);
  return any_edge_passes(mesh, ours, theirs) || any_edge_passes(mesh, theirs, ours);
}

}  // namespace weft::mesh
