#include "settings/prusaslicer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

#include "core/error.h"
#include "settings/prusaslicer_keys.h"
#include "settings/value.h"

namespace weft::prusaslicer {
namespace {

using value::number;
using value::trimmed;

/// A number, or a share in percent.
struct Figure {
  double v = 0;
  bool percent = false;
};

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> out;
  for (;;) {
    const auto at = text.find(separator);
    out.push_back(trimmed(text.substr(0, at)));
    if (at == std::string_view::npos) return out;
    text.remove_prefix(at + 1);
  }
}

/// The first element of PrusaSlicer's list of texts, which are quoted when they hold what would split them.
std::string first_text(std::string_view text) {
  text = trimmed(text);
  if (text.empty() || text.front() != '"') return std::string(trimmed(text.substr(0, text.find(';'))));
  std::string out;
  for (std::size_t i = 1; i < text.size() && text[i] != '"'; ++i) {
    if (text[i] == '\\' && i + 1 < text.size()) {
      const char c = text[++i];
      if (c == '"') out += '"';
      else (out += '\\') += c;  // \n, \r and \\ mean the same to weft
    } else {
      out += text[i];
    }
  }
  return out;
}

/// The lines of a config.ini by key, and the arithmetic between them.
class Translator {
 public:
  Translator(const std::vector<IniEntry>& entries, const std::string& path) : path_(path) {
    for (const auto& e : entries) by_key_[std::string(current_name(e.key))] = &e;
  }

  Translation run() {
    machine();
    widths();
    speeds();
    fills();
    extrusion();
    texts();
    for (const auto& row : same_rows) copy(row);
    sort_out_the_rest();
    return std::move(out_);
  }

 private:
  const IniEntry* find(std::string_view key) {
    const auto at = by_key_.find(std::string(key));
    if (at == by_key_.end()) return nullptr;
    seen_.push_back(at->first);
    return at->second;
  }

  [[noreturn]] void refuse(const IniEntry& e, const char* what) const {
    throw Error{Error::Kind::settings, fmt::format("{}: '{}' is not {}", e.key, e.value, what), fmt::format("{}:{}", path_, e.line),
                "PrusaSlicer would read it as another number or drop it"};
  }

  /// The first element: weft prints with one extruder, and of pairs for normal and silent mode the first is the normal one.
  Figure figure(const IniEntry& e) const {
    auto text = split(e.value, ',').front();
    Figure out;
    if (!text.empty() && text.back() == '%') out.percent = true, text.remove_suffix(1);
    try {
      value::parse(text, Unit::none, out.v);
    } catch (const std::invalid_argument&) {
      refuse(e, "a number");
    }
    return out;
  }
  std::optional<Figure> figure(std::string_view key) {
    const auto* e = find(key);
    return e ? std::optional(figure(*e)) : std::nullopt;
  }
  double plain(std::string_view key, double otherwise) {
    const auto f = figure(key);
    return f ? f->v : otherwise;
  }
  bool flag(const IniEntry& e) const {
    const auto text = split(e.value, ',').front();
    if (text != "0" && text != "1") refuse(e, "0 or 1");
    return text == "1";
  }

  void set(std::string_view key, std::string text, int line) { out_.assignments.push_back({std::string(key), std::move(text), line}); }
  void approximate(const IniEntry& e, std::string why) { out_.approximated.push_back({e.key, e.value, e.line, std::move(why)}); }

  void copy(const SameRow& row) {
    const auto* e = find(row.theirs);
    if (!e || e->value == "nil") return;
    switch (row.form) {
      case Form::length: return set(row.ours, number(figure(*e).v, 3), e->line);
      case Form::number: return set(row.ours, number(figure(*e).v), e->line);
      case Form::times_100: return set(row.ours, number(figure(*e).v * 100), e->line);
      case Form::zero_is_auto: return set(row.ours, figure(*e).v == 0 ? "auto" : number(figure(*e).v, 3), e->line);
      case Form::share: {
        const auto f = figure(*e);
        return set(row.ours, number(f.v, 3) + (f.percent ? "%" : ""), e->line);
      }
      case Form::flag: return set(row.ours, flag(*e) ? "true" : "false", e->line);
      case Form::text: return set(row.ours, first_text(e->value), e->line);
      case Form::choice:
        for (const auto& c : choice_rows) {
          if (c.key != row.theirs || c.theirs != e->value) continue;
          set(row.ours, std::string(c.ours), e->line);
          if (!c.loss.empty()) approximate(*e, std::string(c.loss));
          return;
        }
        refuse(*e, "one of the values PrusaSlicer knows");
    }
  }

