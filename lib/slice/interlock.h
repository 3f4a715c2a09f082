// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <cstddef>

namespace weft::slice {

/// How two parts that touch are woven into each other: where they meet, beams of one and of the other lie side by side,
/// and cross those of the layers below, so that neither can be pulled off.
struct InterlockStyle {
  Um beam_width = 800;
  double orientation_deg = 22.5;  ///< of the beams, against X
  int beam_layers = 2;            ///< so many layers have their beams in one direction, the next across
  int depth = 2;                  ///< how far they reach into either part, beams
  int avoidance = 2;              ///< how far they keep off what is seen from outside, beams
};

/// What changes hands on a layer.
struct Interlocked {
  Regions to_a, to_b;  ///< beams of a, and of b; they do not overlap
};

/// @param layer its number, upwards  @param may where beams may be: what is not seen from outside
/// Post: what changes hands lies in a or b. Empty where they do not touch. Law: moving everything by whole periods of
/// the beams moves the result. Cost: some Booleans where they touch.
Interlocked interlocked(const InterlockStyle& style, std::size_t layer, const Regions& a, const Regions& b,
                        const Regions& may);

}  // namespace weft::slice
