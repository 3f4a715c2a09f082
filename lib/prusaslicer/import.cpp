// SPDX-License-Identifier: GPL-3.0-or-later
#include "prusaslicer/import.h"

#include "core/error.h"
#include "prusaslicer/bed.h"
#include "prusaslicer/custom.h"
#include "prusaslicer/import_single.h"
#include "prusaslicer/import_support.h"
#include "prusaslicer/import_tools.h"
#include "prusaslicer/keys.h"
#include "prusaslicer/line_area.h"
#include "prusaslicer/lines.h"
#include "prusaslicer/overhangs.h"
#include "prusaslicer/text.h"
#include "settings/value.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

namespace weft::prusaslicer {
namespace {

using value::number;

/// The arithmetic between the lines of a configuration.
class Translator {
 public:
  explicit Translator(Lines lines) : lines_(std::move(lines)), whole_(lines_) {}
  /// Of one of several extruders. @param whole with all of their lists
  Translator(Lines lines, Lines whole, std::size_t extruders)
      : lines_(std::move(lines)), whole_(std::move(whole)), extruders_(extruders) {}

  Translation run() {
    machine();
    automatic_widths(lines_);
    widths();
    speeds();
    accelerations();
    fills();
    import_support(lines_, {nozzle_, height_},
                   [&](std::string_view key, std::string text, const IniEntry& e) { set(key, std::move(text), e); });
    seams();
    singles();
    extrusion();
    if (extruders_ > 1)
      import_tools(lines_, whole_, extruders_, outlet());
    else
      texts();
    for (const auto& row : ported_keys()) copy(row);
    custom();
    for (const auto& e : lines_.commented()) approximate(e, "what stands behind the number is taken for a comment");
    sort_out_the_rest();
    return std::move(out_);
  }

 private:
  void set(std::string_view key, std::string text, const IniEntry& e) {
    out_.assignments.push_back(
        {std::string(key), std::move(text), e.line, e.key,
         fmt::format("{}{} = {}", e.section.empty() ? "" : "[" + e.section + "] ", e.key, e.value)});
  }
  void approximate(const IniEntry& e, std::string why) {
    if (e.line != 0) out_.approximated.push_back({e.key, e.value, e.line, std::move(why)});
  }

  void copy(const Key& row) {
    const auto* e = lines_.look(row.name);
    if (!e || done_.count(row.name) != 0) return;
    e = lines_.find(row.name);
    if (e->value == "nil") return;
    switch (row.form) {
      case Form::length:
        return set(row.ours, number(lines_.figure(*e).v, 3), *e);
      case Form::number:
        return set(row.ours, number(lines_.figure(*e).v), *e);
      case Form::times_100:
        return set(row.ours, number(lines_.figure(*e).v * 100), *e);
      case Form::zero_is_auto:
        return set(row.ours, lines_.figure(*e).v == 0 ? "auto" : number(lines_.figure(*e).v, 3), *e);
      case Form::share: {
        const auto f = lines_.figure(*e);
        return set(row.ours, number(f.v, 3) + (f.percent ? "%" : ""), *e);
      }
      case Form::flag:
        return set(row.ours, lines_.flag(*e) ? "true" : "false", *e);
      case Form::text:
        return set(row.ours, first_text(*e), *e);
      case Form::choice:
        return choose(row, *e);
      case Form::none:
      case Form::width:
      case Form::speed:
      case Form::acceleration:
      case Form::limit:
      case Form::reckoned:
        return;
    }
  }
  void choose(const Key& row, const IniEntry& e) {
    for (const auto& c : choice_rows) {
      if (c.key != row.name || c.theirs != e.value) continue;
      set(row.ours, std::string(c.ours), e);
      if (!c.loss.empty()) approximate(e, std::string(c.loss));
      return;
    }
    std::string known;
    for (const auto& c : choice_rows)
      if (c.key == row.name) known += fmt::format("{}{}", known.empty() ? "" : ", ", c.theirs);
    lines_.refuse(e, fmt::format("one of {}", known));
  }

