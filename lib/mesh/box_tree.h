// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "mesh/mesh.h"

#include <cstddef>
#include <vector>

namespace weft::mesh {

/// Many boxes, of which is asked whether one holds another box.
class BoxTree {
 public:
  /// Cost: n log n.
  explicit BoxTree(std::vector<Box3> boxes);

  /// Whether `box` lies in one of them; their faces may touch. Cost: log n where they lie side by side, up to n where
  /// they lie in each other and none holds it.
  bool any_contains(const Box3& box) const;

 private:
  /// All boxes of a node lie in `hull`; the halves of an inner node are the one after it and `second`.
  struct Node {
    Box3 hull;
    std::size_t begin, end, second;
  };
  std::size_t build(std::size_t begin, std::size_t end);

  std::vector<Box3> boxes_;
  std::vector<Node> nodes_;
};

}  // namespace weft::mesh
