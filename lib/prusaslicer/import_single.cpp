// SPDX-License-Identifier: GPL-3.0-or-later
#include "prusaslicer/import_single.h"

#include "core/error.h"
#include "core/parts.h"
#include "prusaslicer/text.h"
#include "settings/value.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace weft::prusaslicer {
namespace {

using value::number;

/// Layouts of sparse infill whose lines cross each other within a layer.
constexpr std::array crossing = {"grid", "triangles", "stars", "cubic", "adaptivecubic", "supportcubic"};

/// A filament may bound the speed of sparse infill, and that of lines that cross lower still.
void bound_infill(Lines& lines, double infill_mm_s, const Outlet& out) {
  const auto *plain = lines.find("filament_infill_max_speed"),
             *crossed = lines.find("filament_infill_max_crossing_speed");
  const auto* pattern = lines.look("fill_pattern");
  const bool crosses = pattern && std::find(crossing.begin(), crossing.end(), pattern->value) != crossing.end();
  const auto* bound = crosses ? crossed : plain;
  if (!bound) return;
  const double most = lines.figure(*bound).v;
  if (most > 0 && most < infill_mm_s) out.set("speed_infill", number(most), *bound);
}

void first_layer_infill(Lines& lines, double solid_mm_s, const Outlet& out) {
  const auto* e = lines.find("first_layer_infill_speed");
  if (!e) return;
  const auto speed = lines.figure(*e);
  out.set("speed_topbottom_layer_0", speed.v == 0 ? "auto" : number(speed.of(solid_mm_s)), *e);
}

/// A shield against draughts is a skirt as high as the print.
void draft_shield(Lines& lines, const Outlet& out) {
  const auto* e = lines.find("draft_shield");
  if (!e) return;
  if (e->value != "disabled" && e->value != "limited" && e->value != "enabled")
    lines.refuse(*e, "one of disabled, limited, enabled");
  if (e->value != "enabled") return;
  constexpr int every_layer = 100'000;
  out.set("skirt_height", number(every_layer), *e);
  out.instead_of("skirt_height");
}

/// One object after the other: a head that is round, and a bar along X above it.
void one_at_a_time(Lines& lines, const Outlet& out) {
  const auto* wanted = lines.find("complete_objects");
  const auto *radius = lines.find("extruder_clearance_radius"), *height = lines.find("extruder_clearance_height");
  if (!wanted || !lines.flag(*wanted)) return;
  out.set("print_sequence", "one_at_a_time", *wanted);
  constexpr double usual_mm = 20;  // PrusaSlicer's, of both
  // An octagon around the disc, which is no smaller anywhere.
  if (const double r = radius ? lines.figure(*radius).v : usual_mm, s = r * 0.41421356; r > 0) {
    const auto corner = [](double x, double y) { return number(x, 3) + "x" + number(y, 3); };
    std::string outline;
    for (const auto& [x, y] : {std::pair(r, -s), {r, s}, {s, r}, {-s, r}, {-r, s}, {-r, -s}, {-s, -r}, {s, -r}})
      outline += (outline.empty() ? "0: " : ", ") + corner(x, y);
    out.set("machine_head_profile", outline, radius ? *radius : *wanted);
  }
  out.set("gantry_height", number(height ? lines.figure(*height).v : usual_mm, 3), height ? *height : *wanted);
}

void scarfs(Lines& lines, const Outlet& out) {
  const auto* whole = lines.find("scarf_seam_entire_loop");
  const auto* smooth = lines.find("scarf_seam_only_on_smooth");
  const auto* where = lines.look("scarf_seam_placement");
  if (!where || where->value == "nowhere") return;
  if (whole && lines.flag(*whole)) {
    constexpr int longest_mm = 100;
    out.set("scarf_joint_seam_length", number(longest_mm), *whole);
    out.approximate(*whole, "a scarf is as long as half the loop, and no longer than 100 mm");
  }
  if (smooth && lines.flag(*smooth)) out.approximate(*smooth, "walls with corners get such seams too");
}

/// The character that no part of a substitution has, to stand between its parts.
char slash_for(const std::string& parts) {
  constexpr std::string_view slashes = "/|#~!@%,:;_+&";
  for (const char c : slashes)
    if (parts.find(c) == std::string::npos) return c;
  return '\x01';
}

/// What stands for a group of the expression is `\1` or `$1` there.
std::string groups_by_dollar(std::string text) {
  for (std::size_t i = 0; i + 1 < text.size(); ++i)
    if (text[i] == '\\' && text[i + 1] >= '0' && text[i + 1] <= '9')
      text[i] = '$';
    else if (text[i] == '\\')
      ++i;
    else if (text[i] == '$' && text[i + 1] == '&')
      text[i + 1] = '0';
  return text;
}

/// An element of a list of texts, on one line.
std::string on_one_line(const std::string& element) {
  std::string decoded, out;
  value::parse(element, Unit::none, decoded);
  for (const char c : decoded) out += c == '\n' ? "\\n" : std::string(1, c);
  return out;
}

/// Four texts each: what is looked for, what stands there then, flags, and a note for people.
void substitutions(Lines& lines, const Outlet& out) {
  const auto* e = lines.find("gcode_substitutions");
  if (!e) return;
  const auto texts = texts_of(e->value);
  std::string all;
  for (std::size_t i = 0; i + 2 < texts.size(); i += 4) {
    std::string flags;
    for (const char c : texts[i + 2])
      if (std::string_view("riws").find(c) != std::string_view::npos) flags += c;
    const bool expression = flags.find('r') != std::string::npos;
    const auto find = on_one_line(texts[i]), text = on_one_line(texts[i + 1]);
    const auto replace = expression ? groups_by_dollar(text) : text;
    const char slash = slash_for(find + replace);
    all += fmt::format("{}s{}{}{}{}{}{}", all.empty() ? "" : "\n", slash, find, slash, replace, slash, flags);
  }
  std::string text;  // as weft's ini has texts of several lines
  for (const char c : all) text += c == '\n' ? "\\n" : c == '\\' ? "\\\\" : std::string(1, c);
  out.set("gcode_substitutions", text, *e);
}

/// A lift on the way instead of before it.
void ramping_lift(Lines& lines, const Outlet& out) {
  const auto *ramp = lines.find("travel_ramping_lift"), *lift = lines.find("travel_max_lift"),
             *slope = lines.find("travel_slope");
  if (!ramp || !lines.flag(*ramp)) return;
  const double degrees = slope ? lines.figure(*slope).v : 0;
  out.set("retraction_hop_type", degrees > 0 ? "slope" : "vertical", *ramp);
  if (degrees > 0) out.set("travel_slope", number(std::clamp(degrees, 1.0, 89.0)), *slope);
  if (!lift) return;
  out.set("retraction_hop", number(lines.figure(*lift).v, 3), *lift);
  out.instead_of("retract_lift");
}

/// Without `cooling` the fan does not depend on the time of a layer, and nothing is slowed down.
void cooling(Lines& lines, const Outlet& out) {
  const auto* e = lines.find("cooling");
  if (!e || lines.flag(*e)) return;
  for (const auto& [theirs, ours] : {std::pair{"slowdown_below_layer_time", "cool_min_layer_time"},
                                     {"fan_below_layer_time", "cool_min_layer_time_fan_speed_max"}}) {
    out.set(ours, "0", *e);
    out.instead_of(theirs);
  }
}

/// The share of the model's size that is lost as the plastic cools.
void shrinkage(Lines& lines, const Outlet& out) {
  for (const auto* axis : {"xy", "z"})
    if (const auto* e = lines.find(fmt::format("filament_shrinkage_compensation_{}", axis)))
      out.set(fmt::format("material_shrinkage_percentage_{}", axis), number(100 / (1 - lines.figure(*e).v / 100), 4),
              *e);
}

/// How fast flow may grow, and how fast it may fall; 0 is no limit.
void flow_slopes(Lines& lines, const Outlet& out) {
  constexpr double no_limit = 100000;  // the most that weft takes, and more than any extruder does
  const auto *up = lines.find("max_volumetric_extrusion_rate_slope_positive"),
             *down = lines.find("max_volumetric_extrusion_rate_slope_negative");
  const double most_up = up ? lines.figure(*up).v : 0, most_down = down ? lines.figure(*down).v : 0;
  if (up) out.set("max_extrusion_rate_slope", most_up > 0 ? number(most_up) : "auto", *up);
  const auto* from = down ? down : up;
  if (from == nullptr) return;
  out.set("max_extrusion_rate_slope_down",
          most_down > 0 ? number(most_down)
          : most_up > 0 ? number(no_limit)
                        : "auto",
          *from);
}

/// What layers of varying height may be; 0 is PrusaSlicer's own.
void layer_heights(Lines& lines, const Outlet& out) {
  constexpr double least_mm = 0.02, most_mm = 2;
  if (const auto* e = lines.find("min_layer_height"))
    out.set("adaptive_layer_height_min", number(std::clamp(lines.figure(*e).v, least_mm, most_mm), 3), *e);
  if (const auto* e = lines.find("max_layer_height")) {
    const double mm = lines.figure(*e).v;
    out.set("adaptive_layer_height_max", mm == 0 ? "auto" : number(std::clamp(mm, least_mm, most_mm), 3), *e);
  }
}

/// PrusaSlicer's arcs stand off their moves by as much as it simplifies these.
void arcs(Lines& lines, const Outlet& out) {
  constexpr double least_mm = 0.001, most_mm = 0.1;
  const auto *fitting = lines.look("arc_fitting"), *resolution = lines.find("gcode_resolution");
  if (!fitting || !resolution || fitting->value == "disabled" || fitting->value == "0") return;
  out.set("arc_tolerance", number(std::clamp(lines.figure(*resolution).v, least_mm, most_mm), 3), *resolution);
}

/// Limits of silent mode: the second values of each limit, where all of them have one.
void silent_limits(Lines& lines, const Outlet& out) {
  const auto* wanted = lines.find("silent_mode");
  const auto* flavor = lines.look("gcode_flavor");
  if (!wanted || !lines.flag(*wanted) || !flavor || !flavor->value.starts_with("marlin")) return;
  std::string all;
  for (const auto* key :
       {"machine_max_feedrate_x", "machine_max_feedrate_y", "machine_max_feedrate_z", "machine_max_feedrate_e",
        "machine_max_acceleration_x", "machine_max_acceleration_y", "machine_max_acceleration_z",
        "machine_max_acceleration_e", "machine_max_jerk_x", "machine_max_jerk_z", "machine_max_jerk_e"}) {
    const auto* e = lines.look(key);
    const auto values = e ? parts(e->value, ',') : std::vector<std::string_view>{};
    if (values.size() < 2) return;
    double v = 0;
    try {
      value::parse(values[1], Unit::none, v);
    } catch (const std::invalid_argument&) {
      return;
    }
    if (!(v > 0)) return;
    all += (all.empty() ? "" : ", ") + number(std::clamp(v, 0.01, 100000.0));
  }
  out.set("machine_silent_limits", all, *wanted);
}

/// Which walls are rough.
void fuzzy_skin(Lines& lines, const Outlet& out) {
  const auto* e = lines.find("fuzzy_skin");
  if (!e) return;
  if (e->value != "none" && e->value != "external" && e->value != "all") lines.refuse(*e, "one of none, external, all");
  out.set("magic_fuzzy_skin_enabled", e->value == "none" ? "false" : "true", *e);
  if (e->value != "none") out.set("magic_fuzzy_skin_outside_only", e->value == "external" ? "true" : "false", *e);
}

/// What is written at a height: PrusaSlicer's own words are its printers', and no profile's.
void at_heights(Lines& lines, const Outlet& out) {
  for (const auto& [theirs, ours] :
       {std::pair{"color_change_gcode", "color_change_gcode"}, std::pair{"pause_print_gcode", "pause_gcode"}})
    if (const auto* e = lines.find(theirs); e && e->line != 0) out.set(ours, e->value, *e);
}

struct Remarked {
  std::string_view key, neutral, why;
};
/// What weft does otherwise for a reason, and says so.
constexpr std::array remarked = {
    Remarked{"post_process", "",
             "a profile starts no programs; weft batch --exec runs one on each finished file, weft slice leaves it to "
             "the shell"},
    Remarked{"binary_gcode", "0",
             "the file is plain text, which printers of binary G-code read too; Prusa's bgcode packs it"},
    Remarked{"extrusion_axis", "E", "E is written: every firmware of gcode_flavor's list reads it"},
    Remarked{"travel_lift_before_obstacle", "0",
             "a slope is as steep as travel_slope says; it begins above all that is printed"},
};

}  // namespace

