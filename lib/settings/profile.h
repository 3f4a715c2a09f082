#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/notice.h"
#include "settings/prusaslicer.h"
#include "settings/settings.h"

namespace weft {

/// Where a value came from.
struct Origin {
  std::string where;  ///< "farm.ini:12" or "--set"
  std::string text;   ///< the value as it stood there
};

/// Settings on their way from defaults through profiles and options, with the history of each value.
struct Profile {
  Settings settings;
  std::map<std::string, std::vector<Origin>> origins;  ///< by key; oldest first, the last one holds; absent: the default
  Notices notices;
};

/// Lays an ini file over `profile`. `inherits = other.ini` (relative to the file) is laid down before the file's own values.
/// @throws Error{file} when the file cannot be read; Error{settings} with path:line for unknown keys (with the nearest known
///         one), values of wrong type or range, a key given twice, an inheritance that is missing or runs in a circle
void apply_file(Profile& profile, const std::filesystem::path& path);

/// Lays a PrusaSlicer config.ini over `profile`; apply_file does so too, with a notice for each line that loses something.
/// @return the fate of its lines
/// @throws as apply_file; Error{settings} as well when the file is not PrusaSlicer's
prusaslicer::Translation import_prusaslicer(Profile& profile, const std::filesystem::path& path);

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
