// SPDX-License-Identifier: GPL-3.0-or-later
#include "gcode/dialect.h"

#include "settings/value.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace weft::gcode {
namespace {

void point(Text& out, Point p) {
  out.spelled(p.x) << ',';
  out.spelled(p.y);
}

/// Cut to `most` bytes, but not within a character of UTF-8.
std::string cut(std::string text, std::size_t most) {
  if (text.size() <= most) return text;
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xC0U) == 0x80U) --most;
  text.resize(most);
  return text;
}

/// Firmware needs to know about where an object is: at most some 60 corners of its outline.
Ring thinned(const Ring& ring) {
  constexpr std::size_t most = 60;
  const std::size_t every = (ring.size() + most - 1) / most;
  Ring out;
  for (std::size_t i = 0; i < ring.size(); i += every) out.push_back(ring[i]);
  return out;
}

std::string one_word(const std::string& name) {
  std::string out = name.empty() ? "object" : name;
  for (char& c : out) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       static_cast<unsigned char>(c) >= 0x80;
    if (!plain) c = '_';
  }
  return out;
}

}  // namespace

void Dialect::fan(Text& out, double share) const {
  const auto pwm = static_cast<std::int64_t>(std::lround(255 * std::clamp(share, 0.0, 1.0)));
  if (firmware == Firmware::reprapfirmware)
    out << "M106 S" << fmt::format("{:.3g}", static_cast<double>(pwm) / 255.0) << '\n';
  else if (pwm == 0)
    out << "M107\n";
  else
    out << "M106 S" << pwm << '\n';
}

void Dialect::pressure_advance(Text& out, double seconds, ToolId tool) const {
  const auto value = fmt::format("{:.4f}", seconds);
  switch (firmware) {
    case Firmware::klipper:
      out << "SET_PRESSURE_ADVANCE ADVANCE=" << value << '\n';
      break;
    case Firmware::marlin:
    case Firmware::marlin2:
      out << "M900 K" << value << '\n';
      break;
    case Firmware::reprapfirmware:
      out << "M572 D" << std::int64_t{tool} << " S" << value << '\n';
      break;
    case Firmware::repetier:
    case Firmware::smoothie:
      break;
  }
}

void Dialect::print_acceleration(Text& out, std::int64_t mm_s2) const {
  switch (firmware) {
    case Firmware::klipper:
      out << "SET_VELOCITY_LIMIT ACCEL=" << mm_s2 << '\n';
      break;
    case Firmware::marlin2:
    case Firmware::reprapfirmware:
      out << "M204 P" << mm_s2 << '\n';
      break;
    case Firmware::marlin:
    case Firmware::smoothie:
      out << "M204 S" << mm_s2 << '\n';
      break;
    case Firmware::repetier:
      out << "M201 X" << mm_s2 << " Y" << mm_s2 << '\n';
      break;
  }
}

void Dialect::travel_acceleration(Text& out, std::int64_t mm_s2) const {
  switch (firmware) {
    case Firmware::marlin2:
    case Firmware::reprapfirmware:
      out << "M204 T" << mm_s2 << '\n';
      break;
    case Firmware::repetier:
      out << "M202 X" << mm_s2 << " Y" << mm_s2 << '\n';
      break;
    default:
      print_acceleration(out, mm_s2);
  }
}

void Dialect::select(Text& out, ToolId tool) const {
  if (tool_select == ToolSelect::swap) return color_change(out, fmt::format("load T{}", int{tool}));
  if (tool_select == ToolSelect::t || firmware != Firmware::klipper)
    out << 'T' << std::int64_t{tool} << '\n';
  else if (tool == 0)
    out << "ACTIVATE_EXTRUDER EXTRUDER=extruder\n";
  else
    out << "ACTIVATE_EXTRUDER EXTRUDER=extruder" << std::int64_t{tool} << '\n';
}

void Dialect::temperature(Text& out, const SetTemperature& heat) const {
  using Heater = SetTemperature::Heater;
  const auto set = [&](std::string_view at_once, std::string_view waiting) {
    out << (heat.wait ? waiting : at_once);
    if (heat.heater == Heater::nozzle && heat.tool != any_tool) out << " T" << std::int64_t{heat.tool};
    out << " S" << std::int64_t{heat.celsius} << '\n';
  };
  switch (heat.heater) {
    case Heater::bed:
      return set("M140", "M190");
    case Heater::chamber:
      return set("M141", "M191");
    case Heater::nozzle:
      break;
  }
  if (firmware != Firmware::reprapfirmware || heat.tool == any_tool) return set("M104", "M109");
  // R is what it has while another tool is loaded: a nozzle that waits is at that.
  out << "G10 P" << std::int64_t{heat.tool} << " S" << std::int64_t{heat.celsius} << " R" << std::int64_t{heat.celsius}
      << '\n';
  if (heat.wait) out << "M116 P" << std::int64_t{heat.tool} << '\n';
}