void automatic_widths(Lines& lines) {
  if (!lines.flag("automatic_extrusion_widths", false)) return;
  for (const auto* key :
       {"extrusion_width", "first_layer_extrusion_width", "perimeter_extrusion_width",
        "external_perimeter_extrusion_width", "infill_extrusion_width", "solid_infill_extrusion_width",
        "top_infill_extrusion_width", "support_material_extrusion_width"})
    lines.replace(key, "0");
}

void import_single_keys(Lines& lines, double infill_mm_s, double solid_mm_s, const Outlet& out) {
  if (const auto* e = lines.find("printer_technology"); e && e->value != "FFF")
    lines.refuse(*e, "FFF: a printer that cures resin takes pictures of layers, no G-code");
  bound_infill(lines, infill_mm_s, out);
  first_layer_infill(lines, solid_mm_s, out);
  draft_shield(lines, out);
  one_at_a_time(lines, out);
  scarfs(lines, out);
  ramping_lift(lines, out);
  cooling(lines, out);
  substitutions(lines, out);
  fuzzy_skin(lines, out);
  shrinkage(lines, out);
  flow_slopes(lines, out);
  at_heights(lines, out);
  layer_heights(lines, out);
  arcs(lines, out);
  silent_limits(lines, out);
  for (const auto& row : remarked)
    if (const auto* e = lines.find(row.key); e && !says_one_of(row.neutral, e->key, e->value))
      out.approximate(*e, std::string(row.why));
}

}  // namespace weft::prusaslicer
