// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "settings/groups/layers.h"

#include <array>

namespace weft::slice {

/// Four layers, one upon the other, of which the second is looked at; missing ones are empty.
struct FourLayers {
  const Regions *below, *own, *next, *over;
};

/// What becomes of two layers where a hole begins in the middle of the air over a wider one, as a screw's does over its
/// counterbore: rings around it would hang on nothing.
struct CounterboreCeiling {
  int holes = 0;
  Regions open;  ///< taken out of the layer: what lies beside the holes, between two strips that cross the wider one
  Regions open_next;  ///< taken out of the next one, whose strips cross these: a rectangle around each hole
  Regions closed;     ///< of `sacrificial`: put into the layer, to be drilled out
};

/// The holes of `own` around which at least `line` hangs over a hole of `below`, all round. Only a wider hole that has
/// nothing but this one above it, and nothing in it, is crossed by strips, and only where the two layers above close
/// it: strips go along the smaller slot: the shorter way across, along flats of the hole where it has some. Post:
/// `open` lies in the wider hole and off the hole; after both layers what is left open is a rectangle around the
///       hole. Cost: some Booleans of each hole that is found.
/// @param how not none
CounterboreCeiling counterbore_ceiling(const FourLayers& layers, CounterboreHoleBridging how, Um line);

}  // namespace weft::slice
