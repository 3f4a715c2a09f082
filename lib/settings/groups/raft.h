// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/schema.h"

namespace weft {
using namespace weft::literals;

/// What lies under the parts when adhesion_type is raft: one thick base layer of wide lines that grips an uneven bed,
/// layers between with half of them air, so that the raft bends and lets go of the bed, and a dense surface that the
/// parts stand on. Thicknesses that are `auto` follow nozzle_diameter and layer_height; adhesion/raft.h lays the beads.
struct RaftSettings {
  int raft_surface_layers = 2;
  int raft_interface_layers = 1;
  Um raft_airgap = 0.15_mm;  ///< of air, between what the raft ends with and what the parts begin with
  Um raft_margin = 5_mm;
  Um raft_smoothing = 5_mm;  ///< a radius: outlines are grown and shrunk by it
  std::optional<Um> raft_base_thickness;
  std::optional<Um> raft_base_line_spacing;
  std::optional<Um> raft_interface_thickness;
  std::optional<Um> raft_interface_line_spacing;
  std::optional<Um> raft_surface_thickness;
  std::optional<Um> raft_surface_line_spacing;
  std::optional<double> raft_base_speed;
  std::optional<double> raft_interface_speed;
  std::optional<double> raft_surface_speed;
  std::optional<SpeedOrShare> speed_layer_0_over_raft;
  std::optional<double> acceleration_layer_0_over_raft;
};

inline constexpr Rows raft_schema{
    setting(
        "raft_surface_layers", Scope::plate, &RaftSettings::raft_surface_layers, Unit::layers, 0, 100,
        "Dense layers on top of the raft, under the parts; under support alone they are laid as the layers between."),
    setting("raft_interface_layers", Scope::plate, &RaftSettings::raft_interface_layers, Unit::layers, 0, 100,
            "Layers of the raft between its base and its surface."),
    setting(
        "raft_airgap", Scope::plate, &RaftSettings::raft_airgap, Unit::mm, 0_mm, 5_mm,
        "Gap between the raft and the part on it; support has none. The part's first lines fall through it onto the "
        "raft, and hold little where it is more than they are high."),
    setting("raft_margin", Scope::plate, &RaftSettings::raft_margin, Unit::mm, 0_mm, 50_mm,
            "How far the raft reaches beyond what stands on it."),
    setting("raft_smoothing", Scope::plate, &RaftSettings::raft_smoothing, Unit::mm, 0_mm, 50_mm,
            "Inner corners and gaps of the raft's outline up to this radius are filled."),
    setting("raft_base_thickness", Scope::plate, &RaftSettings::raft_base_thickness, Unit::mm, 0.02_mm, 5_mm,
            "Height of the lowest layer; auto is three quarters of nozzle_diameter."),
    setting("raft_base_line_spacing", Scope::plate, &RaftSettings::raft_base_line_spacing, Unit::mm, 0.05_mm, 20_mm,
            "Distance of the lines of the lowest layer; auto: nine tenths of it are plastic."),
    setting("raft_interface_thickness", Scope::plate, &RaftSettings::raft_interface_thickness, Unit::mm, 0.02_mm, 5_mm,
            "Height of the layers between; auto is six tenths of nozzle_diameter."),
    setting("raft_interface_line_spacing", Scope::plate, &RaftSettings::raft_interface_line_spacing, Unit::mm, 0.05_mm,
            20_mm, "Distance of the lines of the layers between; auto is two lines, so that half of it is air."),
    setting("raft_surface_thickness", Scope::plate, &RaftSettings::raft_surface_thickness, Unit::mm, 0.02_mm, 5_mm,
            "Height of the dense layers; auto is layer_height."),
    setting("raft_surface_line_spacing", Scope::plate, &RaftSettings::raft_surface_line_spacing, Unit::mm, 0.05_mm,
            20_mm, "Distance of the lines of the dense layers; auto: they lie side by side."),
    setting("raft_base_speed", Scope::plate, &RaftSettings::raft_base_speed, Unit::mm_s, 0.1, 5000,
            "Speed of the lowest layer; auto is speed_support_infill, but no more than speed_layer_0."),
    setting("raft_interface_speed", Scope::plate, &RaftSettings::raft_interface_speed, Unit::mm_s, 0.1, 5000,
            "Speed of the layers between; auto is speed_support_infill."),
    setting("raft_surface_speed", Scope::plate, &RaftSettings::raft_surface_speed, Unit::mm_s, 0.1, 5000,
            "Speed of the dense layers; auto is speed_support_interface."),
    setting("speed_layer_0_over_raft", Scope::plate, &RaftSettings::speed_layer_0_over_raft, Unit::mm_s, 0.1, 5000,
            "Features of a part's first layer on a raft get no faster; a share is of their own speed; auto is "
            "speed_layer_0."),
    setting("acceleration_layer_0_over_raft", Scope::plate, &RaftSettings::acceleration_layer_0_over_raft, Unit::mm_s2,
            1, 100000, "Acceleration of a part's first layer on a raft; auto: as on other layers."),
};
static_assert(complete<RaftSettings>(raft_schema));

}  // namespace weft
