#pragma once
#include "core/polygon.h"
#include "settings/retraction.h"

#include <vector>

namespace weft::travel {

/// The way of a travel at height z, lifted.
/// @param way   the points after p, on the bed's plane
/// @param reach where the nozzle may go; empty: anywhere
/// Post: ends at the way's end at height z; stays inside `reach` where the way does: a circle that would leave it
/// becomes
///       a slope.
std::vector<Point3> lifted(const RetractionSettings& settings, Point p, const Polyline& way, Um z, const Ring& reach);

}  // namespace weft::travel
