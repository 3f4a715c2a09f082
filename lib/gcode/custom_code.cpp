// SPDX-License-Identifier: GPL-3.0-or-later
#include "gcode/custom_code.h"

#include "core/escape.h"
#include "core/version.h"
#include "gcode/header.h"
#include "gcode/placeholders.h"
#include "prusaslicer/keys.h"
#include "settings/catalogue.h"
#include "settings/tools.h"
#include "settings/value.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace weft::gcode {
namespace {

using macro::Scalar;
using macro::Variable;
using macro::Variables;

char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_letter(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

/// Does a macro of the firmware (PRINT_START, not G28) get that number among its arguments?
bool macro_is_handed(std::string_view code, int number) {
  const auto wanted = fmt::format("{}", number);
  while (!code.empty()) {
    const auto end = std::min(code.find('\n'), code.size());
    auto line = value::trimmed(code.substr(0, end));
    line = line.substr(0, line.find(';'));
    code.remove_prefix(std::min(end + 1, code.size()));
    if (line.size() < 2 || !is_letter(line[0]) || is_digit(line[1])) continue;
    for (auto at = line.find(wanted); at != std::string_view::npos; at = line.find(wanted, at + 1)) {
      const auto after = at + wanted.size();
      if (!is_digit(line[at - 1]) && (after == line.size() || !is_digit(line[after]))) return true;
    }
  }
  return false;
}

Variable pair_of(Um a, Um b) {
  Variable out;
  out.values = {to_mm(a), to_mm(b)};
  return out;
}
Variable count(std::size_t n) {
  return macro::variable(static_cast<std::int64_t>(n));
}

/// To so many decimals: no false precision in comments and on displays.
Variable rounded_to(double v, int decimals) {
  return macro::variable_of(value::number(v, decimals));
}

void add_boxes(const Job& job, Variables& out) {
  const auto box = first_layer_box(job);
  const Box covered = box.empty() ? Box{{0, 0}, {0, 0}} : box;
  out["first_layer_print_min"] = pair_of(covered.min.x, covered.min.y);
  out["first_layer_print_max"] = pair_of(covered.max.x, covered.max.y);
  out["first_layer_print_size"] = pair_of(covered.size().x, covered.size().y);
  Variable hull;  // corners, each as PrusaSlicer writes a point
  for (const Point p : first_layer_hull(job))
    hull.values.emplace_back(fmt::format("{:g},{:g}", to_mm(p.x), to_mm(p.y)));
  if (hull.values.empty()) hull.values.emplace_back(std::string("0,0"));
  out["first_layer_print_convex_hull"] = std::move(hull);
  const auto bed = box_of(print_surface(job.settings.machine));
  out["print_bed_min"] = pair_of(bed.min.x, bed.min.y);
  out["print_bed_max"] = pair_of(bed.max.x, bed.max.y);
  out["print_bed_size"] = pair_of(bed.size().x, bed.size().y);
}

void add_figures(const Job& job, Variables& out) {
  const auto& t = job.statistics;
  out["print_time"] = out["normal_print_time"] = out["silent_print_time"] = macro::variable(duration(t.print_time_s));
  out["print_time_s"] = rounded_to(t.print_time_s, 0);
  out["used_filament"] = out["total_used_filament"] = rounded_to(t.filament_mm / 1000, 2);  // metres, as in PrusaSlicer
  out["extruded_volume"] = out["extruded_volume_total"] = rounded_to(t.filament_mm3, 2);
  out["total_weight"] = out["extruded_weight_total"] = out["extruded_weight"] = rounded_to(t.filament_g, 2);
  out["total_toolchanges"] = count(tool_changes(job));
  out["has_wipe_tower"] = macro::variable(t.features[static_cast<std::size_t>(Role::wipe_tower)].mm3 > 0);
  out["has_single_extruder_multi_material_priming"] = macro::variable(false);
}

/// What of the print is whose: lists of as many values as there are tools, and sums of them.
void add_shares(const Job& job, Variables& out) {
  const auto& t = job.statistics;
  const std::size_t count_of_tools = std::max<std::size_t>(1, job.tools.size());
  const auto settings_of = [&](std::size_t i) -> const Settings& {
    return i < job.tools.size() ? job.tools[i] : job.settings;
  };
  const auto share_of = [&](std::size_t i) {
    if (i < t.tools.size()) return t.tools[i];
    return i == 0 && t.tools.empty() ? Statistics::Tool{.filament_mm3 = t.filament_mm3, .filament_g = t.filament_g}
                                     : Statistics::Tool{};
  };
  Variable used;
  std::string types;
  std::vector<std::string> named;
  double cost = 0, tower_cost = 0, tower_g = 0;
  for (std::size_t i = 0; i < count_of_tools; ++i) {
    const auto share = share_of(i);
    const auto& material = settings_of(i).material;
    const bool prints = share.filament_mm3 > 0 || count_of_tools == 1;
    used.values.emplace_back(prints);
    if (!prints) continue;
    const double per_g = material.filament_cost / 1000;
    const double of_tower = share.filament_mm3 > 0 ? share.filament_g * share.tower_mm3 / share.filament_mm3 : 0;
    cost += share.filament_g * per_g, tower_cost += of_tower * per_g, tower_g += of_tower;
    if (std::find(named.begin(), named.end(), material.material_type) != named.end()) continue;
    types += (types.empty() ? "" : ",") + named.emplace_back(material.material_type);
  }
  out["num_extruders"] = count(std::max(count_of_tools, t.tools.size()));
  out["num_printing_extruders"] =
      count(static_cast<std::size_t>(std::count(used.values.begin(), used.values.end(), macro::Scalar(true))));
  out["is_extruder_used"] = std::move(used);
  out["printing_filament_types"] = macro::variable(escape::one_line(types));
  out["total_cost"] = rounded_to(cost, 2);
  out["total_wipe_tower_cost"] = rounded_to(tower_cost, 2);
  out["total_wipe_tower_filament"] = rounded_to(tower_g, 2);
  Variable volumes;  // row = from
  for (std::size_t i = 0; i < count_of_tools * count_of_tools; ++i)
    volumes.values.emplace_back(i < job.purge_volumes.size() ? job.purge_volumes[i] : 0.0);
  out["wiping_volumes_matrix"] = std::move(volumes);
}

/// Names that Cura's start G-code uses and that are called otherwise here.
void add_aliases_of_cura(const Job& job, Variables& out) {
  constexpr std::array<std::array<std::string_view, 2>, 10> aliases{{
      {"machine_nozzle_size", "nozzle_diameter"},
      {"layer_height_0", "initial_layer_height"},
      {"material_diameter", "filament_diameter"},
      {"retraction_speed", "retraction_retract_speed"},
      {"line_width", "wall_line_width_x"},
      {"speed_print", "speed_infill"},
      {"infill_density", "infill_sparse_density"},
      {"initial_extruder_nr", "initial_extruder"},
      {"extruder_nr", "initial_extruder"},
      {"jobname", "input_filename_base"},
  }};
  for (const auto& [theirs, ours] : aliases)
    if (const auto found = out.find(ours); found != out.end()) out.emplace(std::string(theirs), found->second);
  out["filament_amount"] = rounded_to(job.statistics.filament_mm / 1000, 2);
  out["filament_weight"] = rounded_to(job.statistics.filament_g, 2);
}

void add_names(const Job& job, Variables& out) {
  const auto base = escape::gcode_name(job.input_name);
  out["input_filename_base"] = macro::variable(base);
  out["input_filename"] = macro::variable(base + ".gcode");
  for (const auto* preset : {"print_preset", "filament_preset", "printer_preset", "physical_printer_preset"})
    out.emplace(preset, macro::variable(std::string()));
  // What would differ from run to run, or is not known here, has no value; gcode_variables may give it one.
  const auto never = [&](const char* name, const char* why) {
    Variable none;
    none.missing = why;
    out.emplace(name, std::move(none));
  };
  for (const auto* time : {"timestamp", "year", "month", "day", "hour", "minute", "second"})
    never(time, "would differ from run to run unless SOURCE_DATE_EPOCH or gcode_variables says it");
  never("threads", "would differ from machine to machine");
  never("scale", "is each model's own");
  out.emplace("version", macro::variable(std::string(version)));
}

}  // namespace

CustomCode::CustomCode(const GcodeSettings& g)
    : start(g.machine_start_gcode, "machine_start_gcode"),
      before_layer(g.before_layer_gcode, "before_layer_gcode"),
      layer(g.layer_gcode, "layer_gcode"),
      tool_change(g.tool_change_gcode, "tool_change_gcode"),
      load(g.machine_extruder_start_code, "machine_extruder_start_code"),
      unload(g.machine_extruder_end_code, "machine_extruder_end_code"),
      pause(g.pause_gcode, "pause_gcode"),
      color_change(g.color_change_gcode, "color_change_gcode"),
      between_objects(g.between_objects_gcode, "between_objects_gcode"),
      end(g.machine_end_gcode, "machine_end_gcode") {}

void CustomCode::check(const Variables& variables) const {
  Variables globals;
  for (const auto* code : all()) code->check(variables, globals);
}

bool CustomCode::names_any() const {
  const auto texts = all();
  return std::any_of(texts.begin(), texts.end(), [](const auto* text) { return !text->names().empty(); });
}

std::vector<const macro::Template*> CustomCode::all() const {
  return {&start, &before_layer, &layer, &tool_change, &load, &unload, &pause, &color_change, &between_objects, &end};
}

namespace {

/// What tools may have of their own is a list of theirs.
void add_tools(const Job& job, Variables& out) {
  for (std::size_t tool = 1; tool < job.tools.size(); ++tool) {
    const auto own = variables_of(job.tools[tool]);
    const auto add = [&](std::string_view name) {
      const auto to = out.find(name);
      const auto from = own.find(name);
      if (to == out.end() || from == own.end() || to->second.values.size() != tool || from->second.values.size() != 1)
        return;
      to->second.values.push_back(from->second.values.front());
      to->second.text.clear();
    };
    for (const auto& entry : catalogue()) {
      if (!differs_by_tool(entry) || entry.scope != Scope::tool) continue;
      add(entry.key);
      for (const auto& row : prusaslicer::keys())
        if (row.ours == entry.key && row.name != entry.key) add(row.name);
    }
    for (const auto* name : {"first_layer_temperature", "retract_length"}) add(name);
  }
}

}  // namespace

namespace {

/// What custom G-code is handed of the machine, and may say of it: where the nozzle is across the bed is not known
/// before the moves are, and wherever it has gone is said again afterwards.
void add_place(std::size_t tools, Variables& out) {
  Variable place;
  place.values = {macro::Nil{}, macro::Nil{}, 0.0};
  place.writable = true;
  out["position"] = std::move(place);
  for (const auto* name : {"e_position", "e_retracted", "e_restart_extra"}) {
    Variable each;
    each.values.assign(tools, 0.0);
    each.writable = true;
    out[name] = std::move(each);
  }
  out["zhop"] = macro::variable(0.0);
  out["zhop"].writable = true;
}

}  // namespace

Variables print_variables(const Job& job, bool with_settings) {
  Variables out;
  if (with_settings) out = variables_of(job.settings), add_tools(job, out);
  add_boxes(job, out);
  add_figures(job, out);
  add_shares(job, out);
  add_names(job, out);
  out["total_layer_count"] = count(job.plan.layers.size());
  out["max_layer_z"] = macro::variable(to_mm(top_of(job.plan)));
  out["num_objects"] = out["num_instances"] = count(job.plan.objects.size());
  for (const auto* tool :
       {"current_extruder", "previous_extruder", "next_extruder", "filament_extruder_id", "current_object_idx"})
    out[tool] = count(0);
  set_initial_tool(out, 0);
  out["toolchange_z"] = macro::variable(0.0);
  add_place(std::max<std::size_t>(1, job.tools.size()), out);
  add_aliases_of_cura(job, out);
  set_layer(out, 0, 0);
  return out;
}

void set_initial_tool(Variables& variables, ToolId tool) {
  variables["initial_tool"] = variables["initial_extruder"] = count(tool);
  const auto& types = variables["filament_type"].values;
  if (!types.empty()) variables["initial_filament_type"] = macro::variable(types[tool < types.size() ? tool : 0]);
}

void set_layer(Variables& variables, std::size_t index, Um z) {
  variables["layer_num"] = count(index);
  variables["layer_z"] = macro::variable(to_mm(z));
  variables["position"].values[2] = to_mm(z);
}

macro::Template template_of(const HeightMark& mark) {
  std::string code;
  value::parse(mark.text, Unit::none, code);
  return macro::Template(code, "gcode_at_heights");
}

void set_tool_change(Variables& variables, ToolId from, ToolId to, Um z) {
  variables["previous_extruder"] = variables["current_extruder"] = variables["filament_extruder_id"] = count(from);
  variables["next_extruder"] = count(to);
  variables["toolchange_z"] = macro::variable(to_mm(z));
}
void set_filament(Variables& variables, ToolId tool) {
  variables["filament_extruder_id"] = count(tool);
}
void set_current_tool(Variables& variables, ToolId tool) {
  variables["current_extruder"] = variables["filament_extruder_id"] = count(tool);
}

bool has_command(std::string_view code, std::string_view command) {
  while (!code.empty()) {
    const auto end = std::min(code.find('\n'), code.size());
    const auto line = value::trimmed(code.substr(0, end));
    const bool same = line.size() >= command.size() && std::equal(command.begin(), command.end(), line.begin(),
                                                                  [](char a, char b) { return a == upper(b); });
    if (same && (!is_digit(command.back()) || line.size() == command.size() || !is_digit(line[command.size()])))
      return true;
    code.remove_prefix(std::min(end + 1, code.size()));
  }
  return false;
}

Heating heating_in(std::string_view code, const macro::Template& read, const MaterialSettings& material) {
  const auto any_command = [&](std::initializer_list<std::string_view> commands) {
    return std::any_of(commands.begin(), commands.end(), [&](auto command) { return has_command(code, command); });
  };
  const auto mentions = [&](std::initializer_list<std::string_view> names) {
    return std::any_of(read.names().begin(), read.names().end(), [&](const std::string& used) {
      return std::any_of(names.begin(), names.end(), [&](std::string_view name) {
        return used == name || (used.starts_with(name) && used.size() > name.size() && used[name.size()] == '_' &&
                                used.find_first_not_of("0123456789", name.size() + 1) == std::string::npos);
      });
    });
  };
  const auto& m = material;
  return {any_command({"M104", "M109", "M568", "G10 P0 S", "SET_HEATER_TEMPERATURE HEATER=EXTRUDER"}) ||
              (mentions({"material_print_temperature", "material_print_temperature_layer_0", "temperature",
                         "first_layer_temperature"}) &&
               (macro_is_handed(code, m.material_print_temperature) ||
                macro_is_handed(code, m.material_print_temperature_layer_0.value_or(0)))),
          any_command({"M140", "M190", "SET_HEATER_TEMPERATURE HEATER=HEATER_BED"}) ||
              (mentions({"material_bed_temperature", "material_bed_temperature_layer_0", "bed_temperature",
                         "first_layer_bed_temperature"}) &&
               (macro_is_handed(code, m.material_bed_temperature) ||
                macro_is_handed(code, m.material_bed_temperature_layer_0.value_or(0)))),
          any_command({"M141", "M191"}) ||
              (mentions({"build_volume_temperature", "chamber_temperature"}) &&
               macro_is_handed(code, m.build_volume_temperature)) ||
              (mentions({"build_volume_wait_temperature", "chamber_minimal_temperature"}) &&
               macro_is_handed(code, m.build_volume_wait_temperature.value_or(0)))};
}

}  // namespace weft::gcode
