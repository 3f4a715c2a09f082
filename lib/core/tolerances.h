#pragma once
#include "core/microns.h"

/// Every tolerance of the program that is not a setting: value, unit, meaning, and who relies on it.
namespace weft::tolerances {
using namespace weft::literals;

/// Open contours whose ends are no further apart than this are closed in place. slice/stitch.
inline constexpr Um stitch_gap = 0.1_mm;

/// A region smaller than this prints nothing and is dropped after Booleans, µm²: a square of 0.02 mm. geometry/boolean.
inline constexpr double sliver_area_um2 = 400;

/// How far a chord may stand off a round corner made by an offset. geometry/offset.
inline constexpr Um arc = 5_um;

/// How far a bead's path may be moved to be printed with fewer moves. motion/resample.
inline constexpr Um path = 4_um;

/// A segment along which a bead's band changes by more than this is cut, because firmware extrudes evenly along a
/// segment. motion/resample.
inline constexpr Um band_step = 20_um;

/// No piece of such a cut is shorter: firmware would choke on the moves, and plastic does not follow. motion/resample.
inline constexpr Um shortest_piece = 0.2_mm;

/// … but where the band would change by more than this over it, three tenths of a bead: there, in corners, half as
/// long is allowed. motion/resample, walls/trace.
inline constexpr Um band_leap = 135_um;

/// A piece of a bead no longer than this that goes straight on is part of the move before or after: it tells of a step
/// in width, and firmware plans a limited number of moves a second. gcode/moves; walls/trace, walls/footprints.
inline constexpr Um least_move = 12_um;

}  // namespace weft::tolerances
