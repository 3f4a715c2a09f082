// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/room.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace weft::walls {
namespace {
constexpr double end_um = 4;
constexpr std::size_t few = 16;  // segments, which are looked at sooner than looked for
}  // namespace

const geometry::SegmentIndex& Room::index() {
  if (index_) return *index_;
  index_.emplace(Regions{region_});
  if (index_->segments().size() <= few) {
    near_.resize(index_->segments().size());
    std::iota(near_.begin(), near_.end(), 0U);
  }
  return *index_;
}

Place Room::on_piece(Point p, Place a, Place way) const {
  const double x = static_cast<double>(p.x - origin_.x) - a.x, y = static_cast<double>(p.y - origin_.y) - a.y;
  return {x * way.x + y * way.y, y * way.x - x * way.y};
}

double Room::beside(Place a, Place b, double most, bool first, bool last) {
  stop_.step();
  const Place way = unit(a, b), middle = lerp(a, b, 0.5);
  const double length = distance(a, b), reach = std::sqrt(most * most + length * length / 4) + 2;
  const auto lattice = [&](double x, double y) { return Point{origin_.x + rounded(x), origin_.y + rounded(y)}; };
  const auto& segments = index().segments();
  if (segments.size() > few)
    index_->near({lattice(middle.x - reach, middle.y - reach), lattice(middle.x + reach, middle.y + reach)}, near_);
  const double end = std::min(end_um, length / 4), from = first ? end : 0, to = last ? length - end : length;
  double room = most;
  for (const std::uint32_t i : near_) {
    const auto& s = segments[i];
    Place p = on_piece(s.a, a, way), q = on_piece(s.b, a, way);
    if (p.x > q.x) std::swap(p, q);
    if (q.x <= from || p.x >= to) continue;
    const auto at = [&](double x) { return p.y + (x - p.x) / (q.x - p.x) * (q.y - p.y); };
    const double y = p.x < from ? at(from) : p.y, z = q.x > to ? at(to) : q.y;
    const bool crosses = (y < 0) != (z < 0);
    room = std::min(room, crosses ? 0 : std::min(std::abs(y), std::abs(z)));
  }
  return room;
}

}  // namespace weft::walls
