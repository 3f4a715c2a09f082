// SPDX-License-Identifier: GPL-3.0-or-later
#include "prusaslicer/import_tools.h"

#include "prusaslicer/keys.h"
#include "prusaslicer/text.h"
#include "settings/catalogue.h"
#include "settings/tools.h"
#include "settings/value.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

namespace weft::prusaslicer {
namespace {

using value::number;

/// Keys of extruders and filaments whose names do not say so.
constexpr std::array by_extruder{"nozzle_diameter",
                                 "extruder_colour",
                                 "min_layer_height",
                                 "max_layer_height",
                                 "temperature",
                                 "first_layer_temperature",
                                 "bed_temperature",
                                 "first_layer_bed_temperature",
                                 "chamber_temperature",
                                 "chamber_minimal_temperature",
                                 "idle_temperature",
                                 "extrusion_multiplier",
                                 "cooling",
                                 "fan_always_on",
                                 "min_fan_speed",
                                 "max_fan_speed",
                                 "bridge_fan_speed",
                                 "disable_fan_first_layers",
                                 "full_fan_speed_layer",
                                 "fan_below_layer_time",
                                 "slowdown_below_layer_time",
                                 "min_print_speed",
                                 "enable_dynamic_fan_speeds",
                                 "overhang_fan_speed_0",
                                 "overhang_fan_speed_1",
                                 "overhang_fan_speed_2",
                                 "overhang_fan_speed_3",
                                 "start_filament_gcode",
                                 "end_filament_gcode",
                                 "deretract_speed",
                                 "wipe",
                                 "nozzle_high_flow",
                                 "travel_ramping_lift",
                                 "travel_max_lift",
                                 "travel_slope",
                                 "travel_lift_before_obstacle"};

bool is_by_extruder(std::string_view key) {
  return key.starts_with("filament_") || key.starts_with("retract_") ||
         std::find(by_extruder.begin(), by_extruder.end(), key) != by_extruder.end();
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '\\';
    out += c;
  }
  return out + '"';
}

/// How a value of theirs becomes one of weft's.
enum class As { number, length, flag, chosen, extruder };
struct Row {
  std::string_view theirs, ours;
  As as;
};
constexpr std::array rows{
    Row{"wipe_tower", "prime_tower_enable", As::chosen},
    Row{"wipe_tower_width", "prime_tower_width", As::length},
    Row{"wipe_tower_rotation_angle", "prime_tower_angle", As::number},
    Row{"wipe_tower_brim_width", "prime_tower_brim_width", As::length},
    Row{"wipe_tower_bridging", "prime_tower_max_bridging_distance", As::length},
    Row{"wipe_tower_extra_flow", "prime_tower_purge_width", As::number},
    Row{"wipe_tower_extra_spacing", "prime_tower_purge_spacing", As::number},
    Row{"wipe_tower_extruder", "prime_tower_extruder_nr", As::extruder},
    Row{"wipe_into_infill", "purge_into_infill", As::flag},
    Row{"wipe_into_objects", "purge_into_object", As::flag},
    Row{"support_material_extruder", "support_infill_extruder_nr", As::extruder},
    Row{"support_material_interface_extruder", "support_interface_extruder_nr", As::extruder},
    Row{"filament_minimal_purge_on_wipe_tower", "prime_tower_min_volume", As::number},
    Row{"filament_soluble", "material_soluble", As::flag},
    Row{"retract_length_toolchange", "switch_extruder_retraction_amount", As::length},
    Row{"retract_restart_extra_toolchange", "switch_extruder_extra_prime_amount", As::length},
    Row{"idle_temperature", "material_standby_temperature", As::number},
};
/// Of printers whose filaments share a nozzle.
constexpr std::array shared_rows{
    Row{"filament_unloading_speed_start", "filament_unloading_speed_start", As::number},
    Row{"filament_unloading_speed", "filament_unloading_speed", As::number},
    Row{"filament_loading_speed_start", "filament_loading_speed_start", As::number},
    Row{"filament_loading_speed", "filament_loading_speed", As::number},
    Row{"filament_cooling_moves", "filament_cooling_moves", As::number},
    Row{"filament_cooling_initial_speed", "filament_cooling_initial_speed", As::number},
    Row{"filament_cooling_final_speed", "filament_cooling_final_speed", As::number},
    Row{"filament_stamping_distance", "filament_stamping_distance", As::length},
    Row{"filament_stamping_loading_speed", "filament_stamping_loading_speed", As::number},
    Row{"filament_toolchange_delay", "filament_toolchange_delay", As::number},
    Row{"parking_pos_retraction", "parking_pos_retraction", As::length},
    Row{"cooling_tube_retraction", "cooling_tube_retraction", As::length},
    Row{"cooling_tube_length", "cooling_tube_length", As::length},
    Row{"extra_loading_move", "extra_loading_move", As::length},
};

class Tools {
 public:
  Tools(Lines& lines, const Lines& whole, std::size_t count, const Outlet& out)
      : lines_(lines), whole_(whole), count_(count), out_(out) {}

