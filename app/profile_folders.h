// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "profile/named_profiles.h"

namespace weft::app {

/// Where profiles are looked for by name: the folders of WEFT_PROFILES (separated by ':'), then those that came with
/// the program, beside its own place. Folders that are not there are left out.
ProfileFolders profile_folders();

/// Every profile that has a name, under the folder it is in: what `weft profile list` says. Of two with the same name
/// only the first is found by it, and listed.
std::string list_of_profiles(const ProfileFolders& folders);

}  // namespace weft::app