/// Source: Duet3D, "GCode dictionary", M568, since 3.3: A1 is standby. Older firmware answers with its settings.
void Dialect::stand_by(Text& out, ToolId tool) const {
  if (selects_to_heat()) out << "M568 P" << std::int64_t{tool} << " A1\n";
}

std::string_view Dialect::advance_command() const {
  switch (firmware) {
    case Firmware::klipper:
      return "SET_PRESSURE_ADVANCE";
    case Firmware::reprapfirmware:
      return "M572";
    case Firmware::marlin:
    case Firmware::marlin2:
      return "M900";
    case Firmware::repetier:
    case Firmware::smoothie:
      break;
  }
  return {};
}

void Dialect::hold(Text& out, bool advance) const {
  const bool marlin = firmware == Firmware::marlin || firmware == Firmware::marlin2;
  if (marlin) out << "M220 B\nM220 S100\n";
  if (!advance) return;
  if (marlin) out << "M900 K0\n";
  if (firmware == Firmware::klipper) out << "SET_PRESSURE_ADVANCE ADVANCE=0\n";
  if (firmware == Firmware::reprapfirmware) out << "M572 D0 S0\n";
}

void Dialect::release(Text& out) const {
  if (firmware == Firmware::marlin || firmware == Firmware::marlin2) out << "M220 R\n";
}

void Dialect::mix(Text& out, double share) const {
  if (firmware == Firmware::reprapfirmware)
    out << fmt::format("M567 P0 E{:.3f}:{:.3f}\n", 1 - share, share);
  else
    out << fmt::format("M163 S0 P{:.3f}\nM163 S1 P{:.3f}\nM164 S0\n", 1 - share, share);
}

void Dialect::pause(Text& out, const std::string& text) const {
  switch (firmware) {
    case Firmware::klipper:
      if (!text.empty()) out << "M117 " << text << '\n';
      out << "PAUSE\n";
      break;
    case Firmware::reprapfirmware:
      if (!text.empty()) out << "M117 " << text << '\n';
      out << "M226\n";
      break;
    case Firmware::repetier:
      out << "@pause" << (text.empty() ? "" : " ") << text << '\n';
      break;
    case Firmware::smoothie:
      if (!text.empty()) out << "M117 " << text << '\n';
      out << "M600\n";
      break;
    case Firmware::marlin:
    case Firmware::marlin2:
      out << "M0" << (text.empty() ? "" : " ") << text << '\n';
      break;
  }
}

void Dialect::color_change(Text& out, const std::string& text) const {
  if (firmware == Firmware::klipper || firmware == Firmware::repetier)
    return pause(out, text.empty() ? "change the filament" : text);
  if (!text.empty()) out << "M117 " << text << '\n';
  out << "M600\n";
}

std::string Dialect::machine_limits(const MachineSettings& m) const {
  const auto axes = [](double x, double y, double z, double e) {
    return fmt::format(" X{} Y{} Z{} E{}", value::number(x, 3), value::number(y, 3), value::number(z, 3),
                       value::number(e, 3));
  };
  const auto accelerations = "M201" + axes(m.machine_max_acceleration_x, m.machine_max_acceleration_y,
                                           m.machine_max_acceleration_z, m.machine_max_acceleration_e);
  const auto speeds = [&](double unit) {
    return "M203" + axes(unit * m.machine_max_speed_x, unit * m.machine_max_speed_y, unit * m.machine_max_speed_z,
                         unit * m.machine_max_speed_e);
  };
  const auto jerk = value::number(m.machine_max_jerk, 3);
  const auto deviation = m.machine_junction_deviation ? value::number(*m.machine_junction_deviation, 4) : "";
  switch (firmware) {
    case Firmware::klipper:
      return {};
    case Firmware::marlin:
      return fmt::format("{}\n{}\nM205 X{}\n", accelerations, speeds(1), jerk);  // X is X and Y
    case Firmware::marlin2:
      return fmt::format("{}\n{}\nM205 {}\n", accelerations, speeds(1),
                         deviation.empty() ? fmt::format("X{} Y{}", jerk, jerk) : "J" + deviation);
    case Firmware::reprapfirmware: {  // mm/min
      const auto jerk_min = value::number(60 * m.machine_max_jerk, 3);
      return fmt::format("{}\n{}\nM566 X{} Y{}\n", accelerations, speeds(60), jerk_min, jerk_min);
    }
    case Firmware::repetier:  // its M203 watches temperatures; speeds are of its configuration
      return fmt::format("{}\nM207 X{}\n", accelerations, jerk);
    case Firmware::smoothie:
      return fmt::format("M203 X{} Y{} Z{}\n{}", value::number(m.machine_max_speed_x, 3),
                         value::number(m.machine_max_speed_y, 3), value::number(m.machine_max_speed_z, 3),
                         deviation.empty() ? "" : fmt::format("M205 X{}\n", deviation));
  }
  return {};
}

