// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/notice.h"
#include "pipeline/support_object.h"
#include "plate/plate.h"
#include "settings/settings.h"

namespace weft::pipeline {

/// What somebody has drawn for support and will not find in the print: support meshes beyond the room that there is, or
/// above the object, and support by hand (support_auto = false) of which nothing is there.
void tell_marks(const Settings& settings, const Object& object, const std::vector<slice::Cut>& cuts,
                const SupportOf& support, Notices& notices);

}  // namespace weft::pipeline
