// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "gcode/writer.h"

/// The comments that viewers and print servers read at the top and the bottom of a file.
namespace weft::gcode {

/// Everything before the first command. Print servers read the first MiB only: it fits unless thumbnails are huge.
std::string top_comments(const Job& job);

/// Everything after the last command: filament, time, and the settings as `; key = value`.
std::string bottom_comments(const Job& job);

/// Of a layer of the job: the one that it has, or made from the plan.
LayerDigest digest_of(const Job& job, std::size_t layer);

/// How often another tool is loaded.
std::size_t tool_changes(const Job& job);

/// 1d 2h 3m 4s, without the zeros in front, as PrusaSlicer writes durations.
std::string duration(double seconds);

/// Where the nozzle goes, over all moves.
Extents extents_of(const Job& job);

/// Z of the highest layer; 0 without layers.
Um top_of(const PrintPlan& plan);

/// What the beads of first layers cover, their width included.
Box first_layer_box(const Job& job);
/// The convex hull of that: of the squares around their junctions; counter-clockwise.
Ring first_layer_hull(const Job& job);

}  // namespace weft::gcode
