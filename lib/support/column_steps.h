// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/groups/support.h"

#include <cstddef>
#include <vector>

/// How columns get less dense on the way down. Right below a roof lines are as near to each other as its strands need;
/// further down they only carry, and each is a wall as slender as it would be with others beside it. What begins on
/// fewer lines crosses from one to the next: lines run across those below them.
namespace weft::support {

/// Shares of plastic from the top down; one where columns are as dense everywhere.
/// @param band  of a bead, of which shares are
/// Post: what begins on lines of any share but the first crosses no further from one to the next than feet are apart
std::vector<double> column_shares(const SupportSettings& settings, Um nozzle, Um band);

/// How far apart the lines of one direction of a pattern are.
Um line_distance(SupportPattern pattern, Um band, double share);

/// What of a column is no wider than twice that has no lines of a step: of the first it is hollow, and has those of the
/// step above else. Two or more of a step's lines fit in what is wider.
Um least_half(SupportPattern pattern, Um band, const std::vector<double>& shares, std::size_t step);

/// The way down from what is carried to where the first step begins; each further one begins a step's height lower.
Um first_step(const SupportSettings& settings);

}  // namespace weft::support