  void machine() {
    if (const auto* e = lines_.find("bed_shape")) {
      const auto bed = bed_of(e->value);
      if (!bed) lines_.refuse(*e, "a list of points in mm");
      for (const auto& [key, text] : *bed) set(key, text, *e);
    }
    for_each_reckoned(Form::limit, [&](const Key& row) {
      if (const auto* e = lines_.find(row.name)) limit(std::string(row.ours), *e);
    });
    if (const auto* e = lines_.look("gcode_flavor"))
      set("write_extrusion", e->value == "no-extrusion" ? "false" : "true", *e);
  }

  /// A limit that no machine reaches is none: it is kept as the highest that weft takes.
  void limit(const std::string& ours, const IniEntry& e) {
    const double v = lines_.figure(e).v, most = ours.find("speed") != std::string::npos ? 5000 : 100'000;
    if (v > most) approximate(e, fmt::format("{} is as high as weft goes", number(most)));
    set(ours, number(std::min(v, most)), e);
  }

  /// Widths: a share is of the layer's height, 0 is automatic: the general width, else 1.125 × nozzle (1 × for tops).
  void widths() {
    nozzle_ = lines_.look("nozzle_diameter") ? lines_.figure(*lines_.look("nozzle_diameter")).v : 0.4;
    height_ = lines_.look("layer_height") ? lines_.figure(*lines_.look("layer_height")).v : 0.2;
    double first_height = height_;
    if (const auto* e = lines_.find("first_layer_height")) {
      first_height = lines_.figure(*e).of(height_);
      set("initial_layer_height", number(first_height, 3), *e);
    }
    const auto* general = lines_.find("extrusion_width");
    const auto width_of = [&](const IniEntry* own, double automatic) {
      double width = own ? lines_.figure(*own).of(height_) : 0;
      if (width == 0 && general) width = lines_.figure(*general).of(height_);
      return width == 0 ? automatic * nozzle_ : width;
    };
    for_each_reckoned(Form::width, [&](const Key& row) {
      const auto* own = lines_.find(row.name);
      if (!own && !general) return;
      const auto& line = own && (own->line != 0 || !general) ? *own : *general;
      set(row.ours, number(width_of(own, row.automatic), 3), line);
      if (row.ours == "wall_line_width_0") set("wall_outline", "widest", line);  // as its widths are meant
    });
    // In the classic generator, without thin_walls, what holds no wall gets none.
    const auto* thin = lines_.find("thin_walls");
    const auto* generator = lines_.look("perimeter_generator");
    if (thin && !lines_.flag(*thin) && generator && generator->value == "classic")
      set("min_feature_size", number(width_of(lines_.look("external_perimeter_extrusion_width"), 1.125), 3), *thin);
    solid_width_ = width_of(lines_.look("solid_infill_extrusion_width"), 1.125);
    if (const auto* e = lines_.find("first_layer_extrusion_width")) {
      const double first = lines_.figure(*e).of(first_height);
      set("initial_layer_line_width", first == 0 ? "auto" : number(first, 3), *e);
      // Skirt and brim are first-layer lines; where that has no width of its own, they are as wide as inner walls.
      const double width = first == 0 ? width_of(lines_.look("perimeter_extrusion_width"), 1.125) : first;
      set("skirt_brim_line_width", number(width, 3), *e);
      skirt_length(width, first_height);
    }
  }

  /// PrusaSlicer measures the least skirt in filament, weft in the skirt's own length.
  void skirt_length(double width, double height) {
    const auto* e = lines_.look("min_skirt_length");
    const double area = height * (width - height * (1 - std::numbers::pi / 4));
    if (!e || area <= 0) return;
    const auto* filament = lines_.look("filament_diameter");
    const double d = filament ? lines_.figure(*filament).v : 1.75;
    set("skirt_brim_minimal_length", number(lines_.figure(*e).v * std::numbers::pi / 4 * d * d / area, 3), *e);
    lines_.find("min_skirt_length");
    done_.insert("min_skirt_length");
  }

