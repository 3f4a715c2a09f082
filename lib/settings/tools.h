// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/overlay.h"
#include "settings/settings.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

/// Tools of a print: how many there are, and what each of them has otherwise.
namespace weft {

/// The settings that name a tool for something that is printed.
inline constexpr std::array tool_number_keys{"extruder_nr",
                                             "wall_extruder_nr",
                                             "wall_0_extruder_nr",
                                             "wall_x_extruder_nr",
                                             "infill_extruder_nr",
                                             "top_bottom_extruder_nr",
                                             "roofing_extruder_nr",
                                             "adhesion_extruder_nr",
                                             "support_infill_extruder_nr",
                                             "support_interface_extruder_nr",
                                             "prime_tower_extruder_nr"};

/// May it be given for each tool, as a list between commas: `0.4, 0.6`? Texts and points hold commas of their own.
bool listed_by_tool(const CatalogueEntry& entry);

/// May a tool have a value of its own at all?
bool differs_by_tool(const CatalogueEntry& entry);

/// The values of such a list; one where there is no comma.
std::vector<std::string> values_by_tool(std::string_view text);

/// How many tools the printer has: extruders_enabled_count, else as many as settings are given for. At least 1.
std::size_t tool_count(const Settings& settings);

/// What is laid over the settings of T0 for each tool; the first is empty. As many as there are tools.
/// @throws Error{settings} for what a tool cannot have of its own, and values that its key does not take
std::vector<Overlay> tool_overlays(const Settings& settings);

/// The settings of each tool. As many as there are tools.
std::vector<Settings> settings_of_tools(const Settings& settings);

/// The flows of filament_ramming_parameters, mm³/s: what stands behind width and spacing, as far as a bar;
/// none for `0`, which vendors' bundles write for a tip that is not shaped.
/// @throws std::invalid_argument for what is no number, and flows that are not above 0
std::vector<double> ramming_flows(const std::string& text);

/// The share at a place, 0 … 1, straight between stops. Pre: there is one
double share_at(const ValuesAt& stops, double at);

/// The nozzle that a tool's filament is in: tools of equal numbers share it.
int nozzle_of(const std::vector<Settings>& tools, std::size_t tool);

/// Is there a nozzle that filaments share?
bool shares_nozzle(const std::vector<Settings>& tools);

}  // namespace weft
