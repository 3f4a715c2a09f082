// SPDX-License-Identifier: GPL-3.0-or-later
#include "profile/tool_values.h"

#include "core/error.h"
#include "core/number.h"
#include "settings/overlay.h"
#include "settings/tools.h"
#include "settings/value.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <stdexcept>
#include <tuple>

#include <fmt/format.h>

namespace weft {

std::optional<int> tool_of_section(std::string_view section) {
  constexpr std::string_view word = "tool";
  if (!section.starts_with(word)) return std::nullopt;
  const auto digits = value::trimmed(section.substr(word.size()));
  const auto tool = as_number<int>(digits);
  return tool && *tool >= 0 && *tool <= 31 ? tool : std::nullopt;
}

void refuse_odd_tools(const std::vector<IniEntry>& entries, const std::string& name) {
  for (const auto& e : entries) {
    if (e.section.size() < 5 || tool_of_section(e.section)) continue;
    std::string word = e.section.substr(0, 4);
    std::transform(word.begin(), word.end(), word.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (word == "tool" && (std::isalpha(static_cast<unsigned char>(e.section[4])) == 0 && e.section[4] != '_'))
      throw Error{Error::Kind::settings, fmt::format("[{}]: no tool is called so", e.section.substr(0, 40)),
                  fmt::format("{}:{}", name, e.line), "tools are [tool 0] … [tool 31]"};
  }
}

std::optional<std::pair<int, std::string>> tool_key(const std::string& key) {
  constexpr std::string_view word = "tool.";
  if (!key.starts_with(word)) return std::nullopt;
  const auto dot = key.find('.', word.size());
  if (dot == std::string::npos) return std::nullopt;
  const auto tool = tool_of_section("tool " + key.substr(word.size(), dot - word.size()));
  if (!tool) return std::nullopt;
  return std::pair(*tool, key.substr(dot + 1));
}

void apply_tool_value(Profile& profile, int tool, const std::string& key, const std::string& text,
                      const std::string& where) {
  if (tool == 0) {  // alone, whatever the others have
    const auto others = profile.settings.tools.tool_settings;
    apply_value(profile, key, text, where);
    profile.settings.tools.tool_settings = others;
    return;
  }
  Overlay checked;
  checked.what = fmt::format("tool {}", tool), checked.scope = Scope::tool;
  checked.add(key, text, where);
  const auto& row = *checked.values.back().row;
  auto& values = profile.settings.tools.tool_settings;
  std::erase_if(values, [&](const ToolValue& v) { return v.tool == tool && v.key == row.key; });
  Settings laid;
  lay(laid, checked);
  values.push_back({tool, std::string(row.key), row.print(laid)});
  std::stable_sort(values.begin(), values.end(), [](const ToolValue& a, const ToolValue& b) {
    return std::tie(a.tool, a.key) < std::tie(b.tool, b.key);
  });
  profile.origins["tool_settings"].push_back({where, text, {}});
}

void apply_list(Profile& profile, const CatalogueEntry& entry, const std::string& text, const std::string& where) {
  const auto values = values_by_tool(text);
  entry.lay(profile.settings, read_value(entry, values.front(), where));
  for (std::size_t i = 1; i < values.size(); ++i)
    apply_tool_value(profile, static_cast<int>(i), std::string(entry.key), values[i], where);
  profile.origins[std::string(entry.key)].push_back({where, text, {}});
}

void apply_tool_file(Profile& profile, int tool, const std::filesystem::path& path, const ImportOptions& options) {
  profile.parents.push_back(path);
  if (tool == 0) return apply_file(profile, path, options);
  Profile own;
  own.settings = profile.settings;
  apply_file(own, path, options);
  std::string shared;
  for (const auto& [key, origins] : own.origins) {
    const auto* entry = find_setting(key);
    if (entry == nullptr) continue;
    if (!differs_by_tool(*entry)) {
      if (entry->print(own.settings) != entry->print(profile.settings)) shared += (shared.empty() ? "" : ", ") + key;
      continue;
    }
    apply_tool_value(profile, tool, key, entry->print(own.settings), origins.back().where);
  }
  profile.notices.insert(profile.notices.end(), own.notices.begin(), own.notices.end());
  profile.parents.insert(profile.parents.end(), own.parents.begin(), own.parents.end());
  if (!shared.empty())
    profile.notices.push_back(
        {"tool_setting_of_plate",
         fmt::format("{}: holds for the whole plate and stays as it is: {}", path.string(), shared)});
}

namespace {

std::string names_of_tools(std::size_t count) {
  return count == 1 ? "T0 alone" : fmt::format("T0 … T{}", count - 1);
}

[[noreturn]] void refuse(const Profile& profile, const std::string& key, std::string what, std::string hint) {
  throw Error{Error::Kind::settings, fmt::format("{}: {}", key, what), origin_of(profile, key), std::move(hint)};
}

[[noreturn]] void refuse_number(const Profile& profile, const std::string& key, std::size_t tool, std::size_t count) {
  refuse(profile, key, fmt::format("there is no tool {}, the printer has {}", tool, names_of_tools(count)),
         "extruders_enabled_count says how many there are");
}

/// How many values the list has that a key was given as last; 1: none.
std::size_t listed(const Profile& profile, const std::string& key) {
  const auto at = profile.origins.find(key);
  const auto* entry = find_setting(key);
  if (at == profile.origins.end() || entry == nullptr || !listed_by_tool(*entry)) return 1;
  return values_by_tool(at->second.back().text).size();
}

/// How many tools there are, by what says so: a number, nozzles, sections of tools. Other lists must be as long.
std::size_t count_of(const Profile& profile) {
  const auto& t = profile.settings.tools;
  if (t.extruders_enabled_count) return static_cast<std::size_t>(*t.extruders_enabled_count);
  std::size_t count = std::max(listed(profile, "nozzle_diameter"), listed(profile, "tool_nozzles"));
  for (const auto& value : t.tool_settings)
    if (listed(profile, value.key) == 1) count = std::max(count, static_cast<std::size_t>(value.tool) + 1);
  return count;
}

void check_lists(const Profile& profile, std::size_t count) {
  for (const auto& value : profile.settings.tools.tool_settings) {
    if (const auto n = listed(profile, value.key); n > 1 && n != count)
      refuse(profile, value.key, fmt::format("{} values for {} tool{}", n, count, count == 1 ? "" : "s"),
             count == 1 ? "give 1; extruders_enabled_count, or a list of nozzle_diameter, says how many tools there are"
                        : fmt::format("give 1 or {}", count));
    if (static_cast<std::size_t>(value.tool) >= count)
      refuse(profile, "extruders_enabled_count", fmt::format("{} is given for tool {}", value.key, value.tool),
             "raise it, or leave that out");
  }
}

void check_heights(const Profile& profile, std::size_t count) {
  for (const auto& mark : profile.settings.tools.tool_change_at_heights) {
    const auto digits = std::string_view(mark.text).substr(mark.text.starts_with('T') ? 1 : 0);
    const auto tool = as_number<int>(digits);
    if (!tool || *tool < 0)
      refuse(profile, "tool_change_at_heights", fmt::format("'{}' is no tool", mark.text), "as in 2.4 = 1");
    if (static_cast<std::size_t>(*tool) >= count)
      refuse_number(profile, "tool_change_at_heights", static_cast<std::size_t>(*tool), count);
  }
}

void check_gradient(const Profile& profile, std::size_t count) {
  const auto& t = profile.settings.tools;
  if (!t.gradient_tools) return;
  const auto& tools = *t.gradient_tools;
  if (tools.size() != 2)
    refuse(profile, "gradient_tools", fmt::format("{} tools", tools.size()), "two of them, as in 0, 1");
  for (const double tool : tools) {
    if (!(tool >= 0 && tool <= 31) || tool != static_cast<int>(tool))
      refuse(profile, "gradient_tools", fmt::format("'{}' is no tool", tool), "two numbers, as in 0, 1");
    if (t.gradient_mode != GradientMode::mix && static_cast<std::size_t>(tool) >= count)
      refuse_number(profile, "gradient_tools", static_cast<std::size_t>(tool), count);
  }
  if (t.gradient_stops.empty()) refuse(profile, "gradient_stops", "is empty", "shares at places, as in 0:0, 30:100");
  for (const auto& stop : t.gradient_stops)
    if (!(stop.value >= 0 && stop.value <= 100))
      refuse(profile, "gradient_stops", fmt::format("{} is no share", stop.value), "0 … 100 % of the second tool");
  if (t.gradient_mode != GradientMode::mix) return;
  const auto firmware = profile.settings.machine.firmware;
  if (firmware == Firmware::klipper || firmware == Firmware::smoothie)
    refuse(profile, "gradient_mode", "the firmware has no command for a mixing nozzle", "lines, or layers");
  if (t.gradient_axis != GradientAxis::z)
    refuse(profile, "gradient_mode", "a nozzle mixes by layers", "gradient_axis = z, or gradient_mode = lines");
}

}  // namespace

void check_tools(const Profile& profile) {
  const auto& t = profile.settings.tools;
  const std::size_t count = count_of(profile);
  check_lists(profile, count);
  for (const auto* key : tool_number_keys) {
    const auto number = find_setting(key)->print(profile.settings);
    if (number != "auto" && static_cast<std::size_t>(std::stoi(number)) >= count)
      refuse_number(profile, key, static_cast<std::size_t>(std::stoi(number)), count);
  }
  check_heights(profile, count);
  if (t.purge_volumes && t.purge_volumes->size() != count * count)
    refuse(profile, "purge_volumes", fmt::format("{} numbers for {} tools", t.purge_volumes->size(), count),
           fmt::format("give {}: a row for each tool that is unloaded", count * count));
  if (t.purge_volumes && std::any_of(t.purge_volumes->begin(), t.purge_volumes->end(), [](double v) { return v < 0; }))
    refuse(profile, "purge_volumes", "a volume is below 0", "mm³ from each tool to each");
  for (const auto& tool : settings_of_tools(profile.settings)) try {
      (void)ramming_flows(tool.tools.filament_ramming_parameters);
    } catch (const std::invalid_argument& error) {
      refuse(profile, "filament_ramming_parameters", error.what(), "as in 120 100 6.6 6.8 7.2");
    }
  if (t.prime_tower_position_x.has_value() != t.prime_tower_position_y.has_value()) {
    const bool x = t.prime_tower_position_x.has_value();
    refuse(profile, x ? "prime_tower_position_x" : "prime_tower_position_y",
           fmt::format("prime_tower_position_{} is auto", x ? 'y' : 'x'), "say where it stands along both, or neither");
  }
  check_gradient(profile, count);
}

}  // namespace weft