  void run() {
    const auto* nozzles = whole_.look("nozzle_diameter");
    out_.set("extruders_enabled_count", std::to_string(count_), *nozzles);
    if (const auto* e = lines_.look("gcode_flavor"); e && e->value == "klipper") out_.set("tool_select", "t", *e);
    const bool shared = lines_.flag("single_extruder_multi_material", false);
    if (shared) out_.set("tool_nozzles", "0", *lines_.look("single_extruder_multi_material"));
    for (const auto& row : rows) copy(row);
    for (const auto& row : shared_rows)
      if (shared)
        copy(row);
      else
        lines_.find(row.theirs);
    const auto* ramming = lines_.find("filament_ramming_parameters");
    if (shared && ramming) out_.set("filament_ramming_parameters", first_text(*ramming), *ramming);
    colour();
    features();
    volumes();
    waiting();
    paint();
    place();
    tower();
    multitool_ramming(shared);
    load_time();
    offsets();
    filament_code();
  }

 private:
  void copy(const Row& row) {
    const auto* e = lines_.find(row.theirs);
    if (!e || first_text(*e) == "nil") return;
    switch (row.as) {
      case As::number:
        return out_.set(row.ours, number(lines_.figure(*e).v), *e);
      case As::length:
        return out_.set(row.ours, number(lines_.figure(*e).v, 3), *e);
      case As::chosen:  // a default is no answer: PrusaSlicer's window asks for it where it is needed
        if (e->line == 0) return;
        [[fallthrough]];
      case As::flag:
        return out_.set(row.ours, lines_.flag(*e) ? "true" : "false", *e);
      case As::extruder:
        if (const auto tool = tool_of(*e)) out_.set(row.ours, *tool, *e);
        return;
    }
  }

  /// They count from 1; 0 is whichever.
  std::optional<std::string> tool_of(const IniEntry& e) {
    const double v = lines_.figure(e).v;
    if (v == 0) return std::nullopt;
    if (!(v >= 1 && v <= static_cast<double>(count_))) lines_.refuse(e, fmt::format("an extruder, 0 … {}", count_));
    return number(v - 1);
  }

  /// The spool's, unless the extruder has one of its own. PrusaSlicer's own colour is nobody's choice.
  void colour() {
    const auto *extruder = lines_.find("extruder_colour"), *filament = lines_.find("filament_colour");
    for (const auto* e : {extruder, filament})
      if (e && first_text(*e).starts_with("#") && first_text(*e) != "#29B2B2")
        return out_.set("filament_colour", first_text(*e), *e);
  }

