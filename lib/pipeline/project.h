// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "profile/profile.h"

#include <string>
#include <vector>

namespace weft {

/// Lays what projects (3MF) among the models say of the whole plate over the profile: what happens at heights, and
/// where no profile was named, their configuration. What is left out is told by name.
/// @param models as typed  @param alone no profile was named  @param plate as Placement::plate
/// @return did any of them say something?
/// @throws Error{file}, Error{model}, Error{settings}
bool apply_project(Profile& profile, const std::vector<std::string>& models, bool alone, int plate,
                   const ImportOptions& options = {});

}  // namespace weft
