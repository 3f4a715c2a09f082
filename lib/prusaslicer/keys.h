// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <optional>
#include <span>
#include <string_view>

/// The table of PrusaSlicer's keys: every one has one row, which tells its name, its form and its fate.
/// Source: the configuration that PrusaSlicer 2.5 saves when it is given none; keys that came later, as 2.9 documents
/// them.
namespace weft::prusaslicer {

/// How a value becomes weft's.
enum class Form {
  none,    ///< it becomes nothing: weft has no counterpart
  length,  ///< mm, to the micron
  number,
  times_100,     ///< a factor there, percent here
  zero_is_auto,  ///< 0 there, auto here
  share,         ///< a number or a percentage, with the same base
  flag,
  text,          ///< the first of a list
  choice,        ///< see choice_rows
  width,         ///< a share is of the layer height, 0 is `automatic` × nozzle unless extrusion_width says otherwise
  speed,         ///< a share is of the key `of`, which stands above it; 0 is max_print_speed
  acceleration,  ///< 0 leaves it to the firmware
  limit,         ///< of an axis
  reckoned,      ///< with other keys, by arithmetic of its own (import.cpp)
};

/// How the ini writes a value.
enum class Written { plain, flag, text, texts };

struct Key {
  std::string_view name;
  Form form = Form::none;
  std::string_view ours{};                    ///< the setting that is called by this name; empty: none is
  std::string_view of{};                      ///< of a speed: what a share is of
  double automatic = 0;                       ///< of a width: in nozzle diameters
  std::optional<std::string_view> neutral{};  ///< of a missing key: the values that change nothing, between `|`
  std::string_view fate{};                    ///< what becomes of it, or why it has no effect here
  Written written = Written::plain;
  std::optional<std::string_view> initial{};  ///< PrusaSlicer's own value where no preset says one; nothing: not known
  bool of_filament = false;                   ///< a filament may override it as `filament_<name>`; `nil` does not
  bool telling = false;                       ///< only that family has it: a profile is told by two of them
};

/// A setting of weft's means the same, in another form at the most.
std::span<const Key> ported_keys();
/// What becomes of it depends on other keys as well.
std::span<const Key> reckoned_keys();
/// It changes nothing here whatever it says.
std::span<const Key> idle_keys();
/// It would change the print and is not supported: told, unless it says what is `neutral`.
std::span<const Key> missing_keys();

/// All of them, in that order.
std::span<const Key> keys();

/// f(row) for each reckoned key of that form, in the order of the table.
template <class F>
void for_each_reckoned(Form form, F f) {
  for (const auto& row : reckoned_keys())
    if (row.form == form) f(row);
}

/// The row of a key; null when PrusaSlicer has none of that name. Cost: O(log n).
const Key* find_key(std::string_view name);

/// PrusaSlicer's name of a setting of weft's; empty when it has none.
std::string_view name_of(std::string_view ours);

/// One value of a choice, and what is lost where weft has no such thing.
struct ChoiceRow {
  std::string_view key, theirs, ours, loss;
};
inline constexpr std::array choice_rows{
    ChoiceRow{"gcode_flavor", "marlin", "marlin", ""},
    ChoiceRow{"gcode_flavor", "marlin2", "marlin2", ""},
    ChoiceRow{"gcode_flavor", "klipper", "klipper", ""},
    ChoiceRow{"gcode_flavor", "reprapfirmware", "reprapfirmware", ""},
    ChoiceRow{"gcode_flavor", "reprap", "marlin", "Marlin's dialect is written"},
    ChoiceRow{"gcode_flavor", "repetier", "repetier", ""},
    ChoiceRow{"gcode_flavor", "smoothie", "smoothie", ""},
    ChoiceRow{"gcode_flavor", "teacup", "marlin", "Marlin's dialect is written"},
    ChoiceRow{"gcode_flavor", "sailfish", "marlin", "Marlin's dialect is written"},
    ChoiceRow{"gcode_flavor", "makerware", "marlin", "Marlin's dialect is written"},
    ChoiceRow{"gcode_flavor", "mach3", "marlin", "Marlin's dialect is written"},
    ChoiceRow{"gcode_flavor", "machinekit", "marlin", "Marlin's dialect is written"},
    ChoiceRow{"gcode_flavor", "no-extrusion", "marlin", ""},
    ChoiceRow{"external_perimeters_first", "0", "inside_out", ""},
    ChoiceRow{"external_perimeters_first", "1", "outside_in", ""},
    ChoiceRow{"fill_pattern", "rectilinear", "lines", ""},
    ChoiceRow{"fill_pattern", "alignedrectilinear", "aligned", ""},
    ChoiceRow{"fill_pattern", "monotonic", "lines", ""},
    ChoiceRow{"fill_pattern", "zigzag", "zigzag", ""},
    ChoiceRow{"fill_pattern", "line", "slanted", ""},
    ChoiceRow{"fill_pattern", "grid", "grid", ""},
    ChoiceRow{"fill_pattern", "triangles", "triangles", ""},
    ChoiceRow{"fill_pattern", "gyroid", "gyroid", ""},
    ChoiceRow{"fill_pattern", "concentric", "concentric", ""},
    ChoiceRow{"fill_pattern", "stars", "trihexagon", ""},
    ChoiceRow{"fill_pattern", "cubic", "cubic", ""},
    ChoiceRow{"fill_pattern", "honeycomb", "honeycomb", ""},
    ChoiceRow{"fill_pattern", "3dhoneycomb", "honeycomb_3d", ""},
    ChoiceRow{"fill_pattern", "hilbertcurve", "hilbert", ""},
    ChoiceRow{"fill_pattern", "archimedeanchords", "archimedean", ""},
    ChoiceRow{"fill_pattern", "octagramspiral", "octagram", ""},
    ChoiceRow{"fill_pattern", "adaptivecubic", "cubicsubdiv", ""},
    ChoiceRow{"fill_pattern", "supportcubic", "support_cubic", ""},
    ChoiceRow{"fill_pattern", "lightning", "lightning", ""},
    ChoiceRow{"fill_pattern", "tri-hexagon", "trihexagon", ""},
    ChoiceRow{"fill_pattern", "quartercubic", "quarter_cubic", ""},
    ChoiceRow{"fill_pattern", "tetrahedral", "tetrahedral", ""},
    ChoiceRow{"fill_pattern", "crosszag", "crosszag", ""},
    ChoiceRow{"fill_pattern", "lockedzag", "lockedzag", ""},
    ChoiceRow{"fill_pattern", "crosshatch", "crosshatch", ""},
    ChoiceRow{"fill_pattern", "lateral-lattice", "lateral_lattice", ""},
    ChoiceRow{"fill_pattern", "2dlattice", "lateral_lattice", ""},
    ChoiceRow{"fill_pattern", "lateral-honeycomb", "lateral_honeycomb", ""},
    ChoiceRow{"fill_pattern", "2dhoneycomb", "lateral_honeycomb", ""},
    ChoiceRow{"fill_pattern", "tpmsd", "diamond", ""},
    ChoiceRow{"fill_pattern", "tpmsfk", "fischer_koch", ""},
    ChoiceRow{"top_fill_pattern", "monotonic", "monotonic", ""},
    ChoiceRow{"top_fill_pattern", "rectilinear", "lines", ""},
    ChoiceRow{"top_fill_pattern", "zigzag", "lines", ""},
    ChoiceRow{"top_fill_pattern", "monotoniclines", "monotonic_lines", ""},
    ChoiceRow{"top_fill_pattern", "alignedrectilinear", "aligned_lines", ""},
    ChoiceRow{"top_fill_pattern", "concentric", "concentric", ""},
    ChoiceRow{"top_fill_pattern", "hilbertcurve", "hilbert", ""},
    ChoiceRow{"top_fill_pattern", "archimedeanchords", "archimedean", ""},
    ChoiceRow{"top_fill_pattern", "octagramspiral", "octagram", ""},
    ChoiceRow{"bottom_fill_pattern", "monotonic", "monotonic", ""},
    ChoiceRow{"bottom_fill_pattern", "rectilinear", "lines", ""},
    ChoiceRow{"bottom_fill_pattern", "zigzag", "lines", ""},
    ChoiceRow{"bottom_fill_pattern", "monotoniclines", "monotonic_lines", ""},
    ChoiceRow{"bottom_fill_pattern", "alignedrectilinear", "aligned_lines", ""},
    ChoiceRow{"bottom_fill_pattern", "concentric", "concentric", ""},
    ChoiceRow{"bottom_fill_pattern", "hilbertcurve", "hilbert", ""},
    ChoiceRow{"bottom_fill_pattern", "archimedeanchords", "archimedean", ""},
    ChoiceRow{"bottom_fill_pattern", "octagramspiral", "octagram", ""},
    ChoiceRow{"support_material_buildplate_only", "0", "everywhere", ""},
    ChoiceRow{"support_material_buildplate_only", "1", "buildplate", ""},
    ChoiceRow{"support_material_pattern", "rectilinear", "zigzag", ""},
    ChoiceRow{"support_material_pattern", "rectilinear-grid", "grid", ""},
    ChoiceRow{"support_material_pattern", "honeycomb", "triangles", "the nearest pattern is triangles"},
    ChoiceRow{"support_material_interface_pattern", "rectilinear", "zigzag", ""},
    ChoiceRow{"support_material_interface_pattern", "auto", "zigzag", ""},
    ChoiceRow{"support_material_interface_pattern", "rectilinear_interlaced", "zigzag", "directions do not alternate"},
    ChoiceRow{"support_material_interface_pattern", "concentric", "concentric", ""},
    ChoiceRow{"brim_type", "outer_only", "outside", ""},
    ChoiceRow{"brim_type", "inner_only", "inside", ""},
    ChoiceRow{"brim_type", "outer_and_inner", "everywhere", ""},
    ChoiceRow{"brim_type", "no_brim", "outside", ""},
    ChoiceRow{"seam_position", "random", "random", ""},
    ChoiceRow{"seam_position", "nearest", "shortest", ""},
    ChoiceRow{"seam_position", "aligned", "aligned", ""},
    ChoiceRow{"seam_position", "rear", "back", ""},
    ChoiceRow{"slicing_mode", "regular", "regular", ""},
    ChoiceRow{"top_one_perimeter_type", "none", "none", ""},
    ChoiceRow{"top_one_perimeter_type", "top", "top", ""},
    ChoiceRow{"top_one_perimeter_type", "topmost", "topmost", ""},
    ChoiceRow{"arc_fitting", "disabled", "false", ""},
    ChoiceRow{"arc_fitting", "emit_center", "true", ""},
    ChoiceRow{"ironing_type", "top", "top", ""},
    ChoiceRow{"ironing_type", "topmost", "topmost", ""},
    ChoiceRow{"ironing_type", "solid", "solid", ""},
    ChoiceRow{"slicing_mode", "even_odd", "even_odd", ""},
    ChoiceRow{"slicing_mode", "close_holes", "close_holes", ""},
    ChoiceRow{"machine_limits_usage", "emit_to_gcode", "true", ""},
    ChoiceRow{"machine_limits_usage", "time_estimate_only", "false", ""},
    ChoiceRow{"machine_limits_usage", "ignore", "false", "the estimate of time uses the limits of the axes"},
    ChoiceRow{"gcode_label_objects", "disabled", "none", ""},
    ChoiceRow{"gcode_label_objects", "0", "none", ""},
    ChoiceRow{"gcode_label_objects", "octoprint", "comments", ""},
    ChoiceRow{"gcode_label_objects", "1", "comments", ""},
    ChoiceRow{"gcode_label_objects", "firmware", "firmware", ""},
};

}  // namespace weft::prusaslicer
