// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/spatial_index.h"
#include "infill/mask.h"

#include <optional>
#include <vector>

namespace weft::infill {

/// The inside of a layer's walls, as other layers are compared with it: by cells, and exactly where that is asked.
class LayerInside {
 public:
  /// Pre: the regions outlive this.
  LayerInside(const Grid& grid, const Regions& regions) : cells_(grid, regions), regions_(&regions) {}
  const Mask& cells() const { return cells_; }
  /// Made when they are first asked for, by one thread.
  const geometry::SegmentIndex& edges() const {
    if (!edges_) edges_.emplace(*regions_);
    return *edges_;
  }

 private:
  Mask cells_;
  const Regions* regions_;
  mutable std::optional<geometry::SegmentIndex> edges_;
};

/// A layer, and those whose insides decide what of it is solid.
struct LayersInReach {
  const LayerInside* here = nullptr;
  std::vector<const LayerInside*> others;  ///< those that are further away first: on slopes they decide
};

}  // namespace weft::infill
