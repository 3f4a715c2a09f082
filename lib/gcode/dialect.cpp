#include "gcode/dialect.h"

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

void Dialect::print_acceleration(Text& out, std::int64_t mm_s2) const {
  out << (firmware == Firmware::klipper ? "SET_VELOCITY_LIMIT ACCEL=" : "M204 P") << mm_s2 << '\n';
}

void Dialect::travel_acceleration(Text& out, std::int64_t mm_s2) const {
  out << (firmware == Firmware::klipper ? "SET_VELOCITY_LIMIT ACCEL=" : "M204 T") << mm_s2 << '\n';
}

void Dialect::define_objects(Text& out, const std::vector<ObjectLabel>& objects,
                             const std::vector<std::string>& names) const {
  if (labels != ObjectLabels::firmware || objects.empty()) return;
  if (firmware == Firmware::marlin) out << "M486 T" << static_cast<std::int64_t>(objects.size()) << '\n';
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
      case Firmware::marlin:
        out << "M486 S" << static_cast<std::int64_t>(i) << "\nM486 A" << names[i] << '\n';
        break;
      case Firmware::reprapfirmware:
        out << "M486 S" << static_cast<std::int64_t>(i) << " A\"" << names[i] << "\"\n";
        break;
    }
  }
  if (firmware != Firmware::klipper) out << "M486 S-1\n";
}

void Dialect::object_start(Text& out, std::uint32_t object, const std::vector<std::string>& names) const {
  if (labels == ObjectLabels::none || object >= names.size()) return;
  if (labels == ObjectLabels::comments)
    out << "; printing object " << names[object] << " id:" << std::int64_t{object} << " copy 0\n";
  else if (firmware == Firmware::klipper)
    out << "EXCLUDE_OBJECT_START NAME=" << names[object] << '\n';
  else
    out << "M486 S" << std::int64_t{object} << '\n';
}

void Dialect::object_end(Text& out, std::uint32_t object, const std::vector<std::string>& names) const {
  if (labels == ObjectLabels::none || object >= names.size()) return;
  if (labels == ObjectLabels::comments)
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
