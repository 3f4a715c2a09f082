// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "support/room.h"
#include "support/support.h"

#include <vector>

namespace weft::support {

/// Of each layer of support, the share that no tool gets to: what a ball of 3 mm that comes from outside, or from where
/// the bed was, does not meet without going through the part. To about a millimetre; where nothing stands on the part,
/// nothing is trapped. Empty: nothing is anywhere.
/// Cost: a flood of up to 150,000 cells.
std::vector<double> trapped_shares(const Room& room, const std::vector<SupportLayer>& layers, double on_part_mm2);

}  // namespace weft::support
