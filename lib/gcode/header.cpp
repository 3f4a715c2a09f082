// SPDX-License-Identifier: GPL-3.0-or-later
#include "gcode/header.h"

#include "core/base64.h"
#include "core/convex_hull.h"
#include "core/escape.h"
#include "core/version.h"
#include "settings/catalogue.h"
#include "settings/cost.h"
#include "settings/gcode_variables.h"
#include "settings/value.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace weft::gcode {
namespace {

std::string thumbnail_block(const Thumbnail& thumbnail) {
  constexpr std::size_t columns = 78;
  const auto text = base64(thumbnail.png);
  std::string out = fmt::format(";\n; thumbnail begin {}x{} {}\n", thumbnail.width, thumbnail.height, text.size());
  for (std::size_t i = 0; i < text.size(); i += columns) out += "; " + text.substr(i, columns) + "\n";
  return out + "; thumbnail end\n;\n";
}

std::string in_mm(Um v) {
  return value::print(v, Unit::mm);
}

}  // namespace

LayerDigest digest_of(const Job& job, std::size_t layer) {
  return job.digests.empty() ? digest_of(job.settings, job.plan.layers[layer]) : job.digests[layer];
}

Extents extents_of(const Job& job) {
  Extents out;
  for (std::size_t i = 0; i < job.plan.layers.size(); ++i) out.unite(digest_of(job, i).extents);
  return out;
}

Box first_layer_box(const Job& job) {
  Box covered;
  for (std::size_t i = 0; i < job.plan.layers.size(); ++i)
    if (job.plan.layers[i].time.first()) covered.add(digest_of(job, i).covered);
  return covered;
}

Ring first_layer_hull(const Job& job) {
  Ring corners;
  for (std::size_t i = 0; i < job.plan.layers.size(); ++i)
    if (job.plan.layers[i].time.first()) {
      const auto hull = digest_of(job, i).hull;
      corners.insert(corners.end(), hull.begin(), hull.end());
    }
  return convex_hull(std::move(corners));
}

std::size_t tool_changes(const Job& job) {
  std::size_t changes = 0;
  if (job.statistics.tools.size() < 2) return changes;
  ToolId loaded = 0;
  for (std::size_t i = 0; i < job.plan.layers.size(); ++i)
    for (const auto& change : digest_of(job, i).changes)
      changes += std::exchange(loaded, change.tool) != change.tool ? 1U : 0U;
  return changes;
}

std::string duration(double seconds) {
  const auto s = std::llround(std::max(0.0, seconds));
  const auto d = s / 86400, h = s / 3600 % 24, m = s / 60 % 60;
  if (d > 0) return fmt::format("{}d {}h {}m {}s", d, h, m, s % 60);
  if (h > 0) return fmt::format("{}h {}m {}s", h, m, s % 60);
  if (m > 0) return fmt::format("{}m {}s", m, s % 60);
  return fmt::format("{}s", s);
}

