// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/schema.h"

#include <array>

namespace weft {
using namespace weft::literals;

/// How sparse infill is laid out.
enum class InfillPattern { lines, grid, triangles, gyroid, concentric };
constexpr auto choices_of(InfillPattern) {
  return std::array{Choice<InfillPattern>{InfillPattern::lines, "lines"},
                    Choice<InfillPattern>{InfillPattern::grid, "grid"},
                    Choice<InfillPattern>{InfillPattern::triangles, "triangles"},
                    Choice<InfillPattern>{InfillPattern::gyroid, "gyroid"},
                    Choice<InfillPattern>{InfillPattern::concentric, "concentric"}};
}

/// What stands inside the part between its shells.
struct InfillSettings {
  double infill_sparse_density = 20;
  InfillPattern infill_pattern = InfillPattern::grid;
  std::optional<Um> infill_line_width;
  double infill_angle = 45;
  LengthOrShare infill_overlap = share(15);
  bool infill_connect_lines = true;
  std::optional<Um> infill_sparse_thickness;
  bool infill_support_enabled = false;
  double infill_support_angle = 40;
};

inline constexpr std::tuple infill_schema{
    setting("infill_sparse_density", Scope::region, &InfillSettings::infill_sparse_density, Unit::percent, 0, 100,
            "Share of the inside that is plastic; 100 % is solid."),
    setting("infill_pattern", Scope::region, &InfillSettings::infill_pattern, "Layout of sparse infill."),
    setting("infill_line_width", Scope::region, &InfillSettings::infill_line_width, Unit::mm, 0.05_mm, 10_mm,
            "Line width of sparse infill; auto keeps the cross-section of the nozzle."),
    setting("infill_angle", Scope::region, &InfillSettings::infill_angle, Unit::degrees, -360, 360,
            "Direction of sparse lines, against X; the pattern lines is turned by 90° on every second layer."),
    setting("infill_overlap", Scope::region, &InfillSettings::infill_overlap, Unit::mm, 0_mm, 5_mm,
            "How far the ends of skin and infill lines reach into the innermost wall, to bond with it; a share is of "
            "that wall's line width."),
    setting(
        "infill_connect_lines", Scope::region, &InfillSettings::infill_connect_lines,
        "Neighbouring lines, solid ones too, are joined along the wall instead of travelling from one to the next."),
    setting("infill_sparse_thickness", Scope::object, &InfillSettings::infill_sparse_thickness, Unit::mm, 0.02_mm, 5_mm,
            "Height of sparse infill, printed every so many layers at once: as many as it holds; auto is layer_height. "
            "No more than nozzle_diameter."),
    setting("infill_support_enabled", Scope::object, &InfillSettings::infill_support_enabled,
            "Sparse infill only below what is solid and does not carry itself; elsewhere the inside stays hollow."),
    setting("infill_support_angle", Scope::object, &InfillSettings::infill_support_angle, Unit::degrees, 0, 90,
            "With infill_support_enabled: a shell that leans less than this from the vertical carries itself."),
};
static_assert(complete<InfillSettings>(infill_schema));

}  // namespace weft
