// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "support/room.h"

#include <vector>

namespace weft::support {

/// Lets what branches left, where a column of its own would be too slender to stand, hang on to a branch nearby: a
/// bracket grows out of it, upwards, no flatter than branches lean.
/// @param contacts  by level, for what lies beside them
/// @param branches  by level; brackets are added to them
/// @param left      by level: what no branch holds; what brackets hold is taken from it
/// Post: every bracket lies in the room and rests on what is below it.
void hang_on(const Room& room, const Stack& stack, const std::vector<Regions>& contacts, std::vector<Regions>& branches,
             std::vector<Regions>& left);

}  // namespace weft::support
