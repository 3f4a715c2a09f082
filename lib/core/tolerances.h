// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/microns.h"

/// Every tolerance of the program that is not a setting: value, unit, meaning, and who relies on it.
namespace weft::tolerances {
using namespace weft::literals;

/// Open contours whose ends are no further apart than this are closed in place. slice/stitch.
inline constexpr Um stitch_gap = 0.1_mm;

/// A region smaller than this prints nothing and is dropped after Booleans, µm²: a square of 0.02 mm. geometry/boolean.
inline constexpr double sliver_area_um2 = 400;

/// How far a chord may stand off a round corner made by an offset, and `path` for rounds of support. geometry/offset;
/// motion/resample.
inline constexpr Um arc = 5_um;

/// How far a bead's path may be moved to be printed with fewer moves: less than a printer's belts give.
/// model/simplify.
inline constexpr Um path = 10_um;

/// A segment along which a bead's band changes by more than this is cut, because firmware extrudes evenly along a
/// segment. motion/resample.
inline constexpr Um band_step = 20_um;

/// No piece of such a cut is shorter: firmware would choke on the moves, and plastic does not follow. motion/resample.
inline constexpr Um shortest_piece = 0.2_mm;

/// … but where the band would change by more than this over it, three tenths of a bead: there, in corners, half as
/// long is allowed. motion/resample.
inline constexpr Um band_leap = 135_um;

/// No piece of a bead is shorter: a machine that is made to turn within less all but stops. model/simplify;
/// gcode/moves.
inline constexpr Um least_move = 50_um;

/// `path` for lines of infill, which nobody sees: a twentieth of a line, a third of what they are laid over walls by.
/// least_move grows with it to 0.1 mm; with more, corners of narrow areas would be cut off. motion/resample.
inline constexpr Um path_inside = 20_um;

/// `band_step` for them: a ninth of a line. shortest_piece grows with it to 0.5 mm, as an orifice of 0.4 mm
/// lays nothing that is finer; so does band_leap. motion/resample.
inline constexpr Um band_inside = 50_um;

/// What is planned stays this far within where it may be, beside the half of its width: widths and places are rounded
/// on the way into the file, and neither the bed's border nor a head beside a part gives way. As much as
/// `audit_tolerance` is by default. pipeline/add_raft, arranged, support_object.
inline constexpr Um border = 10_um;

}  // namespace weft::tolerances
