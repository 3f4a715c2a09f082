// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "infill/scan.h"
#include "infill/shared_misfit.h"

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace weft::infill {

/// How far a line reaches sideways at a place along it.
struct Sides {
  double x = 0;
  double below = 0, above = 0;  ///< from the line; fractional microns
};

/// How far lines go along with edges beside them. Lengths are in bands.
struct FitWidths {
  double least = 0, most = 1e9;  ///< width of a line
  double steady_from = 0;        ///< along a line; briefer swings of an edge beside it are not followed
  int shared_by = 1;             ///< lines that share what a nearly straight edge asks of one
};

/// Where edges run along the lines of a fill, closer than a neighbour would lie, a line ends at the edge: it covers
/// what is between them, less or more than its own half. So a fill neither lies in a wall along it nor leaves a gap
/// there, although its lines stand on one grid. Edges across the lines are none of this: there lines end or turn. Nor
/// are loose ones.
class SideFit {
 public:
  /// Pre: the intervals are the outline's on these lines, as `Outline::cut` gives them; outer rings run
  ///      counter-clockwise, holes clockwise.
  /// @param band of a line, in the outline's unit: edges farther from its middle do not concern it
  /// @param widths of what lines cover: what is beyond, they lack or have too much on both sides alike
  /// Cost: O(n log n) in the edges and intervals.
  SideFit(const Outline& outline, const LineSet& lines, std::span<const Interval> intervals, double band,
          const FitWidths& widths = {});

  /// Whether lines run along the edge, rather than end at it.
  static bool along(Turned a, Turned b);

  /// Whether no edge concerns an interval: it covers half a band on both sides of it.
  bool is_plain(std::uint32_t interval) const { return !beside_[interval]; }

  /// Whether an interval is moved, or wider or narrower, for the sake of others.
  bool shares(std::uint32_t interval) const { return shared_.concerns(interval); }

  /// How far a line is moved up where it shares what an edge asks of another.
  double aside(std::uint32_t interval, double x) const {
    return (shared_.at(interval, true, x) - shared_.at(interval, false, x)) / 2;
  }

  /// Corners of what an interval covers, from its left end to its right one, straight between them; two corners or
  /// more.
  std::vector<Sides> of(std::uint32_t interval) const;

  /// From where to where along an interval there is room for half of the narrowest line at least: less is nearer to
  /// nothing than to a line. What is narrower between those places is not looked for; nothing where all is.
  std::optional<std::pair<double, double>> with_room(std::uint32_t interval) const;

 private:
  /// A stretch of an interval with an edge beside it.
  struct Beside {
    std::uint32_t interval = 0;
    double from = 0, to = 0;        // x
    double at_from = 0, at_to = 0;  // distances to the edge
  };
  using Besides = std::vector<Beside>;

  /// A side's reach at places along an interval, straight between them.
  struct Corner {
    double x = 0, reach = 0;
  };
  static double reach_at(const Corner& a, const Corner& b, double x);
  std::vector<Corner> side(bool above, std::uint32_t interval) const;
  std::vector<SharedMisfit::Edge> straight(const Besides& all) const;
  SharedMisfit::Edge fitted(std::span<const Beside> run) const;
  std::vector<Sides> both(std::uint32_t interval) const;
  void keep_within_widths(std::uint32_t interval, std::vector<Sides>& all) const;

  double band_;
  FitWidths widths_;
  std::span<const Interval> intervals_;
  std::vector<bool> beside_;  // by interval
  Besides above_, below_;     // by interval, then from left to right
  SharedMisfit shared_;
};

}  // namespace weft::infill
