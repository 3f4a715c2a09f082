// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/skeleton.h"

#include "core/stop.h"
#include "geometry/axis_curve.h"

namespace weft::walls {

using geometry::MedialAxis;

std::uint32_t Skeleton::split(std::uint32_t edge, double t) {
  const std::uint32_t h = 2 * edge, back = h + 1;
  const auto n = static_cast<std::uint32_t>(nodes.size()), g = static_cast<std::uint32_t>(halves.size());
  const Node &a = start(h), &b = end(h);
  const Node middle{lerp(a.at, b.at, t), a.clearance + t * (b.clearance - a.clearance)};
  const Place right = lerp(halves[h].foot, halves[halves[h].next].foot, t);
  const Place left = lerp(halves[back].foot, halves[halves[back].next].foot, 1 - t);
  nodes.push_back(middle);
  const std::uint32_t after = halves[h].next, before = halves[back].previous;
  halves.push_back({n, after, h, right});                                  // g: n → b
  halves.push_back({halves[back].from, back, before, halves[back].foot});  // g + 1: b → n
  if (after == back) {                                                     // the edge ended in a leaf
    halves[g].next = g + 1;
    halves[g + 1].previous = g;
  } else {
    halves[after].previous = g;
    halves[before].next = g + 1;
  }
  halves[h].next = g;
  halves[back].from = n;
  halves[back].foot = left;
  halves[back].previous = g + 1;
  return g / 2;
}

Skeleton skeleton_of(const MedialAxis& axis, double chord, double reach) {
  Skeleton out;
  out.nodes.reserve(axis.nodes.size() * 2);
  out.halves.reserve(axis.half_edges.size() * 2);
  for (const auto& node : axis.nodes) out.nodes.push_back({node.at, node.clearance});
  std::vector<std::uint32_t> first(axis.half_edges.size()), last(axis.half_edges.size());
  std::vector<Skeleton::Node> inner;
  StopNowAndThen stop(128);
  for (std::uint32_t k = 0; k < axis.half_edges.size(); k += 2) {
    stop.step();
    inner.clear();
    geometry::add_nodes_between(axis, k, chord, reach, inner);
    const auto& right = axis.sites[axis.half_edges[k].site];
    const auto& left = axis.sites[axis.half_edges[k + 1].site];
    std::uint32_t from = axis.half_edges[k].from;
    first[k] = last[k + 1] = static_cast<std::uint32_t>(out.halves.size());
    ++last[k + 1];
    for (std::size_t i = 0; i <= inner.size(); ++i) {
      std::uint32_t to = axis.half_edges[k + 1].from;
      if (i < inner.size()) {
        to = static_cast<std::uint32_t>(out.nodes.size());
        out.nodes.push_back(inner[i]);
      }
      const auto h = static_cast<std::uint32_t>(out.halves.size());
      out.halves.push_back({from, h + 2, h - 2, geometry::foot_on(right, out.nodes[from].at)});
      out.halves.push_back({to, h - 1, h + 3, geometry::foot_on(left, out.nodes[to].at)});
      from = to;
    }
    last[k] = static_cast<std::uint32_t>(out.halves.size()) - 2;
    first[k + 1] = last[k] + 1;
  }
  for (std::uint32_t k = 0; k < axis.half_edges.size(); ++k) {
    const std::uint32_t next = first[axis.half_edges[k].next];
    out.halves[last[k]].next = next;
    out.halves[next].previous = last[k];
  }
  return out;
}

}  // namespace weft::walls
