// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/ring_chains.h"

#include <cstddef>
#include <optional>
#include <span>

/// Outlines that touch, made to cross or to lie apart; private to geometry/.
namespace weft::geometry {

/// Two sets of rings, the second of which is moved aside, each of its edges by the same hair: out of what it encloses,
/// or into it. The hair is less than any distance between what does not touch, so that it decides only what lies on an
/// edge or a corner. Nothing is really moved: signs are told as they would be.
/// Pre: within a set no two rings touch, and none touches itself; interiors lie to the left of edges.
/// Source: Edelsbrunner & Mücke 1990, "Simulation of simplicity".
class Aside {
 public:
  /// @param rings  those of the first set, then, from `first_moved` on, those of the second
  Aside(std::span<const Ring> rings, const RingChains& chains, std::size_t first_moved, bool outwards)
      : rings_(rings), chains_(chains), first_moved_(first_moved), outwards_(outwards) {}

  struct Crossing {
    Point at;
    double along_still = 0, along_moved = 0;  ///< 0 … 1
    /// Where along both edges, µm from there, for each micron that is moved: what tells the order of crossings that
    /// else are at one place.
    double then_still = 0, then_moved = 0;
    bool enters = false;  ///< the edge that stays goes from the right of the other to its left
  };
  enum class Found { apart, crossing, unsure };
  /// Whether an edge that stays and a moved one cross. Pre: they have a point in common.
  Found find(std::uint32_t still, std::uint32_t moved, Crossing& out) const;

  /// Whether the `nth` corner of a ring lies to the left of a ring of the other set that has it on an edge; nothing
  /// where both directions are the same. Pre: they do not cross.
  std::optional<bool> left_of(std::uint32_t ring, std::size_t nth, std::uint32_t other) const;

 private:
  struct Vector {
    double x = 0, y = 0;
  };
  static Vector unit(Point from, Point to);
  static int side_of(Vector way, Vector moved);
  Vector way_of_corner(std::uint32_t ring, std::size_t nth) const;
  int side_of_moved_end(const Segment& still, std::uint32_t moved, bool its_end) const;
  int side_of_still_point(const Segment& moved, Point p) const;

  std::span<const Ring> rings_;
  const RingChains& chains_;
  std::size_t first_moved_;
  bool outwards_;
};

}  // namespace weft::geometry
