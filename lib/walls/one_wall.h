// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "walls/part.h"

/// Private to walls: parts that get a single wall where they are seen from above.
namespace weft::walls {

/// What of a region with one wall around it is seen from above, in patches wider than two inner walls; narrower ones
/// keep their walls. @param inside what the one wall leaves @param above outlines of the layer above
Regions seen_from_above(const Widths& widths, const Regions& inside, const Regions& above);

/// Lays the other walls of a part that has one: around what of its inside is not `seen`.
void add_covered_walls(const WallSettings& settings, const Widths& widths, const Regions& seen, Um nozzle,
                       std::uint32_t index, Part& part);

}  // namespace weft::walls
