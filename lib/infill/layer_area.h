// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/spatial_index.h"
#include "infill/mask.h"

#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace weft::infill {

/// An area of a layer, as other layers are compared with it: by cells, and exactly where that is asked. What is asked
/// for first is made then, by one thread.
class LayerArea {
 public:
  /// Pre: the regions outlive this.
  LayerArea(const Grid& grid, const Regions& regions) : cells_(grid, regions), regions_(&regions) {}
  const Mask& cells() const { return cells_; }
  /// Cells that are no further from it than so many steps, within a cell or so.
  const Mask& grown(Um step, int times) const { return times > 0 ? grown_by(step, times).cells : cells_; }
  const geometry::SegmentIndex& edges() const {
    if (!edges_) edges_.emplace(*regions_);
    return *edges_;
  }

 private:
  struct Grown {
    Mask cells;
    int by = 0;  // cells, along the grid's axes
  };
  const Grown& grown_by(Um step, int times) const {
    const auto found = grown_.find({step, times});
    if (found != grown_.end()) return found->second;
    constexpr double rounding = 0.25;  // cells: a disc of 2 has corners at 2.24
    const Grown* before = times > 1 ? &grown_by(step, times - 1) : nullptr;
    const int done = before != nullptr ? before->by : 0;
    const double more = static_cast<double>(step) * times / cells_.grid().cell - done + rounding;
    Grown grown{(before != nullptr ? before->cells : cells_).grown_round(more), done + static_cast<int>(more)};
    return grown_.emplace(std::pair{step, times}, std::move(grown)).first->second;
  }
  Mask cells_;
  const Regions* regions_;
  mutable std::map<std::pair<Um, int>, Grown> grown_;
  mutable std::optional<geometry::SegmentIndex> edges_;
};

/// What has to cover a place within the skin, if that is to be sparse: an area of another layer, grown by so much.
struct Cover {
  const LayerArea* area = nullptr;
  Um grown = 0;
  const Mask* cells = nullptr;  ///< so grown
};

/// The inside of a layer's walls, and what decides which of it is solid.
struct LayersInReach {
  const LayerArea* here = nullptr;
  std::vector<Cover> covers;  ///< those of layers further away first: on slopes they decide
};

}  // namespace weft::infill
