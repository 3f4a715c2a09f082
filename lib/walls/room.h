// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "core/stop.h"
#include "geometry/spatial_index.h"
#include "walls/place.h"

#include <cstdint>
#include <optional>
#include <vector>

/// Private to walls: how wide a bead may be where it lies.
namespace weft::walls {

/// Thread: one at a time. Cost: looks at all of the region when it is first asked, at what is near from then on.
class Room {
 public:
  /// `origin` is that of the places asked about. `region` must outlive this.
  Room(const Region& region, Point origin) : region_(region), origin_(origin) {}

  /// Half the width at which the band of a piece from a to b reaches the outline; no more than `most`, µm. At a piece's
  /// first (last) end, if it is an end of the bead, what is not quite square is no lack of room.
  double beside(Place a, Place b, double most, bool first, bool last);

 private:
  const geometry::SegmentIndex& index();
  Place on_piece(Point p, Place a, Place way) const;

  const Region& region_;
  Point origin_;
  std::optional<geometry::SegmentIndex> index_;
  std::vector<std::uint32_t> near_;  ///< of the index's segments; all, when they are few
  StopNowAndThen stop_{16};
};

}  // namespace weft::walls
