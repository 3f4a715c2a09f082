// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/notice.h"
#include "settings/overlay.h"
#include "settings/settings.h"

#include <string>
#include <utility>
#include <vector>

namespace weft {

/// Whose words settings are in.
enum class Dialect { prusaslicer, orca, cura };

/// What a project says of one of its objects, parts or modifiers, in another program's words.
struct ForeignSettings {
  Dialect dialect = Dialect::prusaslicer;
  std::vector<std::pair<std::string, std::string>> values{};  ///< key and value
};

/// Lays it over `to` in weft's words. Shares, and what is reckoned from several keys, are of the plate's settings. What
/// weft does not know, or cannot have of so narrow a place, is left out and told by name.
/// @param where the file
void lay_foreign(const ForeignSettings& said, const Settings& plate, const std::string& where, Overlay& to,
                 Notices& notices);

}  // namespace weft
