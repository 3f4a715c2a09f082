// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/lightning.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/spatial_index.h"
#include "infill/web.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

namespace weft::infill {
namespace {

constexpr std::uint32_t wall = std::numeric_limits<std::uint32_t>::max();
constexpr double beyond = 50;  // µm that a root reaches over the edge
// A branch is grown to the wall unless another is so much nearer: else those beside a wall would hang on each other in
// a row, and the row would have to be drawn back from its end downwards, through hundreds of layers.
constexpr double wall_first = 1.5;

/// Branches of one layer: a node knows the one that it hangs on, or the wall.
struct Node {
  Place at;
  std::uint32_t parent = wall;
  bool gone = false;
};

Point point_of(Place p) {
  return {rounded(p.x), rounded(p.y)};
}
Place place_of(Point p) {
  return {static_cast<double>(p.x), static_cast<double>(p.y)};
}

class Forest {
 public:
  /// Downwards into a layer below one of that height.
  void descend(const geometry::SegmentIndex& edges, Um height, LightningLean lean) {
    if (nodes_.empty()) return;
    count_children();
    shorten(lean.tips * height);
    straighten(lean.bends * height);
    keep_within(edges);
    tidy();
  }

  /// A branch to each place that is farther from walls and branches than those carry it; those near the wall first.
  void support(const geometry::SegmentIndex& edges, const std::vector<Point>& places, double radius, double by_wall) {
    struct Wanted {
      double to_wall;
      Point at, foot;
    };
    std::vector<Wanted> wanted;
    for (const Point p : places) {
      const auto near = edges.nearest(p);
      if (near && near->distance_um > by_wall) wanted.push_back({near->distance_um, p, near->at});
    }
    std::sort(wanted.begin(), wanted.end(), [](const Wanted& a, const Wanted& b) {
      if (a.to_wall != b.to_wall) return a.to_wall < b.to_wall;
      return a.at.x != b.at.x ? a.at.x < b.at.x : a.at.y < b.at.y;
    });
    for (const Wanted& w : wanted) {
      stop_if_asked();
      const Place p = place_of(w.at);
      double least = std::numeric_limits<double>::infinity();
      std::uint32_t branch = wall;
      double along = 0;
      bool cut_off = false;  // a branch lies between it and the wall
      for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
        const Place a = nodes_[i].at, b = nodes_[i].parent == wall ? a : nodes_[nodes_[i].parent].at;
        const Place d = b - a;
        const double l2 = d.x * d.x + d.y * d.y;
        const double t = l2 > 0 ? std::clamp(((p.x - a.x) * d.x + (p.y - a.y) * d.y) / l2, 0.0, 1.0) : 0;
        const double off = norm(p - (a + t * d));
        cut_off = cut_off || segments_cross(w.at, w.foot, point_of(a), point_of(b));
        if (off < least && !edges.crosses(w.at, point_of(a + t * d))) least = off, branch = i, along = t;
      }
      if (least <= radius) continue;
      if (!cut_off && least >= w.to_wall / wall_first) branch = wall;
      grow(p, branch, along, place_of(w.foot));
    }
  }

  /// Lines from tip to wall or to the line that they branch off, the longest first.
  std::vector<Polyline> lines() {
    count_children();
    std::vector<double> way(nodes_.size(), 0);
    for (std::uint32_t i = 0; i < nodes_.size(); ++i)
      for (std::uint32_t n = i; nodes_[n].parent != wall; n = nodes_[n].parent)
        way[i] += norm(nodes_[n].at - nodes_[nodes_[n].parent].at);
    std::vector<std::uint32_t> tips;
    for (std::uint32_t i = 0; i < nodes_.size(); ++i)
      if (children_[i] == 0) tips.push_back(i);
    std::stable_sort(tips.begin(), tips.end(), [&](std::uint32_t a, std::uint32_t b) { return way[a] > way[b]; });
    std::vector<bool> drawn(nodes_.size(), false);
    std::vector<Polyline> out;
    for (const std::uint32_t tip : tips) {
      Polyline line;
      for (std::uint32_t n = tip;; n = nodes_[n].parent) {
        line.push_back(point_of(nodes_[n].at));
        if (drawn[n]) break;
        drawn[n] = true;
        if (nodes_[n].parent == wall) {
          reach_over(line);
          break;
        }
      }
      line.erase(std::unique(line.begin(), line.end()), line.end());
      if (line.size() >= 2) out.push_back(std::move(line));
    }
    return out;
  }

 private:
  void count_children() {
    children_.assign(nodes_.size(), 0);
    for (const Node& n : nodes_)
      if (n.parent != wall) ++children_[n.parent];
  }

  void grow(Place p, std::uint32_t branch, double along, Place foot) {
    if (branch == wall) {
      nodes_.push_back({foot, wall});
      branch = static_cast<std::uint32_t>(nodes_.size()) - 1;
    } else if (along > 0 && along < 1 && nodes_[branch].parent != wall) {
      const std::uint32_t parent = nodes_[branch].parent;
      nodes_.push_back({nodes_[branch].at + along * (nodes_[parent].at - nodes_[branch].at), parent});
      nodes_[branch].parent = static_cast<std::uint32_t>(nodes_.size()) - 1;
      branch = nodes_[branch].parent;
    } else if (along >= 1) {
      branch = nodes_[branch].parent;
    }
    nodes_.push_back({p, branch});
  }