  /// What automatic speeds make flow: the thinnest line that has one goes at the highest speed, others take as much,
  /// up to max_volumetric_speed. Infinite where none is automatic.
  double automatic_mm3_s(double fastest) {
    double least = std::numeric_limits<double>::infinity();
    for_each_reckoned(Form::speed, [&](const Key& row) {
      const auto* e = lines_.look(row.name);
      if (e && lines_.figure(*e).v == 0 && row.ours != "speed_travel")
        least = std::min(least, line_area_mm2(lines_, row.ours, nozzle_, height_));
    });
    const double most = lines_.look("max_volumetric_speed") ? lines_.figure(*lines_.look("max_volumetric_speed")).v : 0;
    return most > 0 ? std::min(most, fastest * least) : fastest * least;
  }

  /// Speeds: a share is of another speed; 0 is PrusaSlicer's automatic speed, bounded by max_print_speed.
  void speeds() {
    const double fastest = lines_.number("max_print_speed", 80);
    std::map<std::string_view, double> known;
    const double mm3_s = automatic_mm3_s(fastest);
    for_each_reckoned(Form::speed, [&](const Key& row) {
      const auto* e = lines_.find(row.name);
      if (!e) return;
      const auto base = known.find(row.of);
      double speed = lines_.figure(*e).of(base == known.end() ? fastest : base->second);
      if (speed == 0) {
        speed = std::max(0.1, std::min(fastest, mm3_s / line_area_mm2(lines_, row.ours, nozzle_, height_)));
      }
      known[row.name] = speed;
      set(row.ours, number(speed), *e);
    });
    const auto speed_of = [&](std::string_view key, double otherwise) {
      return known.count(key) != 0 ? known[key] : otherwise;
    };
    if (const auto* e = lines_.find("small_perimeter_speed")) {
      const auto f = lines_.figure(*e);
      set("speed_small_perimeter",
          f.v == 0    ? "auto"
          : f.percent ? number(f.of(speed_of("perimeter_speed", fastest)))
                      : number(f.v),
          *e);
      set("small_perimeter_length", "40.841", *e);  // a circle of 6.5 mm radius
    }
    if (const auto* e = lines_.find("first_layer_speed")) {
      const auto f = lines_.figure(*e);
      set("speed_layer_0", f.v == 0 ? "100%" : number(f.v) + (f.percent ? "%" : ""), *e);
    }
    infill_mm_s_ = speed_of("infill_speed", fastest), solid_mm_s_ = speed_of("solid_infill_speed", fastest);
    for (auto& told : overhangs_of(lines_, speed_of("bridge_speed", fastest)))
      set(told.ours, std::move(told.text), *told.line);
    if (const auto* e = lines_.find("travel_speed_z")) {
      const double v = lines_.figure(*e).v;
      set("speed_z_hop", number(std::min(v > 0 ? v : speed_of("travel_speed", 130), 1000.0)), *e);
    }
    if (const auto* e = lines_.find("support_material_speed")) {  // skirt and brim are printed at that speed
      const double v = lines_.figure(*e).v;
      const auto first = lines_.figure("first_layer_speed").value_or(Figure{});
      const double speed = v > 0 ? v : fastest, slow = first.v > 0 ? first.of(speed) : speed;
      set("skirt_brim_speed", number(std::min(speed, slow)),
          *e);  // most of a skirt, and all of a brim, lies in the first layer
    }
  }

  /// Without a default acceleration none is written: there would be nothing to go back to.
  void accelerations() {
    const auto* general = lines_.find("default_acceleration");
    const double otherwise = general ? lines_.figure(*general).v : 0;
    for_each_reckoned(Form::acceleration, [&](const Key& row) {
      if (const auto* e = lines_.find(row.name)) {
        const double a = lines_.figure(*e).v;
        if (e != general)
          set(row.ours, a > 0 ? number(a) : "auto", *e);
        else if (a > 0)
          set(row.ours, number(a), *e);
        if (general && otherwise == 0 && a > 0) approximate(*e, "has no effect while default_acceleration is 0");
      }
    });
    if (general) set("acceleration_enabled", otherwise > 0 ? "true" : "false", *general);
  }

