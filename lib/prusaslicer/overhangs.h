// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "prusaslicer/lines.h"

#include <string>
#include <string_view>
#include <vector>

namespace weft::prusaslicer {

/// One of weft's settings, and the line that says it.
struct Told {
  std::string_view ours;
  std::string text;
  const IniEntry* line;
};

/// Speeds and fans of walls over air. PrusaSlicer gives them by the share of their width that lies on the layer below:
/// 0, 25, 50, 75 %, and in between what is in between; weft by bands of the share that does not, each of which takes
/// what PrusaSlicer gives its far end. Without `enable_dynamic_…` only what lies over air as a whole is a bridge, and
/// without `overhangs` nothing is told apart.
/// @param bridge_mm_s what bridges are printed at
std::vector<Told> overhangs_of(Lines& lines, double bridge_mm_s);

}  // namespace weft::prusaslicer
