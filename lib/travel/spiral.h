// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/plan.h"

#include <optional>
#include <vector>

/// A vase: one wall that rises without an end.
namespace weft::travel {

/// Where in the vase a turn is.
struct TurnPlace {
  bool first = false;  ///< nothing of the vase lies below: its plastic grows from nothing to a whole bead
  bool last = false;   ///< a further turn follows on its level, whose plastic falls from a whole bead to nothing
};

/// How a vase is wound.
struct SpiralStyle {
  /// Each turn passes over from the last one's way into its own along all of it; else it keeps to its own and steps
  /// over from the last one's at its beginning.
  bool smooth = true;
  double apart_widths = 2;  ///< turns further apart than so many widths do not pass over: they are steps of the model
  double start_flow = 0;    ///< share of its plastic that the first turn begins with
  double finish_flow = 0;   ///< … and that the last one ends with
};

/// Winds the walls of one layer after the other into a helix. A turn rises evenly along its way, from the height of the
/// layer below to its own, and begins where the last one ended, to the micron.
class Spiral {
 public:
  explicit Spiral(const SpiralStyle& style) : style_(style) {}

  /// The turn that a closed wall of a layer of that height becomes.
  /// @param loop the wall's path, whose first junction is not repeated; any direction, any beginning
  /// @param start about where it begins; absent: where the last one ended. Pre: there is one, or a start
  /// @return one bead, and one more after the last
  std::vector<Extrude> turn(const std::vector<Junction>& loop, Um height, TurnPlace place, std::optional<Point> start);

 private:
  SpiralStyle style_;
  std::vector<Junction> below_;  ///< the loop of the last turn, closed
};

}  // namespace weft::travel