  void machine() {
    if (const auto* e = find("bed_shape")) {
      Ring bed;
      try {
        value::parse(e->value, Unit::mm, bed);
      } catch (const std::invalid_argument&) {
        refuse(*e, "a list of points in mm");
      }
      const Box box = box_of(bed);
      const bool rectangle = bed.size() == 4 && box.min == Point{0, 0} && std::abs(double_area(bed)) == 2 * std::int64_t{box.max.x} * box.max.y;
      set("bed_shape", rectangle ? "rectangle" : "polygon", e->line);
      if (rectangle) {
        set("machine_width", value::print(box.max.x, Unit::mm), e->line);
        set("machine_depth", value::print(box.max.y, Unit::mm), e->line);
      } else {
        set("bed_polygon", value::print(bed, Unit::mm), e->line);
      }
    }
    for (const auto* axis : {"x", "y", "z", "e"})
      for (const auto& [theirs, ours] : {std::pair{"machine_max_feedrate_", "machine_max_speed_"}, {"machine_max_acceleration_", "machine_max_acceleration_"}})
        if (const auto* e = find(std::string(theirs) + axis)) set(std::string(ours) + axis, number(figure(*e).v), e->line);
  }

  /// Widths: a share is of the layer height, 0 is automatic: the general width, else 1.125 × nozzle (1 × for tops).
  void widths() {
    const double nozzle = plain("nozzle_diameter", 0.4), height = plain("layer_height", 0.2);
    const auto in_mm = [&](Figure f) { return f.percent ? f.v / 100 * height : f.v; };
    if (const auto* e = find("first_layer_height")) {
      const auto f = figure(*e);
      set("initial_layer_height", number(f.percent ? f.v / 100 * height : f.v, 3), e->line);
    }
    const auto general = figure("extrusion_width");
    for (const auto& row : width_rows) {
      const auto* e = find(row.theirs);
      const auto own = e ? std::optional(figure(*e)) : std::nullopt;
      const auto* base = find("extrusion_width");
      if (!e && !base) continue;
      double width = own ? in_mm(*own) : 0;
      if (width == 0 && general) width = in_mm(*general);
      if (width == 0) width = row.automatic * nozzle;
      set(row.ours, number(width, 3), e ? e->line : base->line);
    }
  }

  /// Speeds: a share is of another speed; 0 is PrusaSlicer's automatic speed, bounded by max_print_speed.
  void speeds() {
    const double fastest = plain("max_print_speed", 80);
    std::map<std::string_view, double> known;
    for (const auto& row : speed_rows) {
      const auto* e = find(row.theirs);
      if (!e) continue;
      const auto f = figure(*e);
      const auto base = known.find(row.base);
      double speed = f.percent ? f.v / 100 * (base == known.end() ? fastest : base->second) : f.v;
      if (speed == 0) {
        speed = fastest;
        approximate(*e, fmt::format("automatic speed becomes max_print_speed, {} mm/s", number(fastest)));
      }
      known[row.theirs] = speed;
      set(row.ours, number(speed), e->line);
    }
    bool any = false;
    for (const auto& row : acceleration_rows)
      if (const auto* e = find(row.theirs)) {
        const double a = figure(*e).v;
        any |= a > 0;
        if (row.theirs != "default_acceleration") set(row.ours, a > 0 ? number(a) : "auto", e->line);
        else if (a > 0) set(row.ours, number(a), e->line);
      }
    if (const auto* e = find("default_acceleration")) set("acceleration_enabled", any ? "true" : "false", e->line);
  }

  void fills() {
    if (const auto* e = find("fill_density")) {
      const auto f = figure(*e);
      set("infill_sparse_density", number(f.percent ? f.v : f.v * 100), e->line);  // without % it is a fraction, as in old profiles
    }
    if (const auto* e = find("bridge_angle")) set("bridge_angle", figure(*e).v == 0 ? "auto" : number(figure(*e).v), e->line);
    if (const auto* e = find("elefant_foot_compensation")) set("xy_offset_layer_0", number(-figure(*e).v, 3), e->line);
    if (const auto* e = find("brim_type"); e && e->value == "no_brim") {
      set("brim_width", "0", e->line);
      by_key_.erase("brim_width");
      by_key_.erase("brim_type");
    }
    if (const auto* e = find("thumbnails")) {
      std::string sizes;
      for (const auto part : split(e->value, ',')) {
        const auto slash = part.find('/');
        if (slash != std::string_view::npos && part.substr(slash + 1) != "PNG") approximate(*e, fmt::format("{} is left out: pictures are PNG", part));
        else if (!part.empty()) sizes += (sizes.empty() ? "" : ", ") + std::string(part.substr(0, slash));
      }
      set("thumbnails", sizes, e->line);
    }
  }

