// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/schema.h"

namespace weft {
using namespace weft::literals;

/// What lies under the parts when adhesion_type is raft: one base layer, layers between, and a dense surface.
struct RaftSettings {
  int raft_surface_layers = 2;
  int raft_interface_layers = 1;
  Um raft_airgap = 0.3_mm;
  Um raft_margin = 5_mm;
  Um raft_smoothing = 5_mm;
  std::optional<Um> raft_base_thickness;
  std::optional<Um> raft_base_line_spacing;
  std::optional<Um> raft_interface_thickness;
  std::optional<Um> raft_interface_line_spacing;
  std::optional<Um> raft_surface_thickness;
};

inline constexpr std::tuple raft_schema{
    setting("raft_surface_layers", Scope::plate, &RaftSettings::raft_surface_layers, Unit::layers, 0, 100,
            "Dense layers on top of the raft."),
    setting("raft_interface_layers", Scope::plate, &RaftSettings::raft_interface_layers, Unit::layers, 0, 100,
            "Layers of the raft between its base and its surface."),
    setting("raft_airgap", Scope::plate, &RaftSettings::raft_airgap, Unit::mm, 0_mm, 5_mm,
            "Gap between the raft and the part on it; support has none."),
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
};
static_assert(complete<RaftSettings>(raft_schema));

}  // namespace weft
