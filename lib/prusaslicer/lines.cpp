// SPDX-License-Identifier: GPL-3.0-or-later
#include "prusaslicer/lines.h"

#include "core/error.h"
#include "prusaslicer/keys.h"
#include "prusaslicer/old_keys.h"
#include "prusaslicer/text.h"
#include "settings/value.h"

#include <array>
#include <stdexcept>

#include <fmt/format.h>

namespace weft::prusaslicer {
namespace {

using value::trimmed;

/// A value in an old spelling, and what it is today; `*`: whatever it says.
struct OldSpelling {
  std::string_view key, then, now;
};
constexpr std::array old_spellings{
    OldSpelling{"perimeter_acceleration", "25",
                "0"},  // the defaults of a Slic3r that switched accelerations off beside them
    OldSpelling{"infill_acceleration", "50", "0"},
    OldSpelling{"support_material_pattern", "pillars", "rectilinear"},
    OldSpelling{"draft_shield", "0", "disabled"},
    OldSpelling{"draft_shield", "1", "enabled"},
    OldSpelling{"gcode_label_objects", "0", "disabled"},
    OldSpelling{"gcode_label_objects", "1", "octoprint"},
    OldSpelling{"gcode_flavor", "makerbot", "makerware"},
    OldSpelling{"gcode_flavor", "marlinfirmware", "marlin2"},
    OldSpelling{"fill_pattern", "monotonous", "monotonic"},
    OldSpelling{"top_fill_pattern", "monotonous", "monotonic"},
    OldSpelling{"bottom_fill_pattern", "monotonous", "monotonic"},
    OldSpelling{"ensure_vertical_shell_thickness", "1", "enabled"},
    OldSpelling{"ensure_vertical_shell_thickness", "0", "partial"},
    OldSpelling{"retract_length_toolchange", "30;30", "30,30"},  // gCreate's bundle; PrusaSlicer reads one 30 for all
};

/// Lines whose key and value both changed.
void modernise(IniEntry& e) {
  const auto share = [&](std::string_view now) {  // a factor became a percentage
    double factor = 0;
    try {
      value::parse(e.value, Unit::none, factor);
      e.value = value::number(factor * 100) + "%";
    } catch (const std::invalid_argument&) {
      // told where the value is read
    }
    e.key = now;
  };
  if (e.key == "extrusion_width_ratio")
    share("extrusion_width");
  else if (e.key == "first_layer_height_ratio")
    share("first_layer_height");
  else if (e.key == "bottom_layer_speed_ratio")
    share("first_layer_speed");
  else if (e.key == "randomize_start" && trimmed(e.value) == "1")
    e.key = "seam_position", e.value = "random";
  else if (e.key == "skirt_height" && trimmed(e.value) == "-1")
    e.key = "draft_shield", e.value = "enabled";
  else if (e.key == "bed_size") {
    const auto parts = elements_of(e.key, e.value);
    if (parts.size() == 2) e.key = "bed_shape", e.value = fmt::format("0x0,{0}x0,{0}x{1},0x{1}", parts[0], parts[1]);
  } else {
    e.key = std::string(current_name(e.key));
    for (const auto& old : old_spellings)
      if (old.key == e.key && old.then == trimmed(e.value)) {
        e.value = old.now;
        break;
      }
  }
}

/// A list of numbers, one for each filament or extruder, that is empty: vendors' bundles have `filament_cost =`, and
/// PrusaSlicer then takes what it takes without the key.
bool says_nothing(const IniEntry& e) {
  if (!e.value.empty()) return false;
  const auto plain = [](const Key* row) {
    return row && row->written == Written::plain && row->form != Form::none ? row : nullptr;
  };
  const std::string_view key = e.key;
  const bool of_filament = key.starts_with("filament_");
  if (const auto* row = plain(find_key(key))) return row->of_filament || of_filament;
  const auto* row = of_filament ? plain(find_key(key.substr(9))) : nullptr;  // a filament's own value of another key
  return row && row->of_filament;
}

}  // namespace

std::string first_text(const IniEntry& e) {
  const auto all = elements_of(e.key, e.value);
  return all.empty() ? std::string() : all.front();
}

Lines::Lines(std::vector<IniEntry> entries, const std::string& path) : path_(path) {
  for (auto& e : entries) {
    cut_comment(e);
    bool spread = false;
    for (const auto& row : shortcuts)  // one key then that is two today, each of which may stand for itself as well
      if (row.then == e.key) {
        auto other = e;
        other.key = row.now;
        if (const auto* known = look(other.key); !known || known->line == 0) by_key_[other.key] = other;
        spread = true;
      }
    if (spread) continue;
    modernise(e);
    if (!says_nothing(e)) by_key_[e.key] = e;
  }
  for (const auto& row : keys()) {
    if (!row.of_filament) continue;
    const auto at = by_key_.find("filament_" + std::string(row.name));
    if (at == by_key_.end()) continue;
    seen_.insert(at->first);
    if (elements_of(row.name, at->second.value).front() != "nil") {
      auto line = at->second;
      line.key = row.name;
      by_key_[std::string(row.name)] = line;
    }
  }
}

const IniEntry* Lines::find(std::string_view key) {
  const auto* e = look(key);
  if (e) seen_.insert(e->key);
  return e;
}
const IniEntry* Lines::look(std::string_view key) const {
  const auto at = by_key_.find(key);
  return at == by_key_.end() ? nullptr : &at->second;
}

void Lines::replace(std::string_view key, std::string value) {
  if (const auto at = by_key_.find(key); at != by_key_.end()) at->second.value = std::move(value);
}

void Lines::refuse(const IniEntry& e, std::string_view what) const {
  throw Error{Error::Kind::settings, fmt::format("{}: '{}' is not {}", e.key, e.value.substr(0, 60), what),
              fmt::format("{}:{}", path_, e.line), "PrusaSlicer would read it as another number or drop it"};
}

Figure Lines::figure(const IniEntry& e) const {
  const auto elements = elements_of(e.key, e.value);
  Figure out;
  for (auto element = elements.rbegin(); element != elements.rend(); ++element) {  // all must parse, the first holds
    std::string_view text = *element;
    out.percent = !text.empty() && text.back() == '%';
    if (out.percent) text = trimmed(text.substr(0, text.size() - 1));
    if (text == "nil" && element + 1 != elements.rend()) continue;
    try {
      value::parse(text, Unit::none, out.v);
    } catch (const std::invalid_argument&) {
      refuse(e, elements.size() > 1 ? "a list of numbers" : "a number");
    }
  }
  return out;
}
std::optional<Figure> Lines::figure(std::string_view key) {
  const auto* e = find(key);
  return e ? std::optional(figure(*e)) : std::nullopt;
}
double Lines::number(std::string_view key, double otherwise) {
  const auto f = figure(key);
  return f ? f->v : otherwise;
}
bool Lines::flag(const IniEntry& e) const {
  const auto elements = elements_of(e.key, e.value);
  for (const auto& text : elements)
    if (text != "0" && text != "1") refuse(e, "0 or 1");
  return elements.front() == "1";
}
bool Lines::flag(std::string_view key, bool otherwise) {
  const auto* e = find(key);
  return e ? flag(*e) : otherwise;
}

void Lines::cut_comment(IniEntry& e) {
  if (is_text(e.key) || e.value.empty() ||
      std::string_view("0123456789.-").find(e.value.front()) == std::string_view::npos)
    return;
  const auto hash = std::min(e.value.find(" #"), e.value.find(" ;"));
  if (hash == std::string::npos) return;
  commented_.push_back(e);
  e.value = std::string(trimmed(std::string_view(e.value).substr(0, hash)));
}

std::vector<const IniEntry*> Lines::unread() const {
  std::vector<const IniEntry*> out;
  for (const auto& [key, entry] : by_key_)
    if (seen_.find(key) == seen_.end()) out.push_back(&entry);
  return out;
}

}  // namespace weft::prusaslicer
