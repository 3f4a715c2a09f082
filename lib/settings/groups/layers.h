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

/// What becomes of a hole that begins in the middle of the air over a wider one.
enum class CounterboreHoleBridging {
  none,        ///< rings around it hang
  partial,     ///< strips across the wider one on two layers leave a slot, then a rectangle around the hole
  sacrificial  ///< a layer closes it, to be drilled out
};
constexpr auto choices_of(CounterboreHoleBridging) {
  return std::array{Choice<CounterboreHoleBridging>{CounterboreHoleBridging::none, "none"},
                    Choice<CounterboreHoleBridging>{CounterboreHoleBridging::partial, "partial"},
                    Choice<CounterboreHoleBridging>{CounterboreHoleBridging::sacrificial, "sacrificial"}};
}

/// How the model is cut.
struct LayerSettings {
  Um layer_height = 0.2_mm;
  HeightBands layer_height_ranges;
  bool adaptive_layer_height_enabled = false;
  Um adaptive_layer_height_error = 0.08_mm;
  Um adaptive_layer_height_min = 0.07_mm;
  std::optional<Um> adaptive_layer_height_max;
  std::optional<bool> adaptive_layer_height_flats;
  std::optional<Um> initial_layer_height;                 ///< auto: layer_height
  std::optional<LengthOrShare> initial_layer_line_width;  ///< auto: as in the other layers
  Um resolution = 0.015_mm;
  SlicingMode slicing_mode = SlicingMode::regular;
  Um slice_closing_radius = 0.049_mm;
  CounterboreHoleBridging counterbore_hole_bridging = CounterboreHoleBridging::none;
  bool magic_spiralize = false;
  bool smooth_spiralized_contours = true;
  bool interlocking_enable = false;
  Um interlocking_beam_width = 0.8_mm;
  double interlocking_orientation = 22.5;
  int interlocking_beam_layer_count = 2;
  int interlocking_depth = 2;
  int interlocking_boundary_avoidance = 2;
  double spiral_smoothing = 200;
  double spiral_start_flow = 0;
  double spiral_finish_flow = 0;
  bool z_contouring = false;
  Um z_contour_min_height = 0.06_mm;
};

