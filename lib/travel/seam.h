// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/bead.h"
#include "settings/groups/travel.h"
#include "travel/comb.h"

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
  float strength = 0;  ///< 0 … 1: how sharp it is, by the liking of z_seam_corner
  float exposure = 0;  ///< −1 … 1: 0 is seen like a place on a flat wall, 1 from everywhere
};

/// What is known of an outer wall's seam before the layer below is.
struct SeamChoices {
  std::uint32_t block = 0, bead = 0;  ///< indices into the layer's blocks and the beads of the block's object
  std::vector<Corner> corners;        ///< best first, a few
};

/// The corners of a closed bead that attract a seam, best first, at most `most`. The turn of a corner is measured over
/// half a millimetre to each side, so that a finely sampled curve has no corner. Cost: O(n).
/// @param material_left the part lies on the left of the bead's direction
std::vector<Corner> corners_of(const Bead& bead, SeamCorner kind, bool material_left, std::size_t most);

/// The point of a closed bead nearest to p; within `snap` of a junction it is the junction. Cost: O(n).
Start nearest_start(const Bead& bead, Point p, Um snap);

/// How much of the horizon a corner is seen from, by rays against the outlines of the layer.
/// Pre: `material_left` as for corners_of.
void add_exposure(const Bead& bead, bool material_left, const Comb& outline, std::span<Corner> corners);

/// The place of a closed bead that is farthest back. Cost: O(n).
Start rearmost_start(const Bead& bead);

/// Anywhere on a closed bead, each place as likely as any. Cost: O(n).
Start random_start(const Bead& bead, std::uint64_t seed);

/// With more of the half of its width that stands out over air a wall's beginning is dragged along: at least a quarter
/// of the width lies on something.
constexpr double most_hang = 0.5;

/// How much of the half of a closed bead's width that stands out lies on nothing where it begins, 0 … 1: 0 where its
/// middle lies on something. Cost: two questions to `below`.
/// @param below  what the wall can lie on
double hang_of(const Bead& bead, const Start& start, const Comb& below);

/// Where a closed bead may begin with no more than `most_hang` over air, at its junctions and every half millimetre;
/// empty: nowhere. Cost: two questions to `below` for each.
std::vector<Start> borne_places(const Bead& bead, const Comb& below);

}  // namespace weft::travel
