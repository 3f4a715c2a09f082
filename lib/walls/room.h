#pragma once
#include "core/polygon.h"
#include "core/stop.h"
#include "geometry/spatial_index.h"
#include "walls/place.h"

#include <cstdint>
#include <vector>

/// Private to walls: how wide a bead may be where it lies.
namespace weft::walls {

/// Thread: one at a time.
class Room {
 public:
  /// `origin` is that of the places asked about.
  Room(const Region& region, Point origin);

  /// Half the width at which the band of a piece from a to b reaches the outline on either side; no more than `most`,
  /// µm. At a piece's first (last) end, if it is an end of the bead, what is not quite square is no lack of room.
  double beside(Place a, Place b, double most, bool first, bool last);

 private:
  Place on_piece(Point p, Place a, Place way) const;

  Point origin_;
  geometry::SegmentIndex index_;
  std::vector<std::uint32_t> near_;  ///< of the index's segments; all, when they are few
  StopNowAndThen stop_{16};
};

}  // namespace weft::walls