inline constexpr Rows layer_schema{
    setting("layer_height", Scope::layer, &LayerSettings::layer_height, Unit::mm, 0.02_mm, 2_mm, "Height of a layer."),
    setting("layer_height_ranges", Scope::object, &LayerSettings::layer_height_ranges,
            "Layers of other heights between two heights of the object: `0-5:0.1; 5-20:0.3`, mm; layer_height "
            "elsewhere."),
    setting(
        "adaptive_layer_height_enabled", Scope::object, &LayerSettings::adaptive_layer_height_enabled,
        "Layers are as high as the object's surface allows: thin where it is nearly flat, high where it is upright."),
    setting("adaptive_layer_height_error", Scope::object, &LayerSettings::adaptive_layer_height_error, Unit::mm,
            0.005_mm, 0.5_mm,
            "How far the steps of adaptive layers may stand off the surface: h(0.184 + c/2) for a face whose normal "
            "rises by c, as measured walls do."),
    setting("adaptive_layer_height_min", Scope::object, &LayerSettings::adaptive_layer_height_min, Unit::mm, 0.02_mm,
            2_mm, "Least height of an adaptive layer."),
    setting("adaptive_layer_height_max", Scope::object, &LayerSettings::adaptive_layer_height_max, Unit::mm, 0.02_mm,
            2_mm, "Greatest height of an adaptive layer; auto is 75 % of nozzle_diameter."),
    setting("adaptive_layer_height_flats", Scope::object, &LayerSettings::adaptive_layer_height_flats,
            "Layers end where horizontal faces lie: true without adaptive layers stretches all of them by up to 10 %; "
            "auto: with adaptive layers alone."),
    setting("initial_layer_height", Scope::object, &LayerSettings::initial_layer_height, Unit::mm, 0.02_mm, 2_mm,
            "Height of the first layer; auto is layer_height."),
    setting("initial_layer_line_width", Scope::region, &LayerSettings::initial_layer_line_width, Unit::mm, 0.05_mm,
            5_mm,
            "Line width of everything in the first layer; auto is that of the other layers; a share is of "
            "nozzle_diameter."),
    setting("resolution", Scope::object, &LayerSettings::resolution, Unit::mm, 0_mm, 1_mm,
            "How far an outline may stand off the model along 0.2 mm, less along more, to have a corner less; 0: each "
            "corner of the model stays."),
    setting("slicing_mode", Scope::object, &LayerSettings::slicing_mode,
            "What of a cut is solid: regular, what any shell encloses; even_odd, what an odd number of outlines "
            "encloses, for models made of shells within shells; close_holes, holes too."),
    setting("slice_closing_radius", Scope::object, &LayerSettings::slice_closing_radius, Unit::mm, 0_mm, 1_mm,
            "Bodies of a model that touch, or stand apart by up to twice this, are printed as one: no nozzle leaves so "
            "narrow a gap open, and walls on both sides of it would only stick to each other."),
    setting("counterbore_hole_bridging", Scope::object, &LayerSettings::counterbore_hole_bridging,
            "What becomes of a hole that begins over a wider one, as a screw's over its counterbore: none, rings "
            "around it hang; partial, strips across the wider one, on the next layer across them, and the hole's own "
            "outline from the third on; sacrificial, one layer closes it, to be drilled out."),
    setting("magic_spiralize", Scope::plate, &LayerSettings::magic_spiralize,
            "Above its bottom layers the object is one wall that rises without an end, and without a seam: a vase."),
    setting("smooth_spiralized_contours", Scope::plate, &LayerSettings::smooth_spiralized_contours,
            "Each turn of a vase passes over into the next along all of its way; off: at its end."),
    setting("interlocking_enable", Scope::object, &LayerSettings::interlocking_enable,
            "Where parts of one object that are printed with different tools touch, beams of one are woven into the "
            "other."),
    setting("interlocking_beam_width", Scope::object, &LayerSettings::interlocking_beam_width, Unit::mm, 0.1_mm, 20_mm,
            "Width of such a beam."),
    setting("interlocking_orientation", Scope::object, &LayerSettings::interlocking_orientation, Unit::degrees, 0, 360,
            "Direction of the beams; every other set of layers has them across."),
    setting("interlocking_beam_layer_count", Scope::object, &LayerSettings::interlocking_beam_layer_count, Unit::layers,
            1, 100, "Layers that have their beams in one direction."),
    setting("interlocking_depth", Scope::object, &LayerSettings::interlocking_depth, Unit::none, 1, 50,
            "How far beams reach into the other part, in widths of a beam."),
    setting("interlocking_boundary_avoidance", Scope::object, &LayerSettings::interlocking_boundary_avoidance,
            Unit::none, 0, 50, "How far beams keep off what is seen from outside, in widths of a beam."),
    setting("spiral_smoothing", Scope::plate, &LayerSettings::spiral_smoothing, Unit::percent, 0, 1000,
            "How far apart, in widths of their wall, turns of a vase may be that pass over into each other: what is "
            "further apart is a step of the model."),
    setting("spiral_start_flow", Scope::plate, &LayerSettings::spiral_start_flow, Unit::percent, 0, 100,
            "Plastic that a vase's first turn begins with; at its end it is all."),
    setting("spiral_finish_flow", Scope::plate, &LayerSettings::spiral_finish_flow, Unit::percent, 0, 100,
            "Plastic that a vase's last turn, which stays on its level, ends with."),
    setting("z_contouring", Scope::object, &LayerSettings::z_contouring,
            "Tops and outermost walls of gentle slopes follow the surface within their layer, instead of stepping."),
    setting("z_contour_min_height", Scope::object, &LayerSettings::z_contour_min_height, Unit::mm, 0.02_mm, 1_mm,
            "Least height that a bead has left where it follows the surface."),
};
static_assert(complete<LayerSettings>(layer_schema));

}  // namespace weft
