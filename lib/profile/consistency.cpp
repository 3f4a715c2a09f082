// SPDX-License-Identifier: GPL-3.0-or-later
// What no setting says alone: values that go together or do not.
#include "core/error.h"
#include "profile/profile.h"
#include "profile/tool_values.h"
#include "settings/gcode_variables.h"
#include "settings/head_profile.h"
#include "settings/modifier_list.h"
#include "settings/pattern_list.h"

#include <array>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

namespace weft {
namespace {

/// The outlines that the boundary audit measures against must enclose something and not cross themselves.
template <class Refuse>
void check_areas(const MachineSettings& machine, const Refuse& refuse) {
  constexpr auto hint = "give at least three corners, in order around the area";
  const auto sound = [](const Ring& ring) { return ring.size() >= 3 && double_area(ring) != 0 && is_simple(ring); };
  if (machine.bed_shape == BedShape::polygon && !sound(machine.bed_polygon))
    refuse("bed_polygon", "the outline crosses itself or encloses nothing", hint);
  if (machine.bed_shape == BedShape::circle && machine.machine_width != machine.machine_depth)
    refuse("machine_depth",
           fmt::format("{} mm is not machine_width {} mm", to_mm(machine.machine_depth), to_mm(machine.machine_width)),
           "a bed of shape circle is as deep as it is wide");
  for (std::size_t i = 0; i < machine.bed_exclude_areas.size(); ++i)
    if (!sound(machine.bed_exclude_areas[i]))
      refuse("bed_exclude_areas", fmt::format("area {} crosses itself or encloses nothing", i + 1), hint);
  if (!machine.machine_reach.empty() && !sound(reach_area(machine)))
    refuse("machine_reach", "the outline crosses itself or encloses nothing",
           "give two opposite corners of a box, or a polygon");
  if (machine.machine_reach_z_min >= reach_z_max(machine))
    refuse("machine_reach_z_min", "is not below the highest Z of the reach", "lower it, or raise machine_reach_z_max");
  if (machine.home_position && machine.home_position->size() != 1)
    refuse("home_position", "is not one point", "give it as 0x0, or auto when it is not known");
  if (machine.macro_position && machine.macro_position->size() != 1)
    refuse("macro_position", "is not one point", "give it as 0x0, or auto when it is not known");
}

template <class Refuse>
void check_branches(const SupportSettings& s, const Refuse& refuse) {
  if (s.support_tree_tip_diameter.value_or(0) > s.support_tree_branch_diameter.value_or(max_coord))
    refuse("support_tree_tip_diameter",
           fmt::format("{} mm is more than support_tree_branch_diameter {} mm", to_mm(*s.support_tree_tip_diameter),
                       to_mm(*s.support_tree_branch_diameter)),
           "branches get no thinner downwards");
  if (s.support_tree_angle_slow.value_or(0) > s.support_tree_angle)
    refuse("support_tree_angle_slow",
           fmt::format("{}° is more than support_tree_angle {}°", *s.support_tree_angle_slow, s.support_tree_angle),
           "it is how far branches lean where nothing is in their way");
}

/// Heights of layers other than the usual ones.
template <class Refuse>
void check_heights(const Settings& s, const Refuse& refuse) {
  const auto& l = s.layers;
  const Um nozzle = s.machine.nozzle_diameter, most = l.adaptive_layer_height_max.value_or(nozzle * 3 / 4);
  const bool asked = l.adaptive_layer_height_enabled || l.adaptive_layer_height_max;
  if (asked && l.adaptive_layer_height_min > most)
    refuse("adaptive_layer_height_min",
           fmt::format("{} mm is more than adaptive_layer_height_max, {} mm", to_mm(l.adaptive_layer_height_min),
                       to_mm(most)),
           l.adaptive_layer_height_max ? "" : "auto is 75 % of nozzle_diameter");
  const auto too_high = [&](const char* key, Um height) {
    if (height > nozzle)
      refuse(key, fmt::format("{} mm is more than nozzle_diameter {} mm", to_mm(height), to_mm(nozzle)),
             "a bead cannot be higher than the nozzle is wide");
  };
  if (l.adaptive_layer_height_enabled) too_high("adaptive_layer_height_max", most);
  for (const auto& band : l.layer_height_ranges) too_high("layer_height_ranges", band.height);
}

/// Files that infill is laid by must be there, and its lists be some.
template <class Refuse>
void check_infill(const Profile& profile, const Refuse& refuse) {
  const InfillSettings& s = profile.settings.infill;
  const auto look_for = [&](const std::string& file, const char* key) {
    std::error_code unknown;
    if (file.empty() || std::filesystem::exists(file, unknown)) return;
    const bool by_file = origin_of(profile, key).find(':') != std::string::npos;
    refuse(key, fmt::format("'{}' is not there", file),
           by_file ? "the path is relative to this file" : "the path is relative to where weft is started");
  };
  const std::array files{&s.infill_density_image, &s.infill_density_field, &s.infill_direction_field};
  for (std::size_t i = 0; i < files.size(); ++i) look_for(*files[i], std::string(infill_files[i]).c_str());
  try {
    for (const DenseMesh& mesh : parse_modifier_list(s.infill_modifiers)) look_for(mesh.file, "infill_modifiers");
  } catch (const std::invalid_argument& problem) {
    refuse("infill_modifiers", problem.what(), "as in: boss.stl:80, core.stl:5:gyroid");
  }
  try {
    (void)parse_pattern_list(s.infill_pattern_by_density);
  } catch (const std::invalid_argument& problem) {
    refuse("infill_pattern_by_density", problem.what(), "as in: 0:honeycomb, 30:grid, 70:concentric");
  }
}

}  // namespace

void check_consistency(const Profile& profile) {
  const auto& s = profile.settings;
  const auto refuse = [&](const char* key, std::string what, std::string hint) {
    throw Error{Error::Kind::settings, fmt::format("{}: {}", key, what), origin_of(profile, key), std::move(hint)};
  };
  const auto nozzle = s.machine.nozzle_diameter;
  if (s.layers.layer_height > nozzle)
    refuse("layer_height",
           fmt::format("{} mm is more than nozzle_diameter {} mm", to_mm(s.layers.layer_height), to_mm(nozzle)),
           "a bead cannot be higher than the nozzle is wide");
  if (s.layers.initial_layer_height.value_or(0) > nozzle)
    refuse(
        "initial_layer_height",
        fmt::format("{} mm is more than nozzle_diameter {} mm", to_mm(*s.layers.initial_layer_height), to_mm(nozzle)),
        "a bead cannot be higher than the nozzle is wide");
  check_heights(s, refuse);
  if (const auto count = s.machine.machine_silent_limits.size(); count != 0 && count != silent_limits)
    refuse("machine_silent_limits", fmt::format("{} values for {} limits", count, silent_limits),
           "speeds of X, Y, Z, E, accelerations of X, Y, Z, E, jerks of X and Y, of Z, of E");
  if (s.machine.bed_shape == BedShape::polygon && s.machine.bed_polygon.size() < 3)
    refuse(profile.origins.count("bed_polygon") != 0 ? "bed_polygon" : "bed_shape",
           "a bed of shape polygon needs at least three corners in bed_polygon",
           "give them as 0x0, 220x0, 220x220, 0x220");
  check_areas(s.machine, refuse);
  check_tools(profile);
  check_branches(s.support, refuse);
  check_infill(profile, refuse);
  try {
    (void)parse_head_profile(s.plate.machine_head_profile);
  } catch (const std::invalid_argument& problem) {
    refuse("machine_head_profile", problem.what(),
           "as in: 0: -10x-10, 10x-10, 10x10, -10x10; 12: -30x-25, 45x-25, 45x60, -30x60");
  }
  try {
    (void)parse_gcode_variables(s.gcode.gcode_variables);
  } catch (const std::invalid_argument& problem) {
    refuse("gcode_variables", problem.what(), "as in: purge_length = 30");
  }
}

}  // namespace weft
