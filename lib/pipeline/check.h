// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/notice.h"
#include "settings/settings.h"

namespace weft::pipeline {

/// What of the settings cannot have the effect the user may expect: what every print with them warns of.
Notices check(const Settings& settings);

}  // namespace weft::pipeline