  /// Joints along walls, and ends that are bent along them. What a profile does not say is left to weft.
  void anchors() {
    const auto* own = lines_.look("infill_extrusion_width");
    const double own_mm = own ? lines_.figure(*own).of(height_) : 0, width = own_mm > 0 ? own_mm : 1.125 * nozzle_;
    const auto mm = [&](const IniEntry& e) { return std::clamp(lines_.figure(e).of(width), 0.0, 1000.0); };
    const auto* longest = lines_.find("infill_anchor_max");
    if (longest) {
      set("infill_connect_lines", mm(*longest) > 0 ? "true" : "false", *longest);
      if (longest->line != 0 && mm(*longest) > 0) set("infill_anchor_max", number(mm(*longest), 3), *longest);
    }
    if (const auto* e = lines_.find("infill_anchor"); e && e->line != 0)
      set("infill_anchor_length", number(longest ? std::min(mm(*e), mm(*longest)) : mm(*e), 3), *e);
  }

  void fills() {
    if (const auto* e = lines_.find("fill_density")) {
      const auto f = lines_.figure(*e);
      set("infill_sparse_density", number(f.percent ? f.v : f.v * 100),
          *e);  // without % it is a fraction, as in old profiles
    }
    if (const auto* e = lines_.find("infill_every_layers")) {
      const double layers = lines_.figure(*e).v;
      set("infill_sparse_thickness", layers > 1 ? number(std::min(layers * height_, 5.0), 3) : "auto", *e);
    }
    const auto* highest = lines_.find("automatic_infill_combination_max_layer_height");
    if (const auto* e = lines_.find("automatic_infill_combination"); e != nullptr && lines_.flag(*e)) {
      const auto most = highest != nullptr ? lines_.figure(*highest) : Figure{100, true};
      const double mm = most.percent ? nozzle_ * most.v / 100 : most.v;
      set("infill_sparse_thickness", number(std::clamp(mm, 0.02, 5.0), 3), *e);
    }
    if (const auto* e = lines_.find("infill_only_where_needed")) {
      set("infill_support_enabled", lines_.flag(*e) ? "true" : "false", *e);
      if (lines_.flag(*e)) set("infill_support_angle", "50", *e);
    }
    if (const auto* e = lines_.find("bridge_angle"))
      set("bridge_angle", lines_.figure(*e).v == 0 ? "auto" : number(lines_.figure(*e).v), *e);
    if (const auto* e = lines_.find("elefant_foot_compensation"))
      set("xy_offset_layer_0", number(-lines_.figure(*e).v, 3), *e);
    if (const auto* e = lines_.look("brim_type"); e && e->value == "no_brim") {
      set("brim_width", "0", *e);
      lines_.find("brim_width");
      done_.insert("brim_width");
    }
    anchors();
    if (const auto* e = lines_.look("bridge_flow_ratio")) {
      const auto* thick = lines_.find("thick_bridges");
      if (thick && !lines_.flag(*thick)) {  // the cross-section of solid infill, as a share of the round strand
        const double area = height_ * (solid_width_ - height_ * (1 - std::numbers::pi / 4)),
                     round = std::numbers::pi / 4 * nozzle_ * nozzle_;
        if (round > 0 && area > 0) {
          set("bridge_flow", number(std::clamp(100 * lines_.figure(*e).v * area / round, 10.0, 300.0), 2), *e);
          lines_.find("bridge_flow_ratio");
          done_.insert("bridge_flow_ratio");
        }
      }
    } else {
      lines_.find("thick_bridges");
    }
  }

