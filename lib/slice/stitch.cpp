// SPDX-License-Identifier: GPL-3.0-or-later
#include "slice/stitch.h"

#include "core/stop.h"

#include <bit>
#include <cmath>

namespace weft::slice {
namespace {

constexpr std::uint32_t none = 0xffffffff;

/// An edge of the mesh that the plane cuts: the vertex below it and the vertex above it.
struct Edge {
  std::uint32_t below = 0, above = 0;
  friend bool operator==(Edge, Edge) = default;
};

/// The cut through one triangle, with the solid on its left. The triangle's corners run counter-clockwise seen from
/// outside, so the cut comes in over the edge that runs down and leaves over the edge that runs up; in the neighbour,
/// the latter edge runs down.
struct Segment {
  Edge in, out;
};

/// Corners of those edges by which corners are below the plane (bit i: corner i): {in.below, in.above, out.below,
/// out.above}.
constexpr std::array<std::array<std::uint8_t, 4>, 8> edges_by_corners{{
    {0, 0, 0, 0},
    {0, 2, 0, 1},
    {1, 0, 1, 2},
    {0, 2, 1, 2},
    {2, 1, 2, 0},
    {2, 1, 0, 1},
    {1, 0, 2, 0},
    {0, 0, 0, 0},
}};

/// Where the edge meets the plane, to the nearest micron, ties away from the vertex below. Every product is a whole
/// number below 2^53 and the quotient is further from any whole number than its rounding error, so doubles are exact.
Point crossing(Point3 below, Point3 above, Um plane) {
  const double run = 2.0 * (above.z - below.z), up = 2.0 * (plane - below.z) + 1.0;
  const auto along = [&](Um from, Um to) {
    const double span = static_cast<double>(to) - from;
    const double step = std::floor((2 * std::abs(span) * up + run) / (2 * run));
    return static_cast<Um>(from + (span < 0 ? -step : step));
  };
  return {along(below.x, above.x), along(below.y, above.y)};
}

/// For each segment the one that follows it. A hash table of segments by the edge they come in over.
class Links {
 public:
  explicit Links(const std::vector<Segment>& segments) : segments_(segments) {
    const std::size_t size = std::bit_ceil(2 * segments.size() + 2);
    shift_ = 64 - std::countr_zero(size);
    slots_.assign(size, none);
    for (std::uint32_t i = 0; i < segments.size(); ++i) {
      std::size_t slot = slot_of(segments[i].in);
      while (slots_[slot] != none) slot = (slot + 1) & (size - 1);
      slots_[slot] = i;
    }
  }

  /// The first segment not yet taken that comes in over that edge, and takes it.
  std::uint32_t take(Edge edge, std::vector<std::uint8_t>& taken) const {
    for (std::size_t slot = slot_of(edge); slots_[slot] != none; slot = (slot + 1) & (slots_.size() - 1)) {
      const std::uint32_t i = slots_[slot];
      if (!(segments_[i].in == edge) || taken[i]) continue;
      taken[i] = 1;
      return i;
    }
    return none;
  }

 private:
  std::size_t slot_of(Edge edge) const {
    const std::uint64_t key = (std::uint64_t{edge.below} << 32) | edge.above;
    return static_cast<std::size_t>((key * 0x9E3779B97F4A7C15U) >> shift_);  // Knuth's multiplicative hashing
  }

  const std::vector<Segment>& segments_;
  std::vector<std::uint32_t> slots_;
  int shift_ = 0;
};

std::vector<Segment> segments_of(const Mesh& mesh, std::span<const std::uint32_t> triangles, Um below) {
  std::vector<Segment> out;
  out.reserve(triangles.size());
  for (const std::uint32_t t : triangles) {
    const Triangle& corners = mesh.triangles[t];
    unsigned mask = 0;
    for (unsigned k = 0; k < 3; ++k) mask |= static_cast<unsigned>(mesh.vertices[corners[k]].z <= below) << k;
    const auto& at = edges_by_corners[mask];
    out.push_back({{corners[at[0]], corners[at[1]]}, {corners[at[2]], corners[at[3]]}});
  }
  return out;
}

/// Whether two triangles are upright and lie in one plane, exactly: where they meet, no height has a corner, and one
/// that each height had elsewhere would make chords begin elsewhere in each layer.
bool in_one_upright_plane(const Mesh& mesh, const Triangle& a, const Triangle& b) {
  const Point3 origin = mesh.vertices[a[0]];
  Point3 along = origin;  // seen from above, the corner furthest from the origin
  double most = 0;
  for (const std::uint32_t v : {a[1], a[2]}) {
    const Point3 p = mesh.vertices[v];
    const double x = static_cast<double>(p.x) - origin.x, y = static_cast<double>(p.y) - origin.y;
    if (x * x + y * y > most) most = x * x + y * y, along = p;
  }
  if (most == 0) return false;  // without area, along an upright edge: it lies in every plane through that edge
  const auto beside = [&](std::uint32_t v) {
    const Point3 p = mesh.vertices[v];
    return (std::int64_t{along.x} - origin.x) * (std::int64_t{p.y} - origin.y) -
           (std::int64_t{along.y} - origin.y) * (std::int64_t{p.x} - origin.x);
  };
  for (const Triangle& t : {a, b})
    for (const std::uint32_t v : t)
      if (beside(v) != 0) return false;
  return true;
}
}  // namespace

Chains stitch(const Mesh& mesh, std::span<const std::uint32_t> triangles, Um below) {
  const std::vector<Segment> segments = segments_of(mesh, triangles, below);
  const Links links(segments);
  std::vector<std::uint8_t> taken(segments.size(), 0);
  std::vector<std::uint32_t> next(segments.size());
  StopNowAndThen stop(1024);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    stop.step();
    next[i] = links.take(segments[i].out, taken);
  }

  const auto put = [&](Polyline& line, Edge edge) {
    const Point p = crossing(mesh.vertices[edge.below], mesh.vertices[edge.above], below);
    if (line.empty() || line.back() != p) line.push_back(p);
  };
  const auto is_corner = [&](std::uint32_t before, std::uint32_t after) {
    return !in_one_upright_plane(mesh, mesh.triangles[triangles[before]], mesh.triangles[triangles[after]]);
  };
  Chains out;
  std::vector<std::uint8_t> done(segments.size(), 0);
  const auto follow = [&](std::uint32_t from, Polyline& line) {
    std::uint32_t last = from;
    for (std::uint32_t i = from; i != none && !done[i]; i = next[i]) {
      done[i] = 1;
      if (i == from || is_corner(last, i)) put(line, segments[i].in);
      last = i;
    }
    return last;
  };
  for (std::uint32_t i = 0; i < segments.size(); ++i) {
    if (taken[i]) continue;  // something leads to it
    const std::uint32_t last = follow(i, out.open.emplace_back());
    put(out.open.back(), segments[last].out);
  }
  const auto begin_of = [&](std::uint32_t some) {  // a corner, if the ring has any
    std::uint32_t at = some;
    while (!is_corner(at, next[at])) {
      at = next[at];
      if (at == some) break;
    }
    return next[at];
  };
  for (std::uint32_t i = 0; i < segments.size(); ++i)
    if (!done[i]) follow(begin_of(i), out.rings.emplace_back());
  return out;
}

}  // namespace weft::slice
