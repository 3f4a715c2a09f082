// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// Profiles by name: `-p marlin-220` and `inherits = printers/marlin-220` wherever the working folder is.
namespace weft {

using ProfileFolders = std::vector<std::filesystem::path>;

/// The profile that is meant by what was typed: the file of that path, seen from `base`; else that of the name in the
/// first of the folders that has one, in the folder itself or in one of those right in it ("marlin-220",
/// "printers/marlin-220"), with or without ".ini". Absolute paths and those that go upwards or begin with "." name no
/// profile but their own.
/// @param base what the path is relative to; empty: the working folder
/// @return nothing when there is none
/// @throws Error{settings} when a folder has several of that name
std::optional<std::filesystem::path> find_profile(const std::filesystem::path& typed, const std::filesystem::path& base,
                                                  const ProfileFolders& folders);

/// The same for a profile that has to be there: without one it is the path itself, for which reading then fails.
/// @throws Error{file} with the nearest names when nothing is found and there are profiles in the folders
std::filesystem::path profile_file(const std::filesystem::path& typed, const std::filesystem::path& base,
                                   const ProfileFolders& folders);

/// A profile as it is found by name.
struct NamedProfile {
  std::string name;  ///< "printers/marlin-220"
  std::filesystem::path file;
  std::string about;  ///< its first line, when that is a comment
};

/// Those in a folder, by name.
std::vector<NamedProfile> profiles_in(const std::filesystem::path& folder);

}  // namespace weft
