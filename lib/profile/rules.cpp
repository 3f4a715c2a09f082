// SPDX-License-Identifier: GPL-3.0-or-later
#include "profile/rules.h"

#include "settings/value.h"

#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>

namespace weft {
namespace {

/// What a plastic is usually printed at, °C. Source: the ranges that makers of filament print on their spools.
struct Plastic {
  std::string_view name;
  int nozzle_least, nozzle_most, bed_least, bed_most;
};
constexpr std::array plastics{
    Plastic{"PLA", 180, 240, 0, 75},     Plastic{"PETG", 210, 270, 50, 100}, Plastic{"PET", 210, 270, 50, 100},
    Plastic{"ABS", 220, 280, 80, 120},   Plastic{"ASA", 230, 285, 80, 120},  Plastic{"TPU", 195, 260, 0, 90},
    Plastic{"FLEX", 195, 270, 0, 90},    Plastic{"PC", 240, 320, 80, 130},   Plastic{"PA", 230, 310, 30, 120},
    Plastic{"NYLON", 230, 310, 30, 120}, Plastic{"HIPS", 210, 260, 60, 120}, Plastic{"PVA", 170, 230, 0, 75},
    Plastic{"PP", 200, 260, 20, 110},
};

/// Is there a line whose command, and its first word if there is one, are these?
bool commands(std::string_view gcode, std::string_view command, std::string_view word = {}) {
  while (!gcode.empty()) {
    const auto end = gcode.find('\n');
    auto line = value::trimmed(gcode.substr(0, end));
    gcode.remove_prefix(end == std::string_view::npos ? gcode.size() : end + 1);
    line = value::trimmed(line.substr(0, line.find(';')));
    if (!line.starts_with(command)) continue;
    const auto rest = value::trimmed(line.substr(command.size()));
    if (rest.size() + command.size() == line.size() && !rest.empty()) continue;  // M820 is not M82
    if (word.empty() || rest.starts_with(word)) return true;
  }
  return false;
}

class Doubts {
 public:
  explicit Doubts(const Profile& profile) : profile_(profile), s_(profile.settings) {}

  Notices run() {
    beads();
    material();
    speeds();
    cooling();
    reach();
    custom();
    firmware();
    flow();
    surfaces();
    return std::move(out_);
  }

 private:
  void doubt(const char* code, const char* key, const std::string& what) {
    out_.push_back({code, fmt::format("{}: {}: {}", origin_of(profile_, key), key, what)});
  }

  void beads() {
    const Um nozzle = s_.machine.nozzle_diameter;
    const Um first = s_.layers.initial_layer_height.value_or(s_.layers.layer_height);
    for (const auto& [key, height] :
         {std::pair{"layer_height", s_.layers.layer_height}, {"initial_layer_height", first}})
      if (height * 5 > nozzle * 4)
        doubt("profile_high_layers", key,
              fmt::format("{} mm is more than 80 % of nozzle_diameter, {} mm: layers hardly bond", to_mm(height),
                          to_mm(nozzle)));
    const auto width = [&](const char* key, const std::optional<LengthOrShare>& set, Um height) {
      if (!set) return;
      const Um w = set->of(nozzle);
      if (w <= height)
        doubt("profile_width", key,
              fmt::format("{} mm is not more than the height, {} mm: a bead is wider than high", to_mm(w),
                          to_mm(height)));
      else if (w > 3 * nozzle)
        doubt("profile_width", key,
              fmt::format("{} mm is more than three nozzle diameters ({} mm)", to_mm(w), to_mm(nozzle)));
      else if (w * 10 < nozzle * 6)
        doubt("profile_width", key,
              fmt::format("{} mm is less than 60 % of nozzle_diameter, {} mm", to_mm(w), to_mm(nozzle)));
    };
    const Um height = s_.layers.layer_height;
    width("wall_line_width_0", s_.walls.wall_line_width_0, height);
    width("wall_line_width_x", s_.walls.wall_line_width_x, height);
    width("infill_line_width", s_.infill.infill_line_width, height);
    width("skin_line_width", s_.shells.skin_line_width, height);
    width("top_skin_line_width", s_.shells.top_skin_line_width, height);
    width("initial_layer_line_width", s_.layers.initial_layer_line_width, first);
    if (s_.walls.min_wall_line_width.of(nozzle) > s_.walls.max_wall_line_width.of(nozzle))
      doubt("profile_width", "min_wall_line_width", "is more than max_wall_line_width");
    if (s_.walls.wall_line_count == 0 && s_.infill.infill_sparse_density == 0)
      doubt("profile_empty", "wall_line_count", "no walls and no infill: only tops and bottoms are printed");
  }

