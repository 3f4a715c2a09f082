// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/notice.h"
#include "model/bead.h"
#include "model/plan.h"
#include "travel/travel.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// Beads of two owners that lie in each other: copies of objects, their supports, skirt, brim, tower. Every pair is
/// looked at, and the answer does not depend on threads.
namespace weft::pipeline {

/// A piece of a bead: a disc whose diameter varies linearly, swept along a segment.
struct Stroke {
  Point a, b;
  Um width_a = 0, width_b = 0;
};

/// How deep two strokes lie in each other, fractional microns, and where; nothing: they do not by more than `least`.
/// The depth is how far the discs would have to be apart. Cost: O(1); of varying widths a search.
struct Depth {
  double um = 0;
  Point at;
};
std::optional<Depth> depth_of(const Stroke& a, const Stroke& b, double least);

/// Who lays beads: a copy of an object, its support, or what belongs to none.
struct Owner {
  enum class Kind : std::uint8_t { object, support, adhesion };
  Kind kind = Kind::object;
  std::uint32_t number = 0;  ///< of the copy; of adhesion its role
  auto operator<=>(const Owner&) const = default;
};

/// Two owners, over all layers.
struct Conflict {
  Owner a, b;               ///< a < b
  Role role_a, role_b;      ///< where it is deepest, on the lowest layer with any
  Um z = 0;                 ///< of that layer
  std::uint32_t layer = 0;  ///< its number on the way up
  Point at;
  double depth_um = 0;
  std::size_t layers = 0;  ///< on how many
};

/// All pairs of owners, by the lowest layer where they meet. An object and its own support are one matter and not
/// compared. Cost: of owners whose boxes are apart, one pass over the beads.
std::vector<Conflict> conflicts_in(std::span<const travel::LayerInput> layers, Um tolerance);

/// "'body' and 'lid' overlap at layer 12, z 2.4, (112.500, 100.200), 0.42 mm deep (outer_wall, skirt)".
std::string describe(const Conflict& conflict, const std::vector<ObjectLabel>& objects);

/// What is harmless is told: supports that meet, or lie in skirt or brim, and a brim in its part. Everything else ends
/// the job, unless it is to be annotated. @throws Error{audit} for the first, when all are told
void check_conflicts(std::span<const travel::LayerInput> layers, const std::vector<ObjectLabel>& objects, Um tolerance,
                     bool annotate, Notices& notices);

}  // namespace weft::pipeline
