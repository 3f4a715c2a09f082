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
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const Point a = ring[j], b = ring[i];
    const bool in_box = p.x >= std::min(a.x, b.x) && p.x <= std::max(a.x, b.x) && p.y >= std::min(a.y, b.y) &&
                        p.y <= std::max(a.y, b.y);
    if (in_box && orient(a, b, p) == 0) return Side::on;
    if ((a.y > p.y) != (b.y > p.y) && (orient(a, b, p) > 0) == (b.y > a.y)) inside = !inside;
  }
  return inside ? Side::inside : Side::outside;
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