std::string Dialect::progress(Progress p) const {
  if (firmware == Firmware::repetier || firmware == Firmware::smoothie) return {};
  return fmt::format("M73 P{} R{}\n", p.percent, p.minutes);
}

std::string Dialect::silent_progress(Progress p) const {
  if (firmware != Firmware::marlin && firmware != Firmware::marlin2) return {};
  return fmt::format("M73 Q{} S{}\n", p.percent, p.minutes);
}

bool Dialect::in_commands() const {
  return labels == ObjectLabels::firmware &&
         (firmware == Firmware::klipper || firmware == Firmware::marlin2 || firmware == Firmware::reprapfirmware);
}
bool Dialect::in_comments() const {
  return labels != ObjectLabels::none && !in_commands();
}

void Dialect::define_objects(Text& out, const std::vector<ObjectLabel>& objects,
                             const std::vector<std::string>& names) const {
  if (!in_commands() || objects.empty()) return;
  if (firmware == Firmware::marlin2) out << "M486 T" << static_cast<std::int64_t>(objects.size()) << '\n';
  for (std::size_t i = 0; i < objects.size(); ++i) {
    switch (firmware) {
      case Firmware::klipper:
        out << "EXCLUDE_OBJECT_DEFINE NAME=" << names[i] << " CENTER=";
        point(out, objects[i].centre);
        out << " POLYGON=[";
        for (const char* before = "["; const Point p : thinned(objects[i].outline)) {
          out << before;
          point(out, p);
          out << ']';
          before = ",[";
        }
        out << "]\n";
        break;
      case Firmware::marlin2:
        out << "M486 S" << static_cast<std::int64_t>(i) << "\nM486 A" << names[i] << '\n';
        break;
      case Firmware::reprapfirmware:
        out << "M486 S" << static_cast<std::int64_t>(i) << " A\"" << names[i] << "\"\n";
        break;
      default:
        break;
    }
  }
  if (firmware != Firmware::klipper) out << "M486 S-1\n";
}

void Dialect::object_start(Text& out, std::uint32_t object, const std::vector<std::string>& names) const {
  if (labels == ObjectLabels::none || object >= names.size()) return;
  if (in_comments() && comments == CommentDialect::cura)
    out << ";MESH:" << names[object] << '\n';
  else if (in_comments())
    out << "; printing object " << names[object] << " id:" << std::int64_t{object} << " copy 0\n";
  else if (firmware == Firmware::klipper)
    out << "EXCLUDE_OBJECT_START NAME=" << names[object] << '\n';
  else
    out << "M486 S" << std::int64_t{object} << '\n';
}

void Dialect::object_end(Text& out, std::uint32_t object, const std::vector<std::string>& names) const {
  if (labels == ObjectLabels::none || object >= names.size()) return;
  if (in_comments() && comments == CommentDialect::cura)
    out << ";MESH:NONMESH\n";
  else if (in_comments())
    out << "; stop printing object " << names[object] << " id:" << std::int64_t{object} << " copy 0\n";
  else if (firmware == Firmware::klipper)
    out << "EXCLUDE_OBJECT_END NAME=" << names[object] << '\n';
  else
    out << "M486 S-1\n";
}

std::vector<std::string> label_names(const std::vector<ObjectLabel>& objects) {
  std::vector<std::string> names;
  for (const auto& object : objects) {
    const auto plain = one_word(object.name);
    auto name = cut(plain, 60);
    for (int n = 2; std::find(names.begin(), names.end(), name) != names.end(); ++n)
      name = cut(plain, 54) + fmt::format("_{}", n);
    names.push_back(std::move(name));
  }
  return names;
}

}  // namespace weft::gcode
