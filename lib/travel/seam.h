#pragma once
#include "model/bead.h"
#include "settings/travel.h"

#include <cstdint>
#include <span>
#include <vector>

namespace weft::travel {

/// Where a closed bead begins: on the segment that begins at that junction. At the junction itself when `at` is its
/// place.
struct Start {
  std::uint32_t segment = 0;
  Point at;
  friend bool operator==(const Start&, const Start&) = default;
};

/// A corner of a wall that a seam may hide in.
struct Corner {
  std::uint32_t junction = 0;
  float strength = 0;  ///< 0 … 1: how well it hides a seam
};

/// What is known of an outer wall's seam before the layer below is.
struct SeamChoices {
  std::uint32_t block = 0, bead = 0;  ///< indices into the layer's blocks and the beads of the block's object
  std::vector<Corner> corners;        ///< best first, a few
};

/// The corners of a closed bead that attract a seam, best first, at most `most`. The turn of a corner is measured over
/// half a millimetre to each side, so that a finely sampled curve has no corner. Cost: O(n).
std::vector<Corner> corners_of(const Bead& bead, SeamCorner kind, std::size_t most);

/// The point of a closed bead nearest to p; within `snap` of a junction it is the junction. Cost: O(n).
Start nearest_start(const Bead& bead, Point p, Um snap);

/// Chooses the seam of one outer wall.
/// @param below seams of the layer below
/// @param seed  of the random seam
Start choose_seam(const TravelSettings& settings, const Bead& bead, std::span<const Corner> corners,
                  std::span<const Point> below, std::uint64_t seed);

}  // namespace weft::travel
