// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "infill/scan.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace weft::infill {

/// A place along a line, and how much more room there is than half a line takes. In the unit of the lines, µm.
struct Knot {
  double x = 0, more = 0;
};

/// Where lines stand on one grid and an edge runs along them, the line beside it has more or less room than the others.
/// It is not left to be much narrower or wider alone: some lines share that, and move aside by what the ones before
/// them took. A strand half as wide lies poorly, and an extruder takes millimetres to change by that much.
class SharedMisfit {
 public:
  /// A nearly straight edge along an interval, or a piece of it.
  struct Edge {
    std::uint32_t interval = 0;
    Knot from, to;
  };

  SharedMisfit() = default;
  /// Shares what edges below lines and above them ask for.
  /// @param intervals on the lines of a fill, by line and then from left to right; they must outlive this
  /// @param below,above edges by interval and then from left to right
  /// @param ramp      µm in which lines come back beyond the ends of such an edge
  /// @param lines     that share at most
  SharedMisfit(std::span<const Interval> intervals, std::span<const Edge> below, std::span<const Edge> above,
               double ramp, int lines);

  /// Whether an interval has its part of something.
  bool concerns(std::uint32_t interval) const {
    return !of_[0].empty() && !(of(interval, false).empty() && of(interval, true).empty());
  }

  /// How much farther than half a line one side of an interval reaches: at two places, and at those strictly between
  /// them where that bends.
  std::vector<Knot> along(std::uint32_t interval, bool above, double from, double to) const;
  double at(std::uint32_t interval, bool above, double x) const;

 private:
  /// A side of an interval is moved by a share of a profile.
  struct Moved {
    std::uint32_t interval = 0, profile = 0;
    double share = 0;
  };
  using Profile = std::vector<Knot>;

  void share(std::span<const Edge> edges, bool above);
  std::span<const Moved> of(std::uint32_t interval, bool above) const;
  std::vector<std::uint32_t> sharers(std::uint32_t interval, double from, double to, bool above) const;
  std::pair<std::uint32_t, std::uint32_t> on_line(int line) const;

  std::span<const Interval> intervals_;
  double ramp_ = 0;
  int lines_ = 1;
  std::vector<Profile> profiles_;
  std::vector<Moved> of_[2];  // sides below and above, by interval
};

}  // namespace weft::infill
