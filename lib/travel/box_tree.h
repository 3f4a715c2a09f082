// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace weft::travel {

/// Boxes in a binary tree, for "which of thousands may be the best" while they come, go and change. Each has a length
/// that a bound may take into account.
class BoxTree {
 public:
  /// Boxes that are to be near each other in the tree; all are empty until they are set. Cost: O(n log n).
  explicit BoxTree(std::span<const Box> about) : items_(about.size()), order_(about.size()), leaf_(about.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    if (!about.empty()) split(about, 0, static_cast<std::uint32_t>(about.size()), none);
  }

  /// The box of i from now on; an empty one is never looked at. Cost: O(log n).
  void set(std::uint32_t i, const Box& box, double length_um = 0) {
    items_[i] = {box, length_um};
    for (std::uint32_t n = leaf_[i]; n != none; n = nodes_[n].parent) {
      Node& node = nodes_[n];
      node.bounds = {};
      if (node.right == none) {
        for (std::uint32_t k = node.begin; k < node.end; ++k) node.bounds.add(items_[order_[k]]);
      } else {
        node.bounds.add(nodes_[n + 1].bounds), node.bounds.add(nodes_[node.right].bounds);
      }
    }
  }

  /// Calls look(i) for boxes that are not empty until only such are left whose least(box, length_um) is above what look
  /// returned last. `least` of a box must not be above that of a box within it, nor fall as length_um does.
  /// Cost: O(log n) where few come near the best.
  template <class Least, class Look>
  void search(double limit, const Least& least, const Look& look) const {
    if (nodes_.empty() || nodes_[0].bounds.box.empty()) return;
    struct Open {
      std::uint32_t node;
      double least;
    };
    std::array<Open, 64> open;  // half of the boxes are left at each step: 32 would do
    std::size_t count = 0;
    const auto push = [&](std::uint32_t n) {
      const Bounds& b = nodes_[n].bounds;
      if (!b.box.empty()) open[count++] = {n, least(b.box, b.length_um)};
    };
    push(0);
    while (count > 0) {
      const auto [n, bound] = open[--count];
      if (bound > limit) continue;
      const Node& node = nodes_[n];
      if (node.right == none) {
        for (std::uint32_t k = node.begin; k < node.end; ++k) {
          const Bounds& item = items_[order_[k]];
          if (!item.box.empty() && least(item.box, item.length_um) <= limit) limit = look(order_[k]);
        }
        continue;
      }
      const std::size_t before = count;
      push(n + 1), push(node.right);
      if (count == before + 2 && open[before].least < open[before + 1].least) std::swap(open[before], open[before + 1]);
    }
  }

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFF, in_a_leaf = 6;

  struct Bounds {
    Box box;
    double length_um = 0;
    void add(const Bounds& other) {
      if (other.box.empty()) return;
      box.add(other.box);
      length_um = std::max(length_um, other.length_um);
    }
  };
  struct Node {
    Bounds bounds;
    std::uint32_t parent, begin, end, right = none;  ///< the left child is the node behind it
  };

  void split(std::span<const Box> about, std::uint32_t begin, std::uint32_t end, std::uint32_t parent) {
    const auto n = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({{}, parent, begin, end});
    if (end - begin <= in_a_leaf) {
      for (std::uint32_t k = begin; k < end; ++k) leaf_[order_[k]] = n;
      return;
    }
    Box all;
    for (std::uint32_t k = begin; k < end; ++k) all.add(about[order_[k]].centre());
    const bool wide = all.size().x > all.size().y;
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) {
                       const Point p = about[a].centre(), q = about[b].centre();
                       const Um pa = wide ? p.x : p.y, qa = wide ? q.x : q.y;
                       return pa < qa || (pa == qa && a < b);
                     });
    split(about, begin, middle, n);
    nodes_[n].right = static_cast<std::uint32_t>(nodes_.size());
    split(about, middle, end, n);
  }

  std::vector<Bounds> items_;
  std::vector<std::uint32_t> order_, leaf_;
  std::vector<Node> nodes_;
};

/// How far p is from the box, squared, µm²: exact.
inline double distance2_to(const Box& box, Point p) {
  return static_cast<double>(
      distance2(p, {std::clamp(p.x, box.min.x, box.max.x), std::clamp(p.y, box.min.y, box.max.y)}));
}

}  // namespace weft::travel
