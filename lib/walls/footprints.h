// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/bead.h"
#include "walls/room.h"

#include <vector>

/// Private to walls: the last look at what is laid.
namespace weft::walls {

/// What is printed of a piece between two junctions is a rectangle of their mean width. Where one of an outermost bead
/// reaches over the outline by more than walls may, at bends, at mouths of thin arms, at pointed ends, the bead gives
/// way: a loop moves inwards, a single bead gets narrower.
class Footprints {
 public:
  /// `nominal`: the width of outer walls, µm. Pieces of a loop that have it lie beside the outline they follow and are
  /// not looked at. `narrowest`: a bead is not planned narrower, µm, but laid with less flow. `origin` is that of
  /// `room`. Pre: `beads` are all of the part.
  Footprints(Room& room, Point origin, Um nominal, Um narrowest, const Beads& beads);

  /// Makes beads give way; whether any had to. All stay if less than `least` mm² would be covered then: volume comes
  /// first. Pre: these are the beads it was made of; their widths may have changed by no more than `most_change`.
  bool keep(double least, Beads& beads) const;

  static constexpr double most_change = 0.015;  ///< of a width

 private:
  /// A bead with pieces that reach that far, or nearly.
  struct Suspect {
    std::size_t bead = 0;
    std::vector<std::size_t> pieces;  ///< by their first junction, ascending
  };
  Bead kept(const Suspect& suspect, double outside, const Bead& bead) const;

  Room& room_;
  Point origin_;
  Um narrowest_;
  std::vector<Suspect> suspects_;
};

}  // namespace weft::walls