  /// What the hot end melts, and how far filament is drawn back. 0 means: no limit, or never.
  void extrusion() {
    double limit = 0;
    int line = 0;
    for (const auto* key : {"filament_max_volumetric_speed", "max_volumetric_speed"})
      if (const auto* e = find(key)) {
        const double v = figure(*e).v;
        line = e->line;
        if (v > 0) limit = limit > 0 ? std::min(limit, v) : v;
      }
    if (line > 0) set("material_max_volumetric_speed", number(limit > 0 ? limit : 500), line);
    if (const auto* e = find("retract_length")) set("retraction_enable", figure(*e).v > 0 ? "true" : "false", e->line);
    if (const auto* e = find("cooling"); e && !flag(*e)) set("cool_min_layer_time", "0", e->line), by_key_.erase("slowdown_below_layer_time");
    if (const auto* e = find("max_volumetric_extrusion_rate_slope_positive"))
      set("max_extrusion_rate_slope", figure(*e).v > 0 ? number(figure(*e).v) : "auto", e->line);
  }

  /// Filament G-code goes between the printer's own and the print, as PrusaSlicer puts it.
  void texts() {
    const auto* start = find("start_gcode");
    const auto* filament_start = find("start_filament_gcode");
    if (start || filament_start) set("machine_start_gcode", joined(start ? start->value : "", filament_start ? first_text(filament_start->value) : ""), (start ? start : filament_start)->line);
    const auto* end = find("end_gcode");
    const auto* filament_end = find("end_filament_gcode");
    if (end || filament_end) set("machine_end_gcode", joined(filament_end ? first_text(filament_end->value) : "", end ? end->value : ""), (end ? end : filament_end)->line);
  }
  static std::string joined(std::string a, const std::string& b) {
    if (a.empty() || b.empty()) return a + b;
    return a + (a.ends_with("\\n") ? "" : "\\n") + b;
  }

  void sort_out_the_rest() {
    for (const auto& [key, entry] : by_key_) {
      if (std::find(seen_.begin(), seen_.end(), key) != seen_.end()) continue;
      const auto row = std::find_if(other_rows.begin(), other_rows.end(), [&, &k = key](const OtherRow& r) { return r.key == k; });
      const Remark remark{entry->key, entry->value, entry->line, row == other_rows.end() ? "" : std::string(row->why)};
      if (row == other_rows.end()) {
        const bool of_filament = key.starts_with("filament_") && std::any_of(same_rows.begin(), same_rows.end(), [&, &k = key](const SameRow& r) { return "filament_" + std::string(r.theirs) == k; });
        if (!of_filament) out_.unknown.push_back(remark);
        else if (entry->value != "nil") out_.unsupported.push_back({entry->key, entry->value, entry->line, "overrides by filament"});
        else out_.not_needed.push_back({entry->key, entry->value, entry->line, "nil: overrides nothing"});
      } else if (row->neutral == "*" || neutral(*row, entry->value)) {
        out_.not_needed.push_back(remark);
      } else {
        out_.unsupported.push_back(remark);
      }
    }
    const auto by_line = [](const Remark& a, const Remark& b) { return a.line < b.line; };
    for (auto* list : {&out_.not_needed, &out_.approximated, &out_.unsupported, &out_.unknown}) std::stable_sort(list->begin(), list->end(), by_line);
  }

  /// Does each element of the value say what the neutral one says? `0` and `0.0` and `0%` do.
  static bool neutral(const OtherRow& row, std::string_view text) {
    const auto canonical = [](std::string_view t) {
      if (!t.empty() && t.back() == '%') t.remove_suffix(1);
      double v = 0;
      try {
        value::parse(t, Unit::none, v);
      } catch (const std::invalid_argument&) {
        return std::string(t);
      }
      return number(v);
    };
    for (const auto part : split(text, ','))
      if (canonical(part) != canonical(row.neutral)) return false;
    return true;
  }

  const std::string& path_;
  std::map<std::string, const IniEntry*> by_key_;
  std::vector<std::string> seen_;
  Translation out_;
};

}  // namespace

bool recognises(std::string_view text, const std::vector<IniEntry>& entries) {
  const auto line = trimmed(text.substr(0, text.find('\n')));
  if (!line.empty() && (line.front() == '#' || line.front() == ';'))
    for (const auto* name : {"generated by PrusaSlicer", "generated by SuperSlicer", "generated by Slic3r"})
      if (line.find(name) != std::string_view::npos) return true;
  // Keys that only that family has; two, so that one stray key in a profile of weft's is still an error with a hint.
  constexpr std::array theirs{"perimeters", "fill_density", "fill_pattern", "start_gcode", "first_layer_height", "external_perimeter_speed", "retract_length",
                              "top_solid_layers", "bottom_solid_layers", "gcode_flavor", "temperature", "bed_temperature", "first_layer_temperature", "perimeter_speed",
                              "max_print_height", "skirts", "extrusion_width", "fan_always_on"};
  const auto found = std::count_if(entries.begin(), entries.end(), [&](const IniEntry& e) { return std::find(theirs.begin(), theirs.end(), e.key) != theirs.end(); });
  return found >= 2;
}

Translation translate(const std::vector<IniEntry>& entries, const std::string& path) { return Translator(entries, path).run(); }

}  // namespace weft::prusaslicer
