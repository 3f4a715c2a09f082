// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/groups/retraction.h"
#include "travel/travel.h"

#include <vector>

namespace weft::travel {

/// A travel that is lifted.
struct Lift {
  std::vector<Point3> path;
  HopType type = HopType::vertical;  ///< what it has become
  bool lowered = false;              ///< it is less high than asked, to stay in the room
};

/// The way of a travel at height z, lifted.
/// @param way   the points after p, on the bed's plane
/// Post: ends at the way's end at height z; stays in the room where the way does: a circle that would leave it becomes
///       one on the other side of the way, then a slope; a slope longer than the way becomes vertical.
Lift lifted(const RetractionSettings& settings, Point p, const Polyline& way, Um z, const Room& room);

}  // namespace weft::travel
