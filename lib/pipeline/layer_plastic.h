// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/spatial_index.h"
#include "model/bead.h"

namespace weft::pipeline {

/// Every segment of beads.
geometry::SegmentIndex segments_of(const Beads& beads);

/// What of beads has nothing below.
struct Hanging {
  double um = 0;          ///< how much of them
  std::vector<Point> at;  ///< places no further from each other than a span, of a small loop its middle
};

/// The plastic of a layer, for beads of support that come to lie on it or, asked the same way, that it comes to lie on:
/// areas without gaps, and beads with gaps between them.
class LayerPlastic {
 public:
  LayerPlastic() = default;
  /// @param line  width of a bead
  LayerPlastic(const Regions& areas, const Beads& beads, Um line);

  bool empty() const { return areas_.segments().empty() && beads_.segments().empty(); }

  /// What of beads has nothing below: no quarter of their width lies on anything. What crosses from one rest to another
  /// within a span does not count: a bead that is held at both ends sags little.
  Hanging hanging(std::span<const Bead> beads, Um span) const { return hanging(beads, span, span / 4); }
  /// @param least  what of a bead that hangs is no longer holds itself; places are of longer ones
  Hanging hanging(std::span<const Bead> beads, Um span, Um least) const;
  /// Whether a bead's middle there has a quarter of its width on something.
  bool lies(Point p) const;
  /// Of places along a path whether a bead there only leans on the side of one of these: less than a quarter of its
  /// width lies on it, and it is no further off than the two are wide, by no more than a tenth.
  /// @return 1 for each place where it does, else 0
  std::vector<char> leaning(std::span<const Point> places) const;

 private:
  double on_bead() const { return line_ * 3 / 4; }  ///< so near to a bead's middle a quarter of another lies on it
  double on_area() const { return line_ / 4; }      ///< … so far beside an area
  std::vector<Polyline> hanging(const Bead& bead, Um span) const;
  /// What `lies` tells of places along a path.
  std::vector<char> lying(std::span<const Point> places) const;

  geometry::SegmentIndex areas_, beads_;
  double line_ = 0;
};

}  // namespace weft::pipeline
