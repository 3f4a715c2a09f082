// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/schema.h"

#include <array>

namespace weft {
using namespace weft::literals;

/// How the objects of a print are named, so that one of them can be cancelled.
enum class ObjectLabels { none, firmware, comments };
constexpr auto choices_of(ObjectLabels) {
  return std::array{Choice<ObjectLabels>{ObjectLabels::none, "none"},
                    Choice<ObjectLabels>{ObjectLabels::firmware, "firmware"},
                    Choice<ObjectLabels>{ObjectLabels::comments, "comments"}};
}

/// Whose comments the file speaks in, so that viewers and print servers find layers, features and metadata.
enum class CommentDialect { prusaslicer, cura, orca };
constexpr auto choices_of(CommentDialect) {
  return std::array{Choice<CommentDialect>{CommentDialect::prusaslicer, "prusaslicer"},
                    Choice<CommentDialect>{CommentDialect::cura, "cura"},
                    Choice<CommentDialect>{CommentDialect::orca, "orca"}};
}

/// What the pictures in the head of the file show.
enum class ThumbnailContent { model, toolpaths };
constexpr auto choices_of(ThumbnailContent) {
  return std::array{Choice<ThumbnailContent>{ThumbnailContent::model, "model"},
                    Choice<ThumbnailContent>{ThumbnailContent::toolpaths, "toolpaths"}};
}

/// What the file holds besides moves.
struct GcodeSettings {
  bool relative_extrusion = true;
  bool volumetric_extrusion = false;
  bool write_extrusion = true;
  std::string machine_start_gcode = "G28";
  std::string machine_end_gcode = "M104 S0\nM140 S0\nM84";
  std::string before_layer_gcode;
  std::string layer_gcode;
  std::string tool_change_gcode;
  std::string machine_extruder_start_code;
  std::string machine_extruder_end_code;
  std::string pause_gcode;
  std::string color_change_gcode;
  std::string between_objects_gcode;
  std::string gcode_variables;
  std::string gcode_substitutions;
  ObjectLabels gcode_label_objects = ObjectLabels::firmware;
  CommentDialect gcode_comment_dialect = CommentDialect::prusaslicer;
  bool gcode_progress = true;
  bool gcode_machine_limits = false;
  bool gcode_flow_comments = false;
  bool arc_fitting = false;
  Um arc_tolerance = 0.0125_mm;
  std::optional<Um> arc_segment_length;
  PictureSizes thumbnails = {{32, 32}, {300, 300}};
  ThumbnailContent thumbnail_content = ThumbnailContent::model;
  std::string output_filename_format = "{input_filename_base}.gcode";
};

inline constexpr Rows gcode_schema{
    setting("relative_extrusion", Scope::plate, &GcodeSettings::relative_extrusion,
            "E is relative (M83); off: absolute (M82), from zero in each layer."),
    setting("volumetric_extrusion", Scope::plate, &GcodeSettings::volumetric_extrusion,
            "E is in mm³, not in mm of filament, retractions too: the firmware knows the diameter (M200)."),
    setting(
        "write_extrusion", Scope::plate, &GcodeSettings::write_extrusion,
        "E is written; off: moves alone, without E and retractions, for dry runs and machines without an extruder."),
    setting("machine_start_gcode", Scope::plate, &GcodeSettings::machine_start_gcode,
            "G-code before the print, with placeholders such as {material_print_temperature_layer_0}. Temperatures "
            "that it neither sets nor "
            "mentions are set around it."),
    setting("machine_end_gcode", Scope::plate, &GcodeSettings::machine_end_gcode, "G-code after the print."),
    setting("before_layer_gcode", Scope::plate, &GcodeSettings::before_layer_gcode,
            "G-code before the move to each layer: {layer_num}, {layer_z}."),
    setting("layer_gcode", Scope::plate, &GcodeSettings::layer_gcode,
            "G-code after the move to each layer: {layer_num}, {layer_z}."),
    setting("tool_change_gcode", Scope::plate, &GcodeSettings::tool_change_gcode,
            "G-code at changes of the tool: {previous_extruder}, {next_extruder}, {toolchange_z}. The tool is chosen "
            "after it, unless it does that itself."),
    setting("machine_extruder_start_code", Scope::tool, &GcodeSettings::machine_extruder_start_code,
            "G-code after this tool was loaded; with one tool, after machine_start_gcode."),
    setting("machine_extruder_end_code", Scope::tool, &GcodeSettings::machine_extruder_end_code,
            "G-code before another tool is loaded; with one tool, before machine_end_gcode."),
    setting("pause_gcode", Scope::plate, &GcodeSettings::pause_gcode,
            "G-code of pause_at_heights; empty: the firmware's command."),
    setting("color_change_gcode", Scope::plate, &GcodeSettings::color_change_gcode,
            "G-code of color_change_at_heights; empty: the firmware's command, M600 where it has one."),
    setting("between_objects_gcode", Scope::plate, &GcodeSettings::between_objects_gcode,
            "G-code between objects that are printed one after the other, before the first layer of the next."),
    setting("gcode_variables", Scope::plate, &GcodeSettings::gcode_variables,
            "Further names that custom G-code may use: lines `name = value`, lists between commas, texts in quotes. On "
            "import from PrusaSlicer, those "
            "of its keys that the custom G-code names."),
    setting("gcode_substitutions", Scope::plate, &GcodeSettings::gcode_substitutions,
            "Changes to the G-code between head and settings, one after the other: lines s/FIND/REPLACE/FLAGS, with "
            "any character for the slash. Flags: r, FIND is a regular expression (Perl's, $1 in REPLACE); i, of either "
            "case; w, whole words; s, in one piece: a dot is also the end of a line. The audit reads what they leave."),
    setting(
        "gcode_label_objects", Scope::plate, &GcodeSettings::gcode_label_objects,
        "Objects are named in the file: firmware (EXCLUDE_OBJECT for Klipper, M486 for others), comments, or none."),
    setting("gcode_comment_dialect", Scope::plate, &GcodeSettings::gcode_comment_dialect,
            "Whose comments the file speaks in: prusaslicer, cura or orca. Print servers and viewers tell by them what "
            "they read."),
    setting("gcode_progress", Scope::plate, &GcodeSettings::gcode_progress,
            "Progress and remaining time are written as M73, for Marlin, Klipper and RepRapFirmware."),
    setting("gcode_machine_limits", Scope::plate, &GcodeSettings::gcode_machine_limits,
            "The machine's limits of speed, acceleration and jerk are written at the top, in the firmware's commands; "
            "Klipper has none."),
    setting("gcode_flow_comments", Scope::plate, &GcodeSettings::gcode_flow_comments,
            "Moves of beads with flow compensation carry their ratio as a comment."),
    setting("arc_fitting", Scope::plate, &GcodeSettings::arc_fitting,
            "Moves along a curve are written as arcs, G2 and G3: fewer lines for firmware that reads them."),
    setting("arc_tolerance", Scope::plate, &GcodeSettings::arc_tolerance, Unit::mm, 0.001_mm, 0.1_mm,
            "How far an arc may stand off the moves that it stands for."),
    setting("arc_segment_length", Scope::plate, &GcodeSettings::arc_segment_length, Unit::mm, 0.02_mm, 10_mm,
            "Pieces that the firmware cuts arcs into: curves of which these would stand off by more than arc_tolerance "
            "are no arcs; auto: 1 with Klipper, and with other firmware what its documents say."),
    setting("thumbnails", Scope::plate, &GcodeSettings::thumbnails,
            "Sizes of the pictures of the plate in the head of the file, PNG; empty: none."),
    setting("thumbnail_content", Scope::plate, &GcodeSettings::thumbnail_content,
            "What these pictures show: model (the meshes) or toolpaths (the beads that are printed, with supports and "
            "brim)."),
    setting("output_filename_format", Scope::plate, &GcodeSettings::output_filename_format,
            "Name of the file where no -o says one, with placeholders such as {layer_height}."),
};
static_assert(complete<GcodeSettings>(gcode_schema));

}  // namespace weft
