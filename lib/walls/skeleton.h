// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/medial_axis.h"
#include "walls/place.h"

#include <cstdint>
#include <vector>

/// Private to walls: the medial axis cut into pieces short enough to be straight, with the ribs that join it to the
/// outline. A point of the region is (rib, distance from the outline), and a bead is a curve of given distance.
namespace weft::walls {

struct Skeleton {
  using Node = geometry::MedialAxis::Node;
  /// Directed piece of the axis with the outline on its right; twins are neighbours, an edge is a pair of them.
  struct Half {
    std::uint32_t from = 0, next = 0, previous = 0;
    Place foot;  ///< of the rib at `from`, on the outline; the rib at the end is that of `next`
  };
  /// From a foot on the outline to a node.
  struct Rib {
    Place foot;
    const Node& top;
    /// At distance d from the outline, which may exceed the clearance.
    Place at(double d) const { return top.clearance > 1e-6 ? lerp(foot, top.at, d / top.clearance) : top.at; }
  };
  std::vector<Node> nodes;
  std::vector<Half> halves;

  static constexpr std::uint32_t twin(std::uint32_t half) { return half ^ 1U; }
  static constexpr std::uint32_t edge_of(std::uint32_t half) { return half >> 1U; }
  std::size_t edge_count() const { return halves.size() / 2; }
  std::uint32_t to(std::uint32_t half) const { return halves[twin(half)].from; }
  const Node& start(std::uint32_t half) const { return nodes[halves[half].from]; }
  const Node& end(std::uint32_t half) const { return nodes[to(half)]; }
  double length(std::uint32_t edge) const {
    return distance(nodes[halves[2 * edge].from].at, nodes[halves[2 * edge + 1].from].at);
  }
  Rib start_rib(std::uint32_t half) const { return {halves[half].foot, start(half)}; }
  Rib end_rib(std::uint32_t half) const { return {halves[halves[half].next].foot, end(half)}; }
  Place on_start_rib(std::uint32_t half, double d) const { return start_rib(half).at(d); }
  Place on_end_rib(std::uint32_t half, double d) const { return end_rib(half).at(d); }

  /// Puts a node at fraction t of an edge, as seen from its even half. The edge keeps the first part; returns the
  /// other.
  std::uint32_t split(std::uint32_t edge, double t);
};

/// Pieces of curved axis subtend at most the angle at which a chord stands off an arc of the clearance by `chord`, µm,
/// or off one of radius `reach`, where no bead lies further from the outline than that.
Skeleton skeleton_of(const geometry::MedialAxis& axis, double chord, double reach);

}  // namespace weft::walls
