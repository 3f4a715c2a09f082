// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/notice.h"
#include "profile/named_profiles.h"
#include "prusaslicer/bundle.h"
#include "prusaslicer/import.h"
#include "settings/origin.h"
#include "settings/settings.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace weft {

/// Settings on their way from defaults through profiles and options, with the history of each value.
struct Profile {
  Settings settings;
  std::map<std::string, std::vector<Origin>>
      origins;  ///< by key; oldest first, the last one holds; absent: the default
  Notices notices;
  std::vector<std::filesystem::path> parents;  ///< files that were inherited
};

/// How profiles of PrusaSlicer's family are read.
struct ImportOptions {
  prusaslicer::PresetChoice presets{};  ///< which presets of a bundle are meant
  bool strict = false;                  ///< what would be lost is an error
  ProfileFolders folders{};             ///< where profiles are looked for by name
  std::filesystem::path root{};  ///< when not empty, no file is read that is neither in it nor in one of the folders
  std::vector<std::pair<std::string, std::string>> options{};  ///< PrusaSlicer's keys said beside profiles; they hold
  std::vector<std::filesystem::path> within{};  ///< files that are being read, outermost first: none is read in itself
};

/// Lays an ini file over `profile`. `inherits = other.ini` (relative to the file, else by name) is laid down before the
/// file's own values. A configuration or bundle of PrusaSlicer's family, or G-code that holds one, is translated, with
/// a notice for what it loses.
/// @throws Error{file} when the file cannot be read; Error{settings} with path:line for unknown keys (with the nearest
/// known
///         one), values of wrong type or range, a key given twice, an inheritance that is missing or runs in a circle
void apply_file(Profile& profile, const std::filesystem::path& path, const ImportOptions& options = {});

/// The same of a file's bytes. @param path for messages, and what inheritance is relative to
void apply_text(Profile& profile, std::string_view text, const std::filesystem::path& path,
                const ImportOptions& options = {});

/// Lays a configuration of PrusaSlicer's family over `profile`: a config.ini, a bundle, or G-code that holds one.
/// @return the fate of its lines
/// @throws as apply_file; Error{settings} as well when the text is not PrusaSlicer's
prusaslicer::Translation import_prusaslicer(Profile& profile, std::string_view text, const std::filesystem::path& path,
                                            const ImportOptions& options = {});

/// Lays options that PrusaSlicer's keys were given as over `profile`, where no configuration of that family has taken
/// them in: shares are of the profile's own layer height and nozzle.
/// @throws Error{settings} naming the option
void apply_options(Profile& profile, const ImportOptions& options);

/// Does the options' root let that file be read? @throws Error{file}
void refuse_outside(const std::filesystem::path& path, const ImportOptions& options);

/// The bytes of a profile. @throws Error{file}, also where the options' root bounds what may be read
std::string read_profile(const std::filesystem::path& path, const ImportOptions& options);

/// The known key nearest to a wrong one, by its own name or by PrusaSlicer's; empty when nothing is near.
std::string_view nearest_key(std::string_view wrong);

/// Lays one value over `profile`.
/// @param where what to name in messages: the option, or path:line
/// @throws Error{settings}
void apply_value(Profile& profile, const std::string& key, const std::string& text, const std::string& where);

/// Rules that need more than one setting: checked when every profile and option has been applied.
/// @throws Error{settings} naming the keys and where their values came from
void check_consistency(const Profile& profile);

/// Where the key's value came from: "farm.ini:12", or "default".
std::string origin_of(const Profile& profile, const std::string& key);

}  // namespace weft
