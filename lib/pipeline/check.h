// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/notice.h"
#include "settings/settings.h"

namespace weft::pipeline {

/// What of the settings cannot have the effect that the user may expect: what every print with them warns of, whatever
/// the model. Contradictions that no print survives are errors of the profile (profile/profile.h, check_consistency);
/// what depends on a layer's geometry is noticed by the stage that meets it.
/// @return notices in the order of stages; empty where all of them take effect
Notices check(const Settings& settings);

}  // namespace weft::pipeline
