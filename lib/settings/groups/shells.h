// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/schema.h"

#include <array>

namespace weft {
using namespace weft::literals;

/// How the lines of a solid layer are laid.
enum class SkinPattern {
  monotonic,        ///< joined at their ends, each printed after its neighbour on one and the same side
  monotonic_lines,  ///< the same, not joined
  lines,            ///< joined, in whatever order is shortest
  aligned_lines,    ///< the same, in one direction in all layers
  concentric,       ///< rings along the edge
  hilbert,          ///< the patterns of sparse infill, dense
  archimedean,
  octagram,
  fermat,
};
constexpr auto choices_of(SkinPattern) {
  return std::array{Choice<SkinPattern>{SkinPattern::monotonic, "monotonic"},
                    Choice<SkinPattern>{SkinPattern::monotonic_lines, "monotonic_lines"},
                    Choice<SkinPattern>{SkinPattern::lines, "lines"},
                    Choice<SkinPattern>{SkinPattern::aligned_lines, "aligned_lines"},
                    Choice<SkinPattern>{SkinPattern::concentric, "concentric"},
                    Choice<SkinPattern>{SkinPattern::hilbert, "hilbert"},
                    Choice<SkinPattern>{SkinPattern::archimedean, "archimedean"},
                    Choice<SkinPattern>{SkinPattern::octagram, "octagram"},
                    Choice<SkinPattern>{SkinPattern::fermat, "fermat"}};
}

/// What is ironed.
enum class IroningSurfaces {
  top,      ///< whatever nothing lies above
  topmost,  ///< that of the last layer
  solid,    ///< every solid area but bridges
};
constexpr auto choices_of(IroningSurfaces) {
  return std::array{Choice<IroningSurfaces>{IroningSurfaces::top, "top"},
                    Choice<IroningSurfaces>{IroningSurfaces::topmost, "topmost"},
                    Choice<IroningSurfaces>{IroningSurfaces::solid, "solid"}};
}

/// What closes the part above and below: solid layers, and bridges where they hang over air.
struct ShellSettings {
  int top_layers = 4;
  int bottom_layers = 4;
  Um top_thickness = 0.7_mm;
  Um bottom_thickness = 0.5_mm;
  std::optional<LengthOrShare> skin_line_width;
  std::optional<LengthOrShare> top_skin_line_width;
  std::optional<double> skin_angle;
  SkinPattern top_pattern = SkinPattern::monotonic;
  SkinPattern bottom_pattern = SkinPattern::monotonic;
  std::optional<int> infill_solid_every_layers;
  double infill_solid_below_area = 20;
  bool gap_fill_enabled = true;
  bool overhang_walls = true;
  bool bridges = true;
  std::optional<double> bridge_angle;
  double bridge_flow = 100;
  Um bridge_anchor = 2_mm;
  bool ironing_enabled = false;
  IroningSurfaces ironing_surfaces = IroningSurfaces::top;
  double ironing_flow = 15;
  Um ironing_line_spacing = 0.1_mm;
  std::optional<Um> ironing_inset;
  std::optional<double> ironing_angle;
  double ironing_prime = 0;
  Um small_area_flow_length = 0_mm;
};

inline constexpr Rows shell_schema{
    setting("top_layers", Scope::region, &ShellSettings::top_layers, Unit::layers, 0, 100000,
            "Solid layers under every top surface; top_thickness may ask for more."),
    setting("bottom_layers", Scope::region, &ShellSettings::bottom_layers, Unit::layers, 0, 100000,
            "Solid layers over every bottom surface; bottom_thickness may ask for more."),
    setting("top_thickness", Scope::region, &ShellSettings::top_thickness, Unit::mm, 0_mm, 1000_mm,
            "Least thickness of what is solid under a top surface."),
    setting("bottom_thickness", Scope::region, &ShellSettings::bottom_thickness, Unit::mm, 0_mm, 1000_mm,
            "Least thickness of what is solid over a bottom surface."),
    setting("skin_line_width", Scope::region, &ShellSettings::skin_line_width, Unit::mm, 0.05_mm, 5_mm,
            "Line width of bottoms and of solid infill; auto keeps the cross-section of the nozzle; a share is of "
            "nozzle_diameter."),
    setting("top_skin_line_width", Scope::region, &ShellSettings::top_skin_line_width, Unit::mm, 0.05_mm, 5_mm,
            "Line width of top surfaces; auto is nozzle_diameter, narrow for an even surface; a share is of "
            "nozzle_diameter."),
    setting("skin_angle", Scope::region, &ShellSettings::skin_angle, Unit::degrees, -360, 360,
            "Direction of the lines of solid layers, against X; every second layer is turned by 90°. auto runs along "
            "straight walls, where lines at a slant would leave gaps at their ends, along tops twice as long as wide "
            "and, for a layer's other tops, like those, and at 45° elsewhere."),
    setting(
        "top_pattern", Scope::region, &ShellSettings::top_pattern,
        "How the lines of top surfaces lie: monotonic, each beside the one before; monotonic_lines, not joined at "
        "their ends; lines, in the shortest order; aligned_lines, in one direction in all layers; concentric, rings "
        "along the edge; hilbert, archimedean, octagram, fermat, one winding curve."),
    setting("bottom_pattern", Scope::region, &ShellSettings::bottom_pattern,
            "The same for bottoms and for solid layers inside."),
    setting("infill_solid_every_layers", Scope::region, &ShellSettings::infill_solid_every_layers, Unit::layers, 1,
            100000, "Every so many layers sparse infill is solid; auto: never."),
    setting("infill_solid_below_area", Scope::region, &ShellSettings::infill_solid_below_area, Unit::mm2, 0, 1000000,
            "A patch of sparse infill smaller than this is made solid."),
    setting("gap_fill_enabled", Scope::region, &ShellSettings::gap_fill_enabled,
            "Strips of a solid layer that are too narrow for its lines get one bead along them; off: they stay open."),
    setting("overhang_walls", Scope::region, &ShellSettings::overhang_walls,
            "Walls and skin over air have a speed and a fan of their own, and walls that both ends hold are strands; "
            "off: they are printed like others."),
    setting("bridges", Scope::region, &ShellSettings::bridges,
            "Bottoms over air that rest on two sides are printed as bridges: free strands along the shorter span."),
    setting("bridge_angle", Scope::region, &ShellSettings::bridge_angle, Unit::degrees, -360, 360,
            "Direction of all bridges, against X; auto finds it for each."),
    setting("bridge_flow", Scope::region, &ShellSettings::bridge_flow, Unit::percent, 10, 300,
            "Plastic in a bridge's strand, as a share of a round strand of the nozzle's diameter."),
    setting("bridge_anchor", Scope::region, &ShellSettings::bridge_anchor, Unit::mm, 0_mm, 20_mm,
            "How far a bridge reaches over the layer that it rests on."),
    setting("ironing_enabled", Scope::region, &ShellSettings::ironing_enabled,
            "Top surfaces are gone over once more, closely and with little plastic, so that they get smooth."),
    setting("ironing_surfaces", Scope::region, &ShellSettings::ironing_surfaces,
            "What is ironed: top, whatever nothing lies above; topmost, that of the last layer; solid, every solid "
            "area."),
    setting("ironing_flow", Scope::region, &ShellSettings::ironing_flow, Unit::percent, 0.1, 100,
            "Plastic that ironing adds, as a share of a layer."),
    setting("ironing_line_spacing", Scope::region, &ShellSettings::ironing_line_spacing, Unit::mm, 0.02_mm, 5_mm,
            "Distance of the lines that are ironed along."),
    setting("ironing_inset", Scope::region, &ShellSettings::ironing_inset, Unit::mm, 0_mm, 100_mm,
            "How far ironing keeps from the edge of the surface; auto is half of nozzle_diameter."),
    setting("ironing_angle", Scope::region, &ShellSettings::ironing_angle, Unit::degrees, -360, 360,
            "Direction of ironing, against X; auto goes across the lines of the surface."),
    setting("ironing_prime", Scope::region, &ShellSettings::ironing_prime, Unit::mm3, 0, 20,
            "Plastic that is pushed forward when ironing is over, beside what was drawn back: it left the nozzle "
            "meanwhile."),
    setting("small_area_flow_length", Scope::region, &ShellSettings::small_area_flow_length, Unit::mm, 0_mm, 2_mm,
            "Each line of a solid layer holds as much less plastic as this length of it: what is laid twice where it "
            "turns into the next. 0.25 suits a nozzle of 0.4 mm."),
};
static_assert(complete<ShellSettings>(shell_schema));

}  // namespace weft
