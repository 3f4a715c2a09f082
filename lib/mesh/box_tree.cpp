// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/box_tree.h"

#include "core/stop.h"

#include <algorithm>
#include <utility>

namespace weft::mesh {
namespace {

constexpr std::size_t most_in_leaf = 8;

std::int64_t twice_middle(const Box3& box, int axis) {
  const auto sum = [](Um a, Um b) { return std::int64_t{a} + b; };
  return axis == 0 ? sum(box.min.x, box.max.x) : axis == 1 ? sum(box.min.y, box.max.y) : sum(box.min.z, box.max.z);
}

}  // namespace

BoxTree::BoxTree(std::vector<Box3> boxes) : boxes_(std::move(boxes)) {
  if (!boxes_.empty()) build(0, boxes_.size());
}

std::size_t BoxTree::build(std::size_t begin, std::size_t end) {
  const std::size_t at = nodes_.size();
  Node node{{}, begin, end, 0};
  for (std::size_t i = begin; i < end; ++i) node.hull.add(boxes_[i]);
  nodes_.push_back(node);
  if (end - begin <= most_in_leaf) return at;
  stop_if_asked();
  const Point3 size = node.hull.size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::size_t middle = begin + (end - begin) / 2;
  const auto place = [&](std::size_t i) { return boxes_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(place(begin), place(middle), place(end),
                   [axis](const Box3& a, const Box3& b) { return twice_middle(a, axis) < twice_middle(b, axis); });
  build(begin, middle);
  const std::size_t second = build(middle, end);
  nodes_[at].second = second;
  return at;
}

bool BoxTree::any_contains(const Box3& box) const {
  std::vector<std::size_t> open;
  if (!nodes_.empty()) open.push_back(0);
  StopNowAndThen stop(256);
  while (!open.empty()) {
    stop.step();
    const std::size_t at = open.back();
    const Node& node = nodes_[at];
    open.pop_back();
    if (!node.hull.contains(box)) continue;
    if (node.second == 0) {
      for (std::size_t i = node.begin; i < node.end; ++i)
        if (boxes_[i].contains(box)) return true;
    } else {
      open.push_back(at + 1), open.push_back(node.second);
    }
  }
  return false;
}

}  // namespace weft::mesh
