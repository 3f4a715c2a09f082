// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "support/room.h"

#include <span>

namespace weft::support {

/// Narrow columns are hollow, so a roof that begins in one of them would hang between its walls: the level below gets
/// rungs across, as near to each other as strands of a roof may cross freely, and each above one of the level below
/// where there is one.
/// @param levels  one above the other; takes rungs as lines of joists
void lay_rungs(const Room& room, std::span<SupportLayer> levels);

}  // namespace weft::support
