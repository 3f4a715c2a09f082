#pragma once
#include "settings/schema.h"

namespace weft {
using namespace weft::literals;

/// Beads along the outlines.
struct WallSettings {
  int wall_line_count = 3;
  std::optional<Um> wall_line_width_0;
  std::optional<Um> wall_line_width_x;
};

inline constexpr std::tuple wall_schema{
    setting("wall_line_count", &WallSettings::wall_line_count, Unit::none, 0, 1000, "Walls on each side of the part.", "perimeters"),
    setting("wall_line_width_0", &WallSettings::wall_line_width_0, Unit::mm, 0.05_mm, 5_mm, "Line width of the outermost wall; auto is 1.05 × nozzle_diameter.",
            "external_perimeter_extrusion_width"),
    setting("wall_line_width_x", &WallSettings::wall_line_width_x, Unit::mm, 0.05_mm, 5_mm,
            "Line width of the other walls; auto keeps the cross-section of the nozzle.", "perimeter_extrusion_width"),
};
static_assert(complete<WallSettings>(wall_schema));

}  // namespace weft