  /// What all features have is the object's tool, so that an object may have another.
  void features() {
    const auto* own = lines_.find("extruder");
    const auto* walls = lines_.find("perimeter_extruder");
    const auto* all = own && lines_.figure(*own).v > 0 ? own : walls;
    const auto tool = all ? tool_of(*all) : std::nullopt;
    if (tool) out_.set("extruder_nr", *tool, *all);
    for (const auto& [theirs, ours] :
         {std::pair{"perimeter_extruder", "wall_extruder_nr"}, std::pair{"infill_extruder", "infill_extruder_nr"},
          std::pair{"solid_infill_extruder", "top_bottom_extruder_nr"}})
      if (const auto* e = lines_.find(theirs))
        if (const auto other = tool_of(*e); other && other != tool) out_.set(ours, *other, *e);
  }

  void volumes() {
    const auto* matrix = lines_.find("wiping_volumes_matrix");
    const auto* custom = lines_.find("wiping_volumes_use_custom_matrix");
    if (!matrix || matrix->line == 0 || (custom && custom->line != 0 && !lines_.flag(*custom))) return;
    // It may be of more extruders than there are: PrusaSlicer's own has five.
    const auto elements = elements_of(matrix->key, matrix->value);
    const auto side = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(elements.size()))));
    if (side * side != elements.size() || side < count_) {
      out_.approximate(
          *matrix, fmt::format("{} numbers for {} extruders: volumes follow from colours", elements.size(), count_));
      return;
    }
    std::string list;
    for (std::size_t from = 0; from < count_; ++from)
      for (std::size_t to = 0; to < count_; ++to) list += (list.empty() ? "" : ", ") + elements[from * side + to];
    out_.set("purge_volumes", list, *matrix);
  }

  /// Nozzles wait at their temperature unless ooze_prevention says otherwise.
  void waiting() {
    const auto* e = lines_.find("ooze_prevention");
    const auto* delta = lines_.find("standby_temperature_delta");
    const auto* idle = lines_.look("idle_temperature");
    if (!e || (idle && first_text(*idle) != "nil")) return;
    if (!lines_.flag(*e)) return out_.set("machine_min_cool_heat_time_window", "100000", *e);
    const auto* temperature = lines_.look("temperature");
    if (delta && temperature)
      out_.set("material_standby_temperature",
               number(std::max(0.0, lines_.figure(*temperature).v + lines_.figure(*delta).v)), *delta);
  }

  /// 0 is any depth there: as far as another paint, or the surface on the other side, is nearer.
  void paint() {
    const auto* e = lines_.find("mmu_segmented_region_max_width");
    if (!e || e->line == 0) return;
    const double mm = lines_.figure(*e).v;
    out_.set("paint_depth", mm > 0 ? number(mm, 3) : "1000", *e);
  }

  /// A default of PrusaSlicer's own is no place that anybody has chosen, unless one half of it is.
  void place() {
    const auto *x = lines_.find("wipe_tower_x"), *y = lines_.find("wipe_tower_y");
    const auto* said = x && x->line != 0 ? x : y;
    if (!said || said->line == 0) return;
    const auto set = [&](const char* ours, const IniEntry* e, const char* theirs) {
      const auto text = e ? number(lines_.figure(*e).v, 3) : std::string(*find_key(theirs)->initial);
      out_.set(ours, text, e ? *e : *said);
    };
    set("prime_tower_position_x", x, "wipe_tower_x");
    set("prime_tower_position_y", y, "wipe_tower_y");
  }

  void tower() {
    if (const auto* e = lines_.find("wipe_tower_cone_angle"); e && lines_.figure(*e).v > 0) {
      out_.set("prime_tower_shape", "cone", *e);
      out_.set("prime_tower_cone_angle", number(lines_.figure(*e).v), *e);
    }
    if (const auto* e = lines_.find("wipe_tower_no_sparse_layers"))
      out_.set("prime_tower_sparse", lines_.flag(*e) ? "false" : "true", *e);
  }

  void multitool_ramming(bool shared) {
    const auto* does = lines_.find("filament_multitool_ramming");
    const auto *volume = lines_.find("filament_multitool_ramming_volume"),
               *flow = lines_.find("filament_multitool_ramming_flow");
    if (shared || !does || !lines_.flag(*does) || !volume) return;
    out_.set("filament_multitool_ramming_volume", number(lines_.figure(*volume).v), *volume);
    if (flow && lines_.figure(*flow).v > 0)
      out_.set("filament_multitool_ramming_flow", number(lines_.figure(*flow).v), *flow);
  }

  void load_time() {
    const auto *load = lines_.find("filament_load_time"), *unload = lines_.find("filament_unload_time");
    if (!load && !unload) return;
    const double s = (load ? lines_.figure(*load).v : 0) + (unload ? lines_.figure(*unload).v : 0);
    out_.set("tool_change_time", number(s), load ? *load : *unload);
  }

  void offsets() {
    const auto* e = lines_.find("extruder_offset");
    const auto* all = whole_.look("extruder_offset");
    if (!e || !all || all->line == 0) return;
    const auto elements = elements_of(all->key, all->value);
    std::string list;
    for (std::size_t i = 0; i < count_; ++i) list += (i == 0 ? "" : ", ") + elements[i < elements.size() ? i : 0];
    out_.set("nozzle_offsets", list, *all);
  }

  /// It goes with its filament, not with the printer's own.
  void filament_code() {
    for (const auto& [theirs, ours] :
         {std::pair{"start_filament_gcode", "machine_extruder_start_code"},
          std::pair{"end_filament_gcode", "machine_extruder_end_code"}, std::pair{"start_gcode", "machine_start_gcode"},
          std::pair{"end_gcode", "machine_end_gcode"}})
      if (const auto* e = lines_.find(theirs)) out_.set(ours, first_text(*e), *e);
  }

  Lines& lines_;
  const Lines& whole_;
  std::size_t count_;
  const Outlet& out_;
};

