// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "geometry/spatial_index.h"

#include <cstddef>
#include <optional>

namespace weft::infill {

/// The line that keeps a distance from a region's edge inside of it, and ways along that line: also where the edge
/// folds, or a notch is narrower than twice the distance.
class Beside {
 public:
  /// Cost: one offset.
  Beside(const Region& region, Um distance);

  /// A place on it.
  struct Foot {
    std::size_t segment = 0;
    Point at;
    double way_um = 0;  ///< to there along the line that was followed
  };
  /// Where a line that comes from the region's edge meets it first.
  std::optional<Foot> met_by(const Polyline& from_edge) const;

  /// The way from one place to another, the region on its left, with both ends.
  /// @returns nothing when it is longer than `longest_um`, or they lie on different lines
  std::optional<Polyline> way(const Foot& from, const Foot& to, double longest_um) const;

 private:
  Regions inner_;
  geometry::SegmentIndex edges_;
};

}  // namespace weft::infill
