// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "slice/slice.h"

#include <optional>
#include <vector>

namespace weft::pipeline {

/// A place where what stands on it is so tall, and it so narrow, that the nozzle bends it aside.
struct Swaying {
  Point at;              ///< the middle of the place
  Um z = 0;              ///< its height
  double area_mm2 = 0;   ///< of its convex hull
  double height_mm = 0;  ///< of what stands on it
  double aside_mm = 0;   ///< how far the top of that gives
};

/// The place of an object that gives most, if it gives by more than a bead is wide: then beads are laid beside those
/// below them. Legs stand alone until something joins them.
/// @param from  the first layer that nothing beside it holds: those below are kept by support
/// @param bead  its width, µm
std::optional<Swaying> most_swaying(const std::vector<slice::Cut>& cuts, std::size_t from, Um bead);

}  // namespace weft::pipeline
