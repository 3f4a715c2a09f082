// SPDX-License-Identifier: GPL-3.0-or-later
#include "prusaslicer/import_support.h"

#include "settings/value.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace weft::prusaslicer {
namespace {

using value::number;
using Set = std::function<void(std::string_view, std::string, const IniEntry&)>;

/// Lines of the support's width, a gap apart: the share that is plastic, %.
double density(double gap, double width, double height) {
  const double band = std::max(0.01, width - height * (1 - std::numbers::pi / 4));
  return std::clamp(100 * band / (band + std::max(0.0, gap)), 1.0, 100.0);
}

void style(Lines& lines, const Set& set) {
  if (const auto* e = lines.find("support_material_style")) {
    const bool tree = e->value == "tree" || e->value == "organic";
    if (!tree && e->value != "grid" && e->value != "snug") lines.refuse(*e, "one of grid, snug, tree, organic");
    set("support_structure", tree ? "tree" : "normal", *e);
    set("support_normal_shape", e->value == "grid" ? "grid" : "snug", *e);
  }
  if (const auto* e = lines.find("support_material_threshold")) {
    const double t = lines.figure(*e).v;  // from the horizontal, and one degree more is still support
    set("support_angle", t == 0 ? "auto" : number(std::clamp(89 - t, 0.0, 89.0)), *e);
  }
  if (const auto* e = lines.find("dont_support_bridges")) {
    set("support_bridges", lines.flag(*e) ? "false" : "true", *e);
    set("support_max_bridge_length", "200", *e);
  }
  if (const auto* e = lines.find("support_material_closing_radius"))
    set("support_join_distance", number(std::clamp(2 * lines.figure(*e).v, 0.0, 50.0), 3), *e);
}

void interfaces(Lines& lines, double layer_height, const Set& set) {
  const auto* top = lines.find("support_material_interface_layers");
  const auto* bottom = lines.find("support_material_bottom_interface_layers");
  const double above = top ? lines.figure(*top).v : 3;
  if (top) {
    set("support_roof_enable", above > 0 ? "true" : "false", *top);
    if (above > 0) set("support_roof_height", number(std::min(10.0, above * layer_height), 3), *top);
  }
  if (bottom) {
    const double below = lines.figure(*bottom).v;  // -1: as many as on top
    set("support_bottom_enable", (below < 0 ? above : below) > 0 ? "true" : "false", *bottom);
    set("support_bottom_height", below <= 0 ? "auto" : number(std::min(10.0, below * layer_height), 3), *bottom);
  }
  if (const auto* e = lines.find("support_material_interface_contact_loops"))
    set("support_roof_wall_count", lines.flag(*e) ? "1" : "0", *e);
}

void raft(Lines& lines, const Set& set) {
  const auto* e = lines.find("raft_layers");
  if (!e) return;
  const int layers = static_cast<int>(lines.figure(*e).v);
  if (const auto* speed = lines.find("first_layer_speed_over_raft")) {
    const auto f = lines.figure(*speed);
    set("speed_layer_0_over_raft", f.v <= 0 ? "auto" : number(f.v, 3) + (f.percent ? "%" : ""), *speed);
  }
  set("adhesion_type", layers > 0 ? "raft" : "as_set", *e);
  if (layers <= 0) return;
  const int surface = std::min(layers - 1, (layers + 1) / 2);  // the base is one layer
  set("raft_surface_layers", number(surface), *e);
  set("raft_interface_layers", number(layers - 1 - surface), *e);
}

}  // namespace

void import_support(Lines& lines, const SupportBasis& basis, const Set& set_any) {
  // A profile says these whether it prints support or not, and weft has finer words for them: they are its own until
  // the profile needs them.
  constexpr std::array<std::string_view, 8> only_with_support{
      "support_structure",       "support_normal_shape", "support_max_bridge_length", "speed_support_infill",
      "speed_support_interface", "support_roof_height",  "support_bottom_height"};
  const auto above_0 = [&](std::string_view key) {
    const auto* e = lines.look(key);
    return e != nullptr && lines.figure(*e).v > 0;
  };
  const auto* enabled = lines.look("support_material");
  const bool on = (enabled != nullptr && lines.flag(*enabled)) || above_0("raft_layers") ||
                  above_0("support_material_enforce_layers");
  const Set set = [&](std::string_view key, std::string text, const IniEntry& e) {
    if (on || std::find(only_with_support.begin(), only_with_support.end(), key) == only_with_support.end())
      set_any(key, std::move(text), e);
  };
  style(lines, set);
  interfaces(lines, basis.layer_height, set);
  raft(lines, set);
  double width = basis.nozzle;
  if (const auto* e = lines.find("support_material_extrusion_width")) {
    const double own = lines.figure(*e).of(basis.layer_height);
    const auto* general = lines.look("extrusion_width");
    const double common = general ? lines.figure(*general).of(basis.layer_height) : 0;
    const double wide = own > 0 ? own : common;
    if (wide > 0) width = wide;
    set("support_line_width", wide > 0 ? number(wide, 3) : "auto", *e);
  }
  if (const auto* e = lines.find("support_material_spacing"))
    set("support_infill_rate", number(density(lines.figure(*e).v, width, basis.layer_height), 2), *e);
  if (const auto* e = lines.find("support_material_interface_spacing"))
    set("support_interface_density", number(density(lines.figure(*e).v, width, basis.layer_height), 2), *e);
  if (const auto* e = lines.find("support_material_with_sheath"))
    set("support_wall_count", lines.flag(*e) ? "1" : "0", *e);
  if (const auto* e = lines.find("raft_first_layer_density"))
    set("support_initial_layer_density", number(std::clamp(lines.figure(*e).v, 10.0, 100.0)), *e);
  double speed = lines.number("max_print_speed", 80);
  const double fastest = speed;
  if (const auto* e = lines.find("support_material_speed")) {
    const double own = lines.figure(*e).v;
    if (own > 0) speed = own;
    set("speed_support_infill", number(std::max(0.1, speed)), *e);
  }
  if (const auto* e = lines.find("support_material_interface_speed")) {
    const double own = lines.figure(*e).of(speed);
    set("speed_support_interface", number(std::max(0.1, own > 0 ? own : fastest)), *e);
  }
}

}  // namespace weft::prusaslicer
