// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/polygon.h"

namespace weft {

Box box_of(std::span<const Point> points) {
  Box box;
  for (const Point p : points) box.add(p);
  return box;
}

Box box_of(const Regions& regions) {
  Box box;
  for (const auto& region : regions) box.add(box_of(region.outer));
  return box;
}

std::int64_t double_area(const Ring& ring) {
  std::int64_t sum = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) sum += orient(ring[0], ring[i], ring[i + 1]);
  return sum;
}

double area_mm2(const Region& region) {
  std::int64_t sum = double_area(region.outer);
  for (const auto& hole : region.holes) sum += double_area(hole);
  return static_cast<double>(sum) / 2e6;
}

double area_mm2(const Regions& regions) {
  double sum = 0;
  for (const auto& region : regions) sum += area_mm2(region);
  return sum;
}

double length_of(const Polyline& line) {
  double sum = 0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += distance(line[i - 1], line[i]);
  return sum;
}

double perimeter_of(const Ring& ring) {
  return ring.empty() ? 0.0 : length_of(ring) + distance(ring.back(), ring.front());
}

Side side_of(const Ring& ring, Point p) {
  bool inside = false;
  if (ring.empty()) return Side::outside;
  Point a = ring.back();
  bool a_above = a.y > p.y;
  for (const Point b : ring) {
    const bool b_above = b.y > p.y;
    if (a_above != b_above) {
      const std::int64_t turn = orient(a, b, p);
      if (turn == 0) return Side::on;
      inside = inside != ((turn > 0) == b_above);
    } else if (b.y == p.y && (b.x == p.x || (a.y == p.y && (a.x < p.x) != (b.x < p.x)))) {
      return Side::on;
    }
    a = b, a_above = b_above;
  }
  return inside ? Side::inside : Side::outside;
}

Side side_of(const Region& region, Point p) {
  Side out = side_of(region.outer, p);
  for (auto hole = region.holes.begin(); hole != region.holes.end() && out == Side::inside; ++hole)
    if (const Side of_hole = side_of(*hole, p); of_hole != Side::outside)
      out = of_hole == Side::on ? Side::on : Side::outside;
  return out;
}

Regions moved(Regions regions, Point by) {
  for (auto& region : regions) {
    for (auto& p : region.outer) p = p + by;
    for (auto& hole : region.holes)
      for (auto& p : hole) p = p + by;
  }
  return regions;
}

}  // namespace weft
