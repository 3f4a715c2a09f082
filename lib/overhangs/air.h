// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/spatial_index.h"

#include <optional>
#include <vector>

namespace weft::overhangs {

/// Where nothing lies below, and how much of a bead's width that is.
class Air {
 public:
  explicit Air(const Regions& regions) : index_(regions) {}

  /// Whether any of it may be that near to the box.
  bool near(const Box& box, Um reach) {
    const Box wide{{box.min.x - reach, box.min.y - reach}, {box.max.x + reach, box.max.y + reach}};
    return wide.overlaps(index_.box());
  }
  /// Whether its edge may come that near to the way from a to b: where it does not, all of a bead's width is in the
  /// air, or none.
  bool edge_near(Point a, Point b, Um reach) const;

  /// Is there nothing below p? Asked along a path it costs what lies between one place and the next.
  bool at(Point p);

  /// The share of the line from p − side to p + side that lies in the air.
  double share(Point p, Point side);

  /// The longest piece of the line from a to b that lies in the air, µm.
  double longest_um(Point a, Point b);

 private:
  geometry::SegmentIndex index_;
  std::optional<Point> last_;  // that was asked about
  bool last_in_air_ = false;
  std::vector<geometry::SegmentIndex::Crossing> crossings_;
};

}  // namespace weft::overhangs
