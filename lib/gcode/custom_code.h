// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "gcode/writer.h"
#include "macro/macro.h"

#include <string_view>
#include <vector>

/// The G-code that a profile brings with it, and what it may name of the print.
namespace weft::gcode {

/// The texts, read. Expanded in this order they share global variables.
struct CustomCode {
  macro::Template start, before_layer, layer, tool_change, load, unload, pause, color_change, between_objects, end;

  /// @throws Error{settings} for syntax
  explicit CustomCode(const GcodeSettings& settings);

  /// In the order they are expanded in.
  std::vector<const macro::Template*> all() const;

  /// @throws Error{settings} for names and functions that do not exist, in branches not taken too
  void check(const macro::Variables& variables) const;

  /// Whether any of it names a variable.
  bool names_any() const;
};

/// Settings, and what is known of the whole print. There is no date and no time of day but where the settings say one
/// (pipeline/made_at.h): the same input gives the same bytes. layer_num, layer_z and the numbers of the tools are those
/// of the start; set_layer changes them.
/// @param with_settings whether anybody asks: each of hundreds becomes text
macro::Variables print_variables(const Job& job, bool with_settings = true);
void set_layer(macro::Variables& variables, std::size_t index, Um z);

/// The tool that prints first.
void set_initial_tool(macro::Variables& variables, ToolId tool);

/// The G-code of `gcode_at_heights` for a height, read.
macro::Template template_of(const HeightMark& mark);

/// From that tool, which is still the current one, to another, on a layer whose top is at z.
void set_tool_change(macro::Variables& variables, ToolId from, ToolId to, Um z);
/// Lists without an index (`[temperature]`) are read for it, as in PrusaSlicer's code of a change for the next one.
void set_filament(macro::Variables& variables, ToolId tool);
/// The change is done.
void set_current_tool(macro::Variables& variables, ToolId tool);

/// Does a line of the code begin with that command, such as "M104"?
bool has_command(std::string_view code, std::string_view command);

/// What the start G-code takes care of: by its commands, or because a macro of the firmware is handed the temperature.
struct Heating {
  bool nozzle = false, bed = false, chamber = false;
};
Heating heating_in(std::string_view expanded, const macro::Template& read, const MaterialSettings& material);

}  // namespace weft::gcode
