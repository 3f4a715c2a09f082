// SPDX-License-Identifier: GPL-3.0-or-later
#include "overhangs/air.h"

#include <algorithm>

namespace weft::overhangs {

bool Air::edge_near(Point a, Point b, Um reach) const {
  return index_.any_near(geometry::Segment{a, b}.box().grown(reach));
}

bool Air::at(Point p) {
  if (!last_) {
    last_in_air_ = index_.winding(p).value_or(0) > 0;
  } else {
    index_.crossings(*last_, p, crossings_);
    if (!crossings_.empty()) last_in_air_ = crossings_.back().enters;
  }
  last_ = p;
  return last_in_air_;
}

double Air::share(Point p, Point side) {
  const Point from = p - side;
  index_.crossings(from, p + side, crossings_);
  if (crossings_.empty()) return at(p) ? 1 : 0;
  bool in_air = !crossings_.front().enters;
  last_ = from, last_in_air_ = in_air;
  double sum = 0, begin = 0;
  for (const auto& crossing : crossings_) {
    if (in_air) sum += crossing.along - begin;
    in_air = crossing.enters, begin = crossing.along;
  }
  return in_air ? sum + 1 - begin : sum;
}

double Air::longest_um(Point a, Point b) {
  const double length = distance(a, b);
  index_.crossings(a, b, crossings_);
  if (crossings_.empty()) return at(lerp(a, b, 0.5)) ? length : 0;
  bool in_air = !crossings_.front().enters;
  double longest = 0, begin = 0;
  for (const auto& crossing : crossings_) {
    if (in_air) longest = std::max(longest, crossing.along - begin);
    in_air = crossing.enters, begin = crossing.along;
  }
  if (in_air) longest = std::max(longest, 1 - begin);
  last_.reset();
  return longest * length;
}

}  // namespace weft::overhangs