  /// Seams, the ways between beads, and pictures.
  void seams() {
    if (const auto* e = lines_.find("seam_gap_distance")) {
      const auto gap = lines_.figure(*e);
      set("seam_gap_distance", number(gap.v, 3) + (gap.percent ? "%" : ""), *e);
    }
    if (const auto* e = lines_.find("scarf_seam_placement")) {
      const auto* length = lines_.find("scarf_seam_length");
      set("scarf_joint_seam_length",
          e->value == "nowhere" ? "0"
          : length              ? number(lines_.figure(*length).v, 3)
                                : "20",
          *e);
      if (e->value == "contours") approximate(*e, "holes get such seams too");
      const auto* height = lines_.find("scarf_seam_start_height");
      if (height && e->value != "nowhere")
        set("scarf_joint_seam_start_height_ratio", number(lines_.figure(*height).v), *height);
    }
    const auto* avoid = lines_.find("avoid_crossing_perimeters");
    const auto* detour = lines_.find("avoid_crossing_perimeters_max_detour");
    if (avoid && lines_.flag(*avoid)) {
      set("retraction_combing", "all", *avoid);
      const auto f = detour ? lines_.figure(*detour) : Figure{};
      set("retraction_combing_max_detour", f.v == 0 ? "auto" : number(f.v, 3) + (f.percent ? "%" : ""),
          detour ? *detour : *avoid);
    } else if (avoid && avoid->line != 0) {
      out_.not_needed.push_back({avoid->key, avoid->value, avoid->line,
                                 "travels stay inside the part where that is no long way round (retraction_combing)"});
    }
    if (const auto* e = lines_.find("thumbnails")) {
      std::vector<std::string> left_out;
      set("thumbnails", png_sizes(e->value, left_out), *e);
      for (const auto& part : left_out) approximate(*e, fmt::format("{} is left out: pictures are PNG", part));
    }
  }

  /// What the hot end melts, and how far filament is drawn back. 0 means: no limit, or never.
  void extrusion() {
    double limit = 0;
    const IniEntry* line = nullptr;
    for (const auto* key : {"filament_max_volumetric_speed", "max_volumetric_speed"})
      if (const auto* e = lines_.find(key)) {
        const double v = lines_.figure(*e).v;
        if (!line || (v > 0 && (limit == 0 || v < limit))) line = e;
        if (v > 0) limit = limit > 0 ? std::min(limit, v) : v;
      }
    if (line) set("material_max_volumetric_speed", number(limit > 0 ? limit : 500), *line);
    if (const auto* e = lines_.look("filament_density"); e && lines_.figure(*e).v == 0) {
      lines_.find("filament_density");
      done_.insert("filament_density");
      if (e->line != 0)
        out_.not_needed.push_back({e->key, e->value, e->line, "not known; the weight is reckoned with weft's density"});
    }
    if (const auto* e = lines_.look("retract_length")) {
      const auto* by_firmware = lines_.look("use_firmware_retraction");  // which knows a length of its own
      set("retraction_enable", lines_.figure(*e).v > 0 || (by_firmware && lines_.flag(*by_firmware)) ? "true" : "false",
          *e);
    }
    // While wiping, PrusaSlicer draws back at the usual speed and moves at 0.8 × that of travels: that gives the
    // length.
    const auto* length = lines_.look("retract_length");
    const double before = lines_.figure("retract_before_wipe").value_or(Figure{}).v / 100;
    const auto* wipe = lines_.look("wipe");
    if (wipe && length && lines_.flag(*wipe)) {
      const auto figure_of = [&](std::string_view key, double otherwise) {
        return lines_.look(key) ? lines_.figure(*lines_.look(key)).v : otherwise;
      };
      const double speed = figure_of("retract_speed", 40), travel = figure_of("travel_speed", 130);
      if (speed > 0)
        set("wipe_distance",
            number(std::clamp(lines_.figure(*length).v * (1 - before) / speed * 0.8 * travel, 0.0, 100.0), 3), *wipe);
    }
  }

