// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "profile/profile.h"
#include "settings/catalogue.h"
#include "settings/ini.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

/// What profiles and options say of single tools.
namespace weft {

/// The tool that a section `tool 1` is of; none: it is another section.
std::optional<int> tool_of_section(std::string_view section);

/// `[tool 99]`, `[Tool 1]`: meant for one tool, and not to be taken for a section that holds for the whole machine.
/// @param name of the file, for messages  @throws Error{settings} for such a section
void refuse_odd_tools(const std::vector<IniEntry>& entries, const std::string& name);

/// The tool and the key of `tool.1.material_flow`; none: it is another key.
std::optional<std::pair<int, std::string>> tool_key(const std::string& key);

/// Lays one value over what one tool has otherwise. Of tool 0 it is the profile's own, whatever the others have.
/// @throws Error{settings} as apply_value, and for what a tool cannot have of its own
void apply_tool_value(Profile& profile, int tool, const std::string& key, const std::string& text,
                      const std::string& where);

/// Lays `0.4, 0.6` over the profile: of T0, T1 and so on. @throws Error{settings} as apply_value
void apply_list(Profile& profile, const CatalogueEntry& entry, const std::string& text, const std::string& where);

/// Lays an ini file over what one tool has otherwise: its filament. What holds for the whole plate stays as it is, with
/// a notice. Tool 0 is the profile itself. The file counts as one that is inherited.
/// @throws as apply_file
void apply_tool_file(Profile& profile, int tool, const std::filesystem::path& path, const ImportOptions& options = {});

/// Lists hold as many values as there are tools, and nothing is printed with a tool that there is not.
/// @throws Error{settings} naming the key and where its value came from
void check_tools(const Profile& profile);

}  // namespace weft
