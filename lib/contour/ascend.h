// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "contour/surface.h"
#include "model/bead.h"

namespace weft::contour {

/// A layer of an object, by which its surface is looked at.
struct AtHeight {
  Um z = 0;  ///< its top, over the bed that the object stands on
  Um height = 0;
};

/// Puts lines of top skin that will follow a slope in the order in which they ascend, so that the flat of the nozzle
/// meets nothing that is higher and printed already. Lines that are joined by turns part there; a turn stays with the
/// line before it.
/// Post: beads of a sequence still follow each other; those of other roles, and on level tops, stay as they are.
void ascend(const Surface& surface, AtHeight at, Beads& beads);

}  // namespace weft::contour