  /// Filament G-code goes between the printer's own and the print, as PrusaSlicer puts it.
  void texts() {
    const auto joined = [&](std::string_view ours, const char* first, const char* second) {
      const auto *a = lines_.find(first), *b = lines_.find(second);
      if (!a && !b) return;
      const std::string x = a ? first_text(*a) : "", y = b ? first_text(*b) : "";
      set(ours, x + (x.empty() || y.empty() || x.ends_with("\\n") ? "" : "\\n") + y,
          a && a->line != 0 ? *a
          : b               ? *b
                            : *a);
    };
    joined("machine_start_gcode", "start_gcode", "start_filament_gcode");
    joined("machine_end_gcode", "end_filament_gcode", "end_gcode");
  }

  /// The reach that the custom G-code shows, and the values that it names.
  void custom() {
    if (const auto* bed = lines_.look("bed_shape"); bed && bed->line != 0)
      for (const auto& reach : reach_of(lines_)) {
        const auto* height = lines_.look("max_print_height");
        set(reach.setting, reach.value,
            reach.setting == "machine_reach_z_max" && height && height->line != 0 ? *height : *bed);
        out_.assignments.back().source += fmt::format(", and {} ({})", reach.why, reach.beyond);
      }
    const auto variables = variables_of(extruders_ > 1 ? whole_ : lines_);
    for (const auto* key : {"start_gcode", "end_gcode", "before_layer_gcode", "layer_gcode"})
      if (const auto* e = lines_.look(key); e && !variables.empty()) {
        set("gcode_variables", variables, *e);
        out_.assignments.back().source = "what custom G-code names";
        break;
      }
  }

  void singles() { import_single_keys(lines_, infill_mm_s_, solid_mm_s_, outlet()); }

  Outlet outlet() {
    return {.set = [&](std::string_view key, std::string text, const IniEntry& e) { set(key, std::move(text), e); },
            .approximate = [&](const IniEntry& e, std::string why) { approximate(e, std::move(why)); },
            .instead_of =
                [&](std::string_view key) {
                  lines_.find(key);
                  done_.insert(key);
                }};
  }

  void sort_out_the_rest() {
    for (const auto* e : lines_.unread()) {
      if (e->line == 0) continue;
      const auto* row = find_key(e->key);
      if (row && row->form != Form::none) row = nullptr;  // read where the key it goes with is there
      const Remark remark{e->key, e->value, e->line, row ? std::string(row->fate) : ""};
      if (!row)
        out_.unknown.push_back(remark);
      else if (!row->neutral)
        out_.not_needed.push_back(remark);
      else if (says_one_of(*row->neutral, e->key, e->value))
        out_.not_needed.push_back({e->key, e->value, e->line, "changes nothing at that value"});
      else
        out_.unsupported.push_back(remark);
    }
    const auto by_line = [](const Remark& a, const Remark& b) { return a.line < b.line; };
    for (auto* list : {&out_.not_needed, &out_.approximated, &out_.unsupported, &out_.unknown})
      std::stable_sort(list->begin(), list->end(), by_line);
  }

  Lines lines_;
  Lines whole_;  ///< with lists of all extruders
  std::size_t extruders_ = 1;
  std::set<std::string_view> done_;  ///< keys whose setting was reckoned otherwise
  double nozzle_ = 0.4, height_ = 0.2, solid_width_ = 0.45, infill_mm_s_ = 80, solid_mm_s_ = 20;
  Translation out_;
};

}  // namespace

Translation translate(std::vector<IniEntry> entries, const std::string& path, bool complete) {
  if (complete) {
    std::vector<IniEntry> all;
    for (const auto& row : keys())
      if (row.initial) all.push_back({{}, std::string(row.name), std::string(*row.initial), 0});
    all.insert(all.end(), std::make_move_iterator(entries.begin()), std::make_move_iterator(entries.end()));
    entries = std::move(all);
  }
  const auto extruders = extruders_in(entries);
  if (extruders == 1) return Translator(Lines(std::move(entries), path)).run();
  const Lines whole(entries, path);
  auto out = Translator(Lines(of_extruder(entries, 0), path), whole, extruders).run();
  for (std::size_t i = 1; i < extruders; ++i)
    add_differences(i, Translator(Lines(of_extruder(entries, i), path), whole, extruders).run(), out);
  return out;
}

}  // namespace weft::prusaslicer
