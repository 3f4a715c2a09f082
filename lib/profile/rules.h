// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/notice.h"
#include "profile/profile.h"

namespace weft {

/// What a profile says that can be printed and is unlikely to be meant: heights against the nozzle, widths against
/// both, temperatures against the material, speeds against the machine, the reach against the bed, custom G-code
/// against the way E is written. What cannot be printed is refused by check_consistency; these are for `weft profile
/// check`.
/// @return a notice each, which begins with where the value came from
Notices doubts_about(const Profile& profile);

}  // namespace weft
