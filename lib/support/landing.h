// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "support/room.h"
#include "support/support.h"

#include <vector>

namespace weft::support {

/// What stands on the part begins exactly support_bottom_distance above it: its lowest layer is as high as that takes,
/// beside layers of the same z that rest on support. More than three quarters of the nozzle are printed as two.
/// Strips of slopes that are narrower than two lines stay as they are.
/// Post: what was set apart comes last, in any order of z.
/// @return what stands on the part, mm²
double land(const Room& room, std::vector<SupportLayer>& layers);

}  // namespace weft::support
