// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/schema.h"

#include <array>

namespace weft {
using namespace weft::literals;

/// What of a cut through the model is inside.
enum class SlicingMode {
  regular,     ///< what any shell encloses
  even_odd,    ///< what an odd number of outlines encloses
  close_holes  ///< what any outline encloses: holes are filled
};
constexpr auto choices_of(SlicingMode) {
  return std::array{Choice<SlicingMode>{SlicingMode::regular, "regular"},
                    Choice<SlicingMode>{SlicingMode::even_odd, "even_odd"},
                    Choice<SlicingMode>{SlicingMode::close_holes, "close_holes"}};
}

/// How the model is cut.
struct LayerSettings {
  Um layer_height = 0.2_mm;
  std::optional<Um> initial_layer_height;                 ///< auto: layer_height
  std::optional<LengthOrShare> initial_layer_line_width;  ///< auto: as in the other layers
  Um resolution = 0.0125_mm;
  SlicingMode slicing_mode = SlicingMode::regular;
  bool magic_spiralize = false;
  bool smooth_spiralized_contours = true;
};

inline constexpr Rows layer_schema{
    setting("layer_height", Scope::layer, &LayerSettings::layer_height, Unit::mm, 0.02_mm, 2_mm, "Height of a layer."),
    setting("initial_layer_height", Scope::object, &LayerSettings::initial_layer_height, Unit::mm, 0.02_mm, 2_mm,
            "Height of the first layer; auto is layer_height."),
    setting("initial_layer_line_width", Scope::region, &LayerSettings::initial_layer_line_width, Unit::mm, 0.05_mm,
            5_mm,
            "Line width of everything in the first layer; auto is that of the other layers; a share is of "
            "nozzle_diameter."),
    setting("resolution", Scope::object, &LayerSettings::resolution, Unit::mm, 0_mm, 1_mm,
            "How far a simplified outline may stand off the model's."),
    setting("slicing_mode", Scope::object, &LayerSettings::slicing_mode,
            "What of a cut is solid: regular, what any shell encloses; even_odd, what an odd number of outlines "
            "encloses, for models made of shells within shells; close_holes, holes too."),
    setting("magic_spiralize", Scope::plate, &LayerSettings::magic_spiralize,
            "Above its bottom layers the object is one wall that rises without an end, and without a seam: a vase."),
    setting("smooth_spiralized_contours", Scope::plate, &LayerSettings::smooth_spiralized_contours,
            "Each turn of a vase passes over into the next along all of its way; off: at its end."),
};
static_assert(complete<LayerSettings>(layer_schema));

}  // namespace weft