  /// Tips are carried by what is above them no more.
  void shorten(double step) {
    const std::vector<int> children = children_;
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
      if (children[i] != 0) continue;
      double left = step;
      for (std::uint32_t n = i; left > 0;) {
        const std::uint32_t parent = nodes_[n].parent;
        if (parent == wall) {
          nodes_[n].gone = true;
          break;
        }
        const double way = norm(nodes_[parent].at - nodes_[n].at);
        if (way > left) {
          nodes_[n].at = nodes_[n].at + (left / way) * (nodes_[parent].at - nodes_[n].at);
          break;
        }
        nodes_[n].gone = true, left -= way;
        if (--children_[parent] > 0) break;  // another branch goes on from there
        n = parent;
      }
    }
  }

  void straighten(double step) {
    std::vector<std::uint32_t> child(nodes_.size(), wall);
    for (std::uint32_t i = 0; i < nodes_.size(); ++i)
      if (!nodes_[i].gone && nodes_[i].parent != wall) child[nodes_[i].parent] = i;
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
      if (nodes_[i].gone || nodes_[i].parent == wall || children_[i] != 1 || child[i] == wall) continue;
      const Place a = nodes_[nodes_[i].parent].at, b = nodes_[child[i]].at, d = b - a, p = nodes_[i].at - a;
      const double l2 = std::max(d.x * d.x + d.y * d.y, 1e-9);
      const Place foot = a + std::clamp((p.x * d.x + p.y * d.y) / l2, 0.0, 1.0) * d, off = foot - nodes_[i].at;
      const double way = norm(off);
      nodes_[i].at = way > step ? nodes_[i].at + (step / way) * off : foot;
    }
  }

  /// Nodes outside of the area go, and what hung on them hangs on the wall; roots follow the wall.
  void keep_within(const geometry::SegmentIndex& edges) {
    constexpr double at_wall = 5;  // µm
    for (Node& n : nodes_)
      if (!n.gone && n.parent != wall && !edges.region_at(point_of(n.at))) n.gone = true;
    const std::size_t count = nodes_.size();
    for (std::size_t i = 0; i < count; ++i) {
      if (nodes_[i].gone) continue;
      if (nodes_[i].parent != wall && !nodes_[nodes_[i].parent].gone) continue;
      const auto near = edges.nearest(point_of(nodes_[i].at));
      if (!near) {
        nodes_[i].gone = true;
        continue;
      }
      const Place foot = place_of(near->at);
      if (nodes_[i].parent == wall && (near->distance_um <= at_wall || !edges.region_at(point_of(nodes_[i].at)))) {
        nodes_[i].at = foot;
        continue;
      }
      nodes_.push_back({foot, wall});
      nodes_[i].parent = static_cast<std::uint32_t>(nodes_.size()) - 1;
    }
  }

  /// Without those that are gone, and without roots that nothing hangs on.
  void tidy() {
    std::vector<int> children(nodes_.size(), 0);
    for (const Node& n : nodes_)
      if (!n.gone && n.parent != wall) ++children[n.parent];
    std::vector<std::uint32_t> number(nodes_.size(), wall);
    std::vector<Node> kept;
    for (std::uint32_t i = 0; i < nodes_.size(); ++i)
      if (!nodes_[i].gone && (nodes_[i].parent != wall || children[i] > 0)) {
        number[i] = static_cast<std::uint32_t>(kept.size());
        kept.push_back(nodes_[i]);
      }
    for (Node& n : kept)
      if (n.parent != wall) n.parent = number[n.parent];
    nodes_ = std::move(kept);
  }

  static void reach_over(Polyline& line) {
    if (line.size() < 2) return;
    const Place a = place_of(line[line.size() - 2]), b = place_of(line.back());
    const double way = norm(b - a);
    if (way > 0) line.push_back(point_of(b + (beyond / way) * (b - a)));
  }

  std::vector<Node> nodes_;
  std::vector<int> children_;
};

/// Where a layer's area is solid in the layer above.
std::vector<Point> hanging(const Regions& here, const Regions& above, double apart, Point origin) {
  const Regions bare = geometry::subtract(here, above);
  std::vector<Point> out;
  if (bare.empty()) return out;
  const Um step = std::max(1, rounded(apart));
  const Box box = box_of(bare);
  const auto first = [&](Um v, Um from) {
    const Um off = v - from;
    return from + (off >= 0 ? (off + step - 1) / step : -(-off / step)) * step;
  };
  const geometry::SegmentIndex edges(bare);
  for (Um y = first(box.min.y, origin.y); y <= box.max.y; y += step)
    for (Um x = first(box.min.x, origin.x); x <= box.max.x; x += step)
      if (edges.region_at({x, y})) out.push_back({x, y});
  return out;
}

}  // namespace

std::vector<std::vector<Polyline>> lightning(std::span<const LightningLayer> layers, double radius, LightningLean lean,
                                             Point origin) {
  constexpr double samples = 0.5;  // of the radius, between places that are looked at
  std::vector<std::vector<Polyline>> out(layers.size());
  Forest forest;
  for (std::size_t i = layers.size(); i-- > 0;) {
    stop_if_asked();
    const Regions& here = layers[i].sparse;
    if (here.empty()) {
      forest = {};
      continue;
    }
    const geometry::SegmentIndex edges(here);
    forest.descend(edges, i + 1 < layers.size() ? layers[i + 1].height : 0, lean);
    forest.support(edges,
                   hanging(here, i + 1 < layers.size() ? layers[i + 1].sparse : Regions{}, samples * radius, origin),
                   radius, lean.beside_wall ? *lean.beside_wall * layers[i].height : radius);
    out[i] = forest.lines();
  }
  return out;
}

}  // namespace weft::infill
