// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/bead.h"
#include "settings/groups/tools.h"

#include <functional>
#include <vector>

/// Stripes of two tools across an axis, as wide as their shares.
namespace weft::pipeline {

/// The junction at that share of the way between two.
Junction between(const Junction& a, const Junction& b, double share);

/// Where the second tool's stripes begin and end. In each period it has what its share is in the middle of that; what
/// is narrower than a bead is carried on to the next period, and so is what the first tool would be left less of.
class Stripes {
 public:
  /// @param least_mm width of a stripe @param from, to mm, what is to be covered
  Stripes(const ValuesAt& stops, double period_mm, double least_mm, double from, double to);

  /// Which tool prints there?
  bool second(double mm) const;
  /// Cuts a bead where it crosses a border. @param place of a junction along the axis, mm
  Beads cut(Bead bead, const std::function<double(Point)>& place) const;

 private:
  std::vector<double> borders_;  ///< ascending; behind an odd number of them the second tool prints
};

}  // namespace weft::pipeline
