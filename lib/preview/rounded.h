// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cmath>

namespace weft::preview {

/// A figure (mm, mm², s, g, %) as pages and reports of the preview write it: to four places, a tenth of a micron,
/// where a double would be written with seventeen digits.
inline double rounded(double v) {
  constexpr double places = 1e4;
  return std::round(v * places) / places;
}

}  // namespace weft::preview
