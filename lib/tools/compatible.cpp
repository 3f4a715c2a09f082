// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compatible.h"

#include "core/error.h"
#include "settings/tools.h"
#include "settings/value.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

namespace weft::tools {
namespace {

/// Gears and tubes take filaments that are nearly alike.
constexpr double alike_diameters = 1.1;
/// What a bed may be colder or hotter than a filament wants it, °C.
constexpr int alike_beds = 15;

/// What each pair of tools has that share a nozzle.
void check_shared(const std::vector<Settings>& tools, std::size_t a, std::size_t b, Notices& notices) {
  const Um one = tools[a].material.filament_diameter, other = tools[b].material.filament_diameter;
  if (static_cast<double>(std::max(one, other)) > alike_diameters * static_cast<double>(std::min(one, other)))
    throw Error{
        Error::Kind::settings,
        fmt::format("filament_diameter: {} and {} share a nozzle, and are {} and {} mm thick", name_of(tools, a),
                    name_of(tools, b), value::number(to_mm(one)), value::number(to_mm(other))),
        {},
        "give them nozzles of their own (tool_nozzles), or filaments of one diameter"};
  const auto doubt = [&](std::size_t printed, std::size_t rests) {
    const int celsius = tools[printed].material.material_print_temperature;
    const auto &least = tools[rests].tools.material_print_temperature_min,
               &most = tools[rests].tools.material_print_temperature_max;
    if (least && celsius < *least)
      notices.push_back({"filament_temperatures",
                         fmt::format("material_print_temperature: {} is printed at {} °C, and what is left of {} in "
                                     "that nozzle melts at {} °C and above",
                                     name_of(tools, printed), celsius, name_of(tools, rests), *least)});
    if (most && celsius > *most)
      notices.push_back({"filament_temperatures",
                         fmt::format("material_print_temperature: {} is printed at {} °C, and what is left of {} in "
                                     "that nozzle stands {} °C",
                                     name_of(tools, printed), celsius, name_of(tools, rests), *most)});
  };
  doubt(a, b), doubt(b, a);
}

/// Is the word one of those between commas? Capitals do not count.
bool lists(std::string_view list, std::string_view word) {
  const auto same = [](std::string_view a, std::string_view b) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return lower(x) == lower(y); });
  };
  while (!list.empty()) {
    const auto end = std::min(list.find(','), list.size());
    if (same(value::trimmed(list.substr(0, end)), value::trimmed(word))) return true;
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return false;
}

void check_alone(const std::vector<Settings>& tools, const ToolInUse& use, Notices& notices) {
  const auto& own = tools[use.tool];
  const auto name = name_of(tools, use.tool);
  if (tools.size() > 1 && use.highest > own.machine.nozzle_diameter)
    throw Error{Error::Kind::settings,
                fmt::format("layer_height: {} prints layers of {} mm, and its nozzle is {} mm wide", name,
                            value::number(to_mm(use.highest)), value::number(to_mm(own.machine.nozzle_diameter))),
                {},
                "lower layer_height, or print that with another tool"};
  const auto& hardness = own.tools.machine_nozzle_hardness;
  if (hardness && own.tools.material_nozzle_hardness > *hardness)
    notices.push_back(
        {"nozzle_hardness",
         fmt::format("material_nozzle_hardness: {} wears a nozzle of less than {} HRC out, and its nozzle "
                     "has {}",
                     name, own.tools.material_nozzle_hardness, *hardness)});
  const auto& plate = tools.front().tools.machine_bed_plate;
  if (!plate.empty() && !own.tools.material_plates.empty() && !lists(own.tools.material_plates, plate))
    notices.push_back({"filament_plate", fmt::format("material_plates: {} holds on {}, and the bed's plate is {}", name,
                                                     own.tools.material_plates, plate)});
}

}  // namespace

std::string name_of(const std::vector<Settings>& tools, std::size_t tool) {
  return fmt::format("T{} ({})", tool, tools[tool].material.material_type);
}

Notices compatibility(const std::vector<Settings>& tools, const std::vector<ToolInUse>& in_use) {
  Notices out;
  for (const auto& use : in_use) check_alone(tools, use, out);
  for (std::size_t i = 0; i < in_use.size(); ++i)
    for (std::size_t j = i + 1; j < in_use.size(); ++j) {
      const auto a = in_use[i].tool, b = in_use[j].tool;
      if (nozzle_of(tools, a) == nozzle_of(tools, b)) check_shared(tools, a, b, out);
      const int one = tools[a].material.material_bed_temperature, other = tools[b].material.material_bed_temperature;
      if (std::max(one, other) - std::min(one, other) > alike_beds)
        out.push_back({"bed_temperatures",
                       fmt::format("material_bed_temperature: {} wants a bed of {} °C, {} one of {} °C; the bed is as "
                                   "the first tool of the print wants it",
                                   name_of(tools, a), one, name_of(tools, b), other)});
    }
  return out;
}

}  // namespace weft::tools
