// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "geometry/spatial_index.h"
#include "model/bead.h"
#include "pipeline/layer_plastic.h"

#include <optional>
#include <span>
#include <vector>

namespace weft::pipeline {

struct RungStyle {
  Um span = 0;            ///< the longest way that a bead may cross freely
  Um out = 0;             ///< the longest way from a bead to the end of a bracket
  Um line = 0, band = 0;  ///< widths of a bead
  Um step = 0;            ///< how far a bead may reach beyond the one below, as steep as beads hold themselves
  Um stub = 0;            ///< the longest bracket that lies on nothing but its root
};

/// What a layer lays for beads above that would hang: rungs from one of its beads to another, and brackets out from one
/// where there is no other, as at the edge of a column. Places are asked for from the top down, since brackets grow out
/// of what is below by and by; rungs then from the bottom up, since they lie on each other.
class RungsBelow {
 public:
  /// @param beads  what is laid already: rungs and brackets end on it
  /// @param area   of support: none leaves it
  /// @param below  what this layer lies on
  RungsBelow(const Beads& beads, const Regions& area, LayerPlastic below, const RungStyle& style);

  /// @param hang  places where beads above hang
  /// @param ends  where brackets of the layer above do
  /// @return where brackets that this laid hang in turn
  std::vector<Point> brackets(std::span<const Point> hang, std::span<const Point> ends);
  /// Lays brackets that grew out of something, bars between them, and rungs: those on a rung of the layer below, or
  /// where their ends lie on something, if there is such a place, as near to each other as beads may cross freely.
  /// @param hang   the places that `brackets` was given
  /// @param under  what this function returned for the layers that this one lies on
  /// @return all of them. Post: their sequence is not 0: they are printed when what they end on is there.
  Beads rungs(std::span<const Point> hang, const Beads& under) &&;

 private:
  struct Bracket {
    geometry::Segment way;
    bool top;  ///< nothing but what it is for is above it
  };
  /// What is no further from a rung is held by it.
  double held() const { return style_.span * 0.4; }
  /// Whether p lies no further beside a rung or bracket than that. What lies past its end or behind a bead does not: no
  /// strand there comes across it.
  bool is_near(Point p, double by) const;
  std::optional<geometry::Segment> on_one_below(Point p, const Beads& under);
  std::optional<geometry::Segment> best_through(Point p);
  std::optional<geometry::Segment> across(Point p, double direction_rad);
  std::optional<Point> next(Point from, Point way);
  std::vector<Point> furthest_first(std::span<const Point> places) const;
  std::optional<Point> into(Point p) const;
  std::optional<geometry::Segment> out_to(Point p) const;
  bool holds_itself(const geometry::Segment& way) const;
  void bars();
  void lay(const geometry::Segment& way);

  geometry::SegmentIndex laid_, inside_;
  LayerPlastic below_;
  RungStyle style_;
  std::vector<geometry::SegmentIndex::Crossing> found_;
  std::vector<Bracket> brackets_;
  Beads out_;
};

}  // namespace weft::pipeline