namespace {

std::string thumbnails(const Job& job) {
  std::string out;
  for (const auto& thumbnail : job.thumbnails) out += thumbnail_block(thumbnail);
  return out;
}

/// Over all moves; along Z as the dialect means it.
std::string extents_comments(const Job& job, bool of_print) {
  auto box = extents_of(job);
  if (box.empty()) return {};
  if (of_print) {
    box.least.z = job.plan.layers.front().z;
    box.most.z = top_of(job.plan);
  }
  return fmt::format(";MINX:{}\n;MINY:{}\n;MINZ:{}\n;MAXX:{}\n;MAXY:{}\n;MAXZ:{}\n", in_mm(box.least.x),
                     in_mm(box.least.y), in_mm(box.least.z), in_mm(box.most.x), in_mm(box.most.y), in_mm(box.most.z));
}

std::string cura_comments(const Job& job) {
  const auto& s = job.settings;
  const auto& t = job.statistics;
  const char* flavor = s.machine.firmware == Firmware::reprapfirmware ? "RepRap"
                       : s.machine.firmware == Firmware::repetier     ? "Repetier"
                                                                      : "Marlin";
  std::string out = fmt::format(";FLAVOR:{}\n;TIME:{}\n;Filament used: {:.5f}m\n;Layer height: {}\n", flavor,
                                std::llround(t.print_time_s), t.filament_mm / 1000, in_mm(s.layers.layer_height));
  out += extents_comments(job, true);
  out += fmt::format(";TARGET_MACHINE.NAME:{}\n",
                     s.machine.machine_name.empty() ? "Unknown" : escape::gcode_comment(s.machine.machine_name));
  // What print servers know from a line in Cura's start G-code.
  out += fmt::format(";Filament weight = [{:.2f}]\n;Filament type = {}\n;Filament name = {}\n;Nozzle diameter = {}\n",
                     t.filament_g, escape::gcode_comment(s.material.material_type),
                     escape::gcode_comment(s.material.material_type), in_mm(s.machine.nozzle_diameter));
  out += fmt::format(";Generated with Cura_SteamEngine 5.9 comments by weft {}\n", version);
  return out + thumbnails(job) + fmt::format(";LAYER_COUNT:{}\n", job.plan.layers.size());
}

std::string orca_comments(const Job& job) {
  const auto& m = job.settings.material;
  std::string out = fmt::format(
      "; HEADER_BLOCK_START\n; total layer number: {}\n; filament_density: {}\n; filament_diameter: {}\n"
      "; max_z_height: {}\n; HEADER_BLOCK_END\n\n",
      job.plan.layers.size(), value::number(m.material_density), in_mm(m.filament_diameter), in_mm(top_of(job.plan)));
  if (!job.thumbnails.empty()) out += "; THUMBNAIL_BLOCK_START\n" + thumbnails(job) + "; THUMBNAIL_BLOCK_END\n\n";
  out += fmt::format(";LAYER_COUNT:{}\n", job.plan.layers.size()) + extents_comments(job, false);
  return out + "; EXECUTABLE_BLOCK_START\n";
}

/// The first value of a name in gcode_variables, or what stands for it.
std::string further(const Settings& s, std::string_view name, std::string otherwise) {
  for (const auto& v : parse_gcode_variables(s.gcode.gcode_variables))
    if (v.name == name && !v.elements.empty()) return escape::gcode_comment(v.elements[0].text);
  return otherwise;
}

/// "12.50", or of each tool where the plan names some: "12.50, 0.00".
std::string of_tools(const Statistics& t, double all, double Statistics::Tool::*of_tool, double unit) {
  if (t.tools.size() < 2) return fmt::format("{:.2f}", all / unit);
  std::string out;
  for (const auto& tool : t.tools) out += fmt::format("{}{:.2f}", out.empty() ? "" : ", ", tool.*of_tool / unit);
  return out;
}

/// Those that print something.
std::string referenced_tools(const Statistics& t) {
  std::string out;
  for (std::size_t i = 0; i < t.tools.size(); ++i)
    if (t.tools[i].filament_mm3 > 0) out += fmt::format("{}{}", out.empty() ? "" : ",", i);
  return out.empty() ? "0" : out;
}

/// What print servers look for under PrusaSlicer's names. A filament without a colour is shown grey.
std::string named_as_prusaslicer(const Job& job) {
  const auto& s = job.settings;
  const auto& m = s.material;
  std::string out = fmt::format("; filament_type = {}\n", escape::gcode_comment(m.material_type));
  out +=
      fmt::format("; first_layer_height = {}\n", in_mm(s.layers.initial_layer_height.value_or(s.layers.layer_height)));
  out += fmt::format("; first_layer_temperature = {}\n; temperature = {}\n",
                     m.material_print_temperature_layer_0.value_or(m.material_print_temperature),
                     m.material_print_temperature);
  out +=
      fmt::format("; first_layer_bed_temperature = {}\n; bed_temperature = {}\n",
                  m.material_bed_temperature_layer_0.value_or(m.material_bed_temperature), m.material_bed_temperature);
  out += fmt::format("; chamber_temperature = {}\n", m.build_volume_temperature);
  out += fmt::format("; filament_settings_id = {}\n; filament_colour = {}\n; extruder_colour = {}\n",
                     further(s, "filament_settings_id", escape::gcode_comment(m.material_type)),
                     further(s, "filament_colour", "#808080"), further(s, "extruder_colour", "#808080"));
  out += fmt::format("; total toolchanges = {}\n; referenced_tools = {}\n; single_extruder_multi_material = 0\n",
                     tool_changes(job), referenced_tools(job.statistics));
  if (!s.machine.machine_name.empty())
    out += fmt::format("; printer_model = {}\n", escape::gcode_comment(s.machine.machine_name));
  return out;
}

std::string settings_block(const Settings& settings) {
  std::string out = "; weft_settings = begin\n";
  const auto text = as_text(settings);
  for (std::size_t i = 0; i < text.size();) {
    const auto end = text.find('\n', i);
    out += "; " + text.substr(i, end - i) + "\n";
    i = end + 1;
  }
  return out + "; weft_settings = end\n";
}

}  // namespace

