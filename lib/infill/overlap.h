// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <limits>

namespace weft::infill {

/// How far lines reach over the edge of the area that they fill, into the walls around it.
struct Overlap {
  double um = 0;  ///< across the edge: um ≤ most_um; negative: ends keep off the edge
  /// Along a line: as deep as the walls are. A line that meets its edge at a narrow angle goes far to be `um` beyond
  /// it; in a corner it would come out of the walls of the other side.
  double most_um = std::numeric_limits<double>::infinity();

  /// By how much a line is prolonged. @param sine of the angle between it and its edge, > 0
  double along(double sine) const { return std::min(um / sine, most_um); }
};

}  // namespace weft::infill