/// What holds in the end of each setting.
std::map<std::string, const Assignment*> last_of_each(const Translation& translation) {
  std::map<std::string, const Assignment*> out;
  for (const auto& a : translation.assignments) out[a.key] = &a;
  return out;
}

}  // namespace

std::size_t extruders_in(const std::vector<IniEntry>& entries) {
  std::size_t out = 1;
  for (const auto& e : entries)
    if (e.key == "nozzle_diameter") out = std::max<std::size_t>(1, elements_of(e.key, e.value).size());
  return out;
}

std::vector<IniEntry> of_extruder(std::vector<IniEntry> entries, std::size_t extruder) {
  for (auto& e : entries) {
    if (!is_by_extruder(e.key)) continue;
    const auto elements = elements_of(e.key, e.value);
    if (elements.size() < 2) continue;
    const auto& own = elements[extruder < elements.size() ? extruder : 0];
    e.value = is_text_list(e.key) ? quoted(own) : own;
  }
  return entries;
}

void add_differences(std::size_t tool, const Translation& own, Translation& out) {
  const auto first = last_of_each(out);
  std::vector<Assignment> further;
  for (const auto& [key, a] : last_of_each(own)) {
    const auto known = first.find(key);
    if (known != first.end() && known->second->text == a->text) continue;
    const auto* entry = find_setting(key);
    if (!entry) continue;
    if (differs_by_tool(*entry)) {
      further.push_back(*a);
      further.back().key = fmt::format("tool.{}.{}", tool, key);
    } else if (a->line != 0) {
      out.approximated.push_back({a->theirs.empty() ? key : a->theirs, a->text, a->line,
                                  fmt::format("extruder {} has what the first one has", tool + 1)});
    }
  }
  out.assignments.insert(out.assignments.end(), further.begin(), further.end());
}

void import_tools(Lines& lines, const Lines& whole, std::size_t count, const Outlet& out) {
  Tools(lines, whole, count, out).run();
}

}  // namespace weft::prusaslicer
