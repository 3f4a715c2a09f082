// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/tools.h"

#include "core/error.h"
#include "core/parts.h"
#include "settings/value.h"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

namespace weft {

bool listed_by_tool(const CatalogueEntry& entry) {
  return entry.scope == Scope::tool && entry.type != "text" && entry.type != "points" && entry.type != "rows";
}

std::vector<std::string> values_by_tool(std::string_view text) {
  std::vector<std::string> out;
  for (const auto part : parts(text, ',')) out.emplace_back(value::trimmed(part));
  return out;
}

std::size_t tool_count(const Settings& settings) {
  int most = 0;
  for (const auto& value : settings.tools.tool_settings) most = std::max(most, value.tool);
  return static_cast<std::size_t>(settings.tools.extruders_enabled_count.value_or(most + 1));
}

std::vector<Overlay> tool_overlays(const Settings& settings) {
  const auto count = tool_count(settings);
  std::vector<Overlay> out(count);
  for (std::size_t i = 0; i < count; ++i) out[i].what = fmt::format("tool {}", i), out[i].scope = Scope::tool;
  for (const auto& value : settings.tools.tool_settings) {
    const auto tool = static_cast<std::size_t>(value.tool);
    if (tool >= count)
      throw Error{Error::Kind::settings,
                  fmt::format("tool_settings: {} is given for tool {}, and there are {}", value.key, tool, count),
                  {},
                  "extruders_enabled_count says how many there are"};
    out[tool].add(value.key, value.text, "tool_settings");
  }
  return out;
}

std::vector<Settings> settings_of_tools(const Settings& settings) {
  std::vector<Settings> out;
  for (const auto& overlay : tool_overlays(settings)) {
    out.push_back(settings);
    lay(out.back(), overlay);
  }
  return out;
}

std::vector<double> ramming_flows(const std::string& text) {
  std::vector<double> out;
  if (text == "0") return out;
  std::istringstream words(text.substr(0, text.find('|')));
  for (std::string word; words >> word;) {
    double v = 0;
    value::parse(word, Unit::none, v);
    if (!(v > 0 && v <= 1000)) throw std::invalid_argument("'" + word + "' is not a number above 0");
    out.push_back(v);
  }
  if (out.empty()) return out;
  if (out.size() < 3) throw std::invalid_argument("it has no flows behind width and spacing");
  out.erase(out.begin(), out.begin() + 2);
  return out;
}

double share_at(const ValuesAt& stops, double at) {
  const auto after = std::find_if(stops.begin(), stops.end(), [&](const ValueAt& stop) { return stop.at > at; });
  if (after == stops.begin()) return stops.front().value / 100;
  const auto& below = *std::prev(after);
  if (after == stops.end()) return below.value / 100;
  return (below.value + (after->value - below.value) * (at - below.at) / (after->at - below.at)) / 100;
}

int nozzle_of(const std::vector<Settings>& tools, std::size_t tool) {
  return tools[tool].tools.tool_nozzles.value_or(static_cast<int>(tool));
}

bool shares_nozzle(const std::vector<Settings>& tools) {
  for (std::size_t i = 0; i < tools.size(); ++i)
    for (std::size_t j = i + 1; j < tools.size(); ++j)
      if (nozzle_of(tools, i) == nozzle_of(tools, j)) return true;
  return false;
}

}  // namespace weft