Um top_of(const PrintPlan& plan) {
  Um top = 0;
  for (const auto& layer : plan.layers) top = std::max(top, layer.z);
  return top;
}

std::string top_comments(const Job& job) {
  // "PrusaSlicer … on", "OrcaSlicer … on" and "Cura_SteamEngine …" are what Moonraker tells the format by.
  const auto begun = [&](const char* as) {
    return fmt::format("; generated by weft {} (comments as {} on disk)\n{}", version, as, audit_pending);
  };
  switch (job.settings.gcode.gcode_comment_dialect) {
    case CommentDialect::cura:
      return begun("CuraEngine 5") + cura_comments(job);
    case CommentDialect::orca:
      return begun("OrcaSlicer 2.3") + orca_comments(job);
    case CommentDialect::prusaslicer:
      break;
  }
  return begun("PrusaSlicer 2.9") + thumbnails(job) + fmt::format(";LAYER_COUNT:{}\n", job.plan.layers.size()) +
         extents_comments(job, false);
}

std::string bottom_comments(const Job& job) {
  const auto& s = job.settings;
  const auto& t = job.statistics;
  const bool orca = s.gcode.gcode_comment_dialect == CommentDialect::orca;
  std::string out = orca ? "; EXECUTABLE_BLOCK_END\n\n" : "";
  using Tool = Statistics::Tool;
  out += fmt::format("; filament used [mm] = {}\n; filament used [cm3] = {}\n; filament used [g] = {}\n",
                     of_tools(t, t.filament_mm, &Tool::filament_mm, 1),
                     of_tools(t, t.filament_mm3, &Tool::filament_mm3, 1000),
                     of_tools(t, t.filament_g, &Tool::filament_g, 1));
  const auto cost = cost_of(s.machine, s.material, t.filament_g, t.print_time_s);
  if (cost) out += fmt::format("; filament cost = {:.2f}\n", cost->filament);
  out += fmt::format("; total filament used [g] = {:.2f}\n", t.filament_g);
  if (cost)  // PrusaSlicer's word for the first; it knows no price of the machine
    out += fmt::format("; total filament cost = {:.2f}\n; machine cost = {:.2f}\n; total cost = {:.2f}\n",
                       cost->filament, cost->machine, cost->total());
  out += fmt::format("; total layers count = {}\n", job.plan.layers.size());
  out += fmt::format("; estimated printing time (normal mode) = {}\n", duration(t.print_time_s));
  if (!t.silent_layer_s.empty())
    out += fmt::format("; estimated printing time (silent mode) = {}\n",
                       duration(std::accumulate(t.silent_layer_s.begin(), t.silent_layer_s.end(), 0.0)));
  if (!t.layer_s.empty())
    out += fmt::format("; estimated first layer printing time (normal mode) = {}\n", duration(t.layer_s[0]));
  out += orca ? "\n; CONFIG_BLOCK_START\n" : "\n";
  out += named_as_prusaslicer(job) + "\n" + settings_block(s) + job.provenance;
  return orca ? out + "; CONFIG_BLOCK_END\n" : out;
}

}  // namespace weft::gcode