  void material() {
    const auto& m = s_.material;
    std::string type = m.material_type;
    std::transform(type.begin(), type.end(), type.begin(),
                   [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
    const auto known = std::find_if(plastics.begin(), plastics.end(), [&](const Plastic& p) {
      return type == p.name || type.starts_with(std::string(p.name) + "-") ||
             type.starts_with(std::string(p.name) + "+");
    });
    const auto judge = [&](const char* key, int celsius, int least, int most) {
      if (celsius != 0 && (celsius < least || celsius > most))
        doubt("profile_temperature", key,
              fmt::format("{} °C is unusual for {}, which is printed at {} … {} °C", celsius, m.material_type, least,
                          most));
    };
    if (known != plastics.end()) {
      judge("material_print_temperature", m.material_print_temperature, known->nozzle_least, known->nozzle_most);
      judge("material_print_temperature_layer_0", m.material_print_temperature_layer_0.value_or(0), known->nozzle_least,
            known->nozzle_most);
      judge("material_bed_temperature", m.material_bed_temperature, known->bed_least, known->bed_most);
      judge("material_bed_temperature_layer_0", m.material_bed_temperature_layer_0.value_or(0), known->bed_least,
            known->bed_most);
    }
    if (m.material_print_temperature > 0 && m.material_print_temperature < 150)
      doubt("profile_temperature", "material_print_temperature",
            fmt::format("{} °C melts no filament", m.material_print_temperature));
    const auto d = m.filament_diameter;
    if (std::abs(d - 1750) > 100 && std::abs(d - 2850) > 200)
      doubt("profile_filament", "filament_diameter", fmt::format("{} mm is neither 1.75 nor 2.85 mm", to_mm(d)));
    if (m.material_flow < 80 || m.material_flow > 120)
      doubt("profile_flow", "material_flow", fmt::format("{} % is far from 100 %", value::number(m.material_flow)));
  }

  void speeds() {
    const auto& m = s_.machine;
    const auto& v = s_.speeds;
    const double fastest = std::max(m.machine_max_speed_x, m.machine_max_speed_y);
    const auto speed = [&](const char* key, double mm_s, double most) {
      if (mm_s > most)
        doubt(
            "profile_speed", key,
            fmt::format("{} mm/s is more than the machine's limit, {} mm/s", value::number(mm_s), value::number(most)));
    };
    speed("speed_travel", v.speed_travel, fastest);
    speed("speed_wall_0", v.speed_wall_0, fastest);
    speed("speed_wall_x", v.speed_wall_x, fastest);
    speed("speed_infill", v.speed_infill, fastest);
    if (s_.retraction.retraction_enable && !s_.retraction.firmware_retraction)
      speed("retraction_retract_speed", s_.retraction.retraction_retract_speed, m.machine_max_speed_e);
    if (v.acceleration_enabled &&
        v.acceleration_print > std::max(m.machine_max_acceleration_x, m.machine_max_acceleration_y))
      doubt("profile_acceleration", "acceleration_print",
            fmt::format("{} mm/s² is more than the machine's limit", value::number(v.acceleration_print)));
    if (s_.retraction.retraction_amount > 10'000)
      doubt("profile_retraction", "retraction_amount",
            fmt::format("{} mm draws molten plastic into the cold end", to_mm(s_.retraction.retraction_amount)));
    if (s_.retraction.firmware_retraction && s_.retraction.wipe)
      doubt(
          "profile_retraction", "wipe",
          "while the firmware draws filament back by itself (firmware_retraction), no filament moves during the wipe");
  }

  void cooling() {
    const auto& c = s_.cooling;
    if (c.cool_fan_speed_min > c.cool_fan_speed_max)
      doubt("profile_fan", "cool_fan_speed_min", "is more than cool_fan_speed_max");
    if (c.cool_min_layer_time > c.cool_min_layer_time_fan_speed_max && c.cool_min_layer_time_fan_speed_max > 0)
      doubt("profile_fan", "cool_min_layer_time",
            "is more than cool_min_layer_time_fan_speed_max: the fan jumps instead of rising");
  }

  void reach() {
    const auto& m = s_.machine;
    const Box bed = box_of(print_surface(m)), reach = box_of(reach_area(m));
    if (reach.min.x > bed.min.x || reach.min.y > bed.min.y || reach.max.x < bed.max.x || reach.max.y < bed.max.y)
      doubt("profile_reach", "machine_reach",
            "does not hold the print surface: what is printed at its edge is refused");
    if (m.machine_height > 0 && reach_z_max(m) < m.machine_height)
      doubt("profile_reach", "machine_reach_z_max", "is below machine_height: tall prints are refused");
    if (m.home_position && m.home_position->size() == 1) {
      const Point home = m.home_position->front();
      if (home.x < reach.min.x || home.y < reach.min.y || home.x > reach.max.x || home.y > reach.max.y)
        doubt("profile_reach", "home_position", "lies outside machine_reach");
    }
    if (s_.layers.layer_height > height_of(m)) doubt("profile_reach", "machine_height", "holds no layer");
  }

  void custom() {
    const auto& g = s_.gcode;
    for (const auto& [key, text] :
         {std::pair{"before_layer_gcode", &g.before_layer_gcode}, {"layer_gcode", &g.layer_gcode}}) {
      if (!g.relative_extrusion && commands(*text, "G92", "E0"))
        doubt("profile_extrusion", key, "G92 E0 while E is absolute: weft itself begins each layer at zero");
      if (commands(*text, g.relative_extrusion ? "M82" : "M83"))
        doubt("profile_extrusion", key,
              fmt::format("{} contradicts relative_extrusion = {}", g.relative_extrusion ? "M82" : "M83",
                          g.relative_extrusion));
      if (commands(*text, "G91") && !commands(*text, "G90"))
        doubt("profile_extrusion", key, "G91 without G90: the moves behind it are relative");
    }
    if (value::trimmed(g.machine_start_gcode).empty())
      doubt("profile_custom_gcode", "machine_start_gcode", "is empty: the printer is not homed");
    else if (s_.machine.firmware != Firmware::klipper && !commands(g.machine_start_gcode, "G28"))
      doubt("profile_custom_gcode", "machine_start_gcode",
            "has no G28: the printer is not homed, unless a macro does it");
  }

  /// What firmware makes of curves, and what it knows of pressure.
  void firmware() {
    if (s_.gcode.arc_fitting && s_.machine.firmware == Firmware::klipper) {
      const double piece_mm = to_mm(s_.gcode.arc_segment_length.value_or(1000));
      doubt("profile_arcs", "arc_fitting",
            fmt::format("klipper needs [gcode_arcs]; its pieces of {:g} mm leave arcs below {:.3g} mm radius as lines",
                        piece_mm, piece_mm * piece_mm / (8 * to_mm(s_.gcode.arc_tolerance))));
    }
    if (s_.gcode.arc_fitting && s_.machine.firmware == Firmware::repetier)
      doubt("profile_arcs", "arc_fitting", "many builds of Repetier read no arcs");
    const bool knows_advance = s_.machine.firmware != Firmware::repetier && s_.machine.firmware != Firmware::smoothie;
    if (!s_.material.pressure_advance_model.empty() && !knows_advance)
      doubt("profile_pressure_advance", "pressure_advance_model",
            "this firmware has no command for it: nothing is written");
  }

  /// A slope of flow that acceleration alone does not reach asks for nothing.
  void flow() {
    const auto& v = s_.speeds;
    const Um nozzle = s_.machine.nozzle_diameter, height = s_.layers.layer_height;
    const Um width = length_or(s_.walls.wall_line_width_0, nozzle, rounded(1.05 * nozzle));
    const double mm2 = to_mm(width) * to_mm(height), mm_s2 = v.acceleration_print;
    for (const auto& [key, slope] : {std::pair{"max_extrusion_rate_slope", v.max_extrusion_rate_slope},
                                     {"max_extrusion_rate_slope_down", v.max_extrusion_rate_slope_down}})
      if (slope && *slope >= mm2 * mm_s2 && *slope < 100000)
        doubt("profile_slope", key,
              fmt::format("{} mm³/s² is more than {} mm/s² asks for ({:.0f}): no effect", value::number(*slope),
                          value::number(mm_s2), mm2 * mm_s2));
  }

  void surfaces() {
    const auto& w = s_.walls;
    if (w.magic_fuzzy_skin_enabled && w.magic_fuzzy_skin_thickness > s_.machine.nozzle_diameter)
      doubt("profile_fuzzy_skin", "magic_fuzzy_skin_thickness",
            fmt::format("{} mm is more than nozzle_diameter, {} mm: rough walls part from those behind them",
                        to_mm(w.magic_fuzzy_skin_thickness), to_mm(s_.machine.nozzle_diameter)));
    if (s_.shells.ironing_enabled && s_.shells.ironing_line_spacing > s_.machine.nozzle_diameter)
      doubt("profile_ironing", "ironing_line_spacing",
            fmt::format("{} mm is more than nozzle_diameter, {} mm: what lies between the lines stays rough",
                        to_mm(s_.shells.ironing_line_spacing), to_mm(s_.machine.nozzle_diameter)));
    if (s_.adhesion.brim_ears && s_.adhesion.brim_width == 0)
      doubt("profile_brim", "brim_ears", "brim_width is 0: there is no brim");
    if (s_.adhesion.brim_narrow_width > 0 && s_.adhesion.brim_width == 0)
      doubt("profile_brim", "brim_narrow_width", "brim_width is 0: there is no brim");
  }

  const Profile& profile_;
  const Settings& s_;
  Notices out_;
};

}  // namespace

Notices doubts_about(const Profile& profile) {
  return Doubts(profile).run();
}

}  // namespace weft
