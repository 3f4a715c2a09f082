// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/groups/infill.h"

#include <string_view>
#include <vector>

namespace weft {

/// A pattern, and the density from which on it holds, 0 … 1.
struct PatternFrom {
  double density = 0;
  InfillPattern pattern = InfillPattern::grid;
};

/// `0:honeycomb, 30:grid`, ascending; empty of an empty text.
/// @throws std::invalid_argument that says what is wrong
std::vector<PatternFrom> parse_pattern_list(std::string_view text);

}  // namespace weft
