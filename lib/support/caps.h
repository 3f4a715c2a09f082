// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "support/room.h"
#include "support/support.h"

#include <vector>

namespace weft::support {

/// What stands on levels so that contacts which lie between two of them are held exactly their gap below: with the
/// height that is missing, or as two of half of it.
struct Caps {
  std::vector<SupportLayer> layers;
  std::vector<Regions> of;  ///< of each layer of the object, where its contact has one
};

/// @param levels  what stands on each level
/// Post: each lies on what is on its level, outside of what is kept out of its height, and off its neighbours there.
Caps caps_on(const Room& room, const Stack& stack, const Demand& demand, const std::vector<SupportLayer>& levels);

}  // namespace weft::support
