// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "profile/profile.h"

#include <filesystem>

namespace weft {

/// settings' apply_file, which takes 3MF files too: PrusaSlicer keeps the configuration of a project in them.
/// @throws as apply_file; Error{settings} for a 3MF without a configuration of PrusaSlicer's
void apply_profile(Profile& profile, const std::filesystem::path& path, const ImportOptions& options = {});

/// The text in a file that holds the profile: the file's own, or that of the configuration in a 3MF.
std::string profile_text(const std::filesystem::path& path, const ImportOptions& options = {});

}  // namespace weft
