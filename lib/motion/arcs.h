// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "model/plan.h"
#include "settings/groups/machine.h"

#include <optional>
#include <vector>

/// Runs of moves that lie on a circle, told as one arc.
namespace weft::motion {

struct ArcRules {
  Um tolerance = 12;  ///< how far an arc may stand off the path
  Box room;           ///< no arc is told of a path that comes nearer to its edge than that; empty: anywhere
  Firmware firmware = Firmware::marlin2;
  std::optional<Um> segment{};  ///< pieces that it cuts arcs into; absent: as its documents say
};

/// How long the pieces are that firmware cuts an arc of that radius into, µm, where no setting says so: 1 mm with
/// Klipper ([gcode_arcs], resolution); 0.1 to 1 mm and 72 a circle with Marlin (MIN_ARC_SEGMENT_MM, MAX_ARC_SEGMENT_MM,
/// MIN_CIRCLE_SEGMENTS); so many that they stand off it by 5 µm with RepRapFirmware.
double chord_um(Firmware firmware, std::optional<Um> segment, double radius_um);

/// Finds the arcs of a bead on the plane of its layer, from its first junction on each as long as it can be. An arc
/// stands for two pieces or more, turns by less than 180° (two of one circle are one, up to 342°), has a radius of up
/// to 1 m, and one speed; band × flow of its junctions differs by no more than tolerances::band_step, because firmware
/// extrudes evenly along an arc. It bends more than its tolerance: what is nearly straight stays straight. What
/// firmware makes of it stands off it by no more than that, too: of tight curves it would make corners. Post:   no
/// point of the path is further from its arc than the tolerance and 1.5 µm for the centre, which lies on the
///         lattice, and the other way round. The path stays as it was.
/// Source: an arc through two points has one unknown, its sagitta; each point between bounds it from both sides, and
///         what all of them allow is an interval.
/// Cost:   O(n log n).
void fit_arcs(const ArcRules& rules, Extrude& bead);

/// How far the path is from its arc at most, µm.
double deviation_um(const Extrude& bead, const Arc& arc);

/// Where the pieces end that firmware cuts an arc into, by chord_um. At least one; the last is the arc's end.
Polyline chords_of(Firmware firmware, std::optional<Um> segment, const Extrude& bead, const Arc& arc);

}  // namespace weft::motion
