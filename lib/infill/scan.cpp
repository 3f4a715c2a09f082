// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/scan.h"

#include "core/stop.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace weft::infill {

Frame::Frame(double angle_rad, Point origin) : origin_(origin), cos_(std::cos(angle_rad)), sin_(std::sin(angle_rad)) {
  // multiples of 90° exactly, so that lines along an axis stay on it
  const double quarters = angle_rad / (std::numbers::pi / 2);
  const double whole = std::round(quarters);
  if (std::abs(quarters - whole) > 1e-9) return;
  constexpr double cosines[4] = {1, 0, -1, 0};
  const auto i = static_cast<std::size_t>(((static_cast<long>(whole) % 4) + 4) % 4);
  cos_ = cosines[i], sin_ = cosines[(i + 3) % 4];
}

Outline::Outline(const Region& region, const Frame& frame) {
  add(region.outer, frame);
  for (const Ring& hole : region.holes) add(hole, frame);
}

Outline::Outline(const Regions& regions, const Frame& frame) {
  for (const Region& region : regions) {
    add(region.outer, frame);
    for (const Ring& hole : region.holes) add(hole, frame);
  }
}

void Outline::add(const Ring& ring, const Frame& frame) {
  if (ring.size() < 3) return;
  for (const Point p : ring) {
    const Turned t = frame.into(p);
    least_y_ = std::min(least_y_, t.y), greatest_y_ = std::max(greatest_y_, t.y);
    points_.push_back(t);
    ring_.push_back(static_cast<std::uint32_t>(ends_.size()));
  }
  ends_.push_back(static_cast<std::uint32_t>(points_.size()));
}

std::vector<Interval> Outline::cut(const LineSet& lines) const {
  struct Crossing {
    double x;
    std::uint32_t edge;
  };
  std::vector<Interval> intervals;
  if (points_.empty() || lines.count <= 0) return intervals;
  // lines with a.y <= y < b.y cross an edge: shared ends count once, edges along a line not at all
  const auto lines_of = [&](std::uint32_t i) {
    double low = points_[i].y, high = points_[next(i)].y;
    if (low > high) std::swap(low, high);
    const double first = std::ceil((low - lines.first) / lines.spacing),
                 last = std::ceil((high - lines.first) / lines.spacing) - 1;
    return std::pair{static_cast<int>(std::max(first, 0.0)), static_cast<int>(std::min(last, lines.count - 1.0))};
  };
  std::vector<std::uint32_t> start(static_cast<std::size_t>(lines.count) + 1, 0);
  const auto n = static_cast<std::uint32_t>(points_.size());
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto [first, last] = lines_of(i);
    for (int k = first; k <= last; ++k) ++start[static_cast<std::size_t>(k) + 1];
  }
  for (std::size_t k = 1; k < start.size(); ++k) start[k] += start[k - 1];
  std::vector<Crossing> crossings(start.back());
  std::vector<std::uint32_t> fill(start.begin(), start.end() - 1);
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto [first, last] = lines_of(i);
    if (first > last) continue;
    const Turned a = points_[i], b = points_[next(i)];
    const double slope = (b.x - a.x) / (b.y - a.y);
    for (int k = first; k <= last; ++k)
      crossings[fill[static_cast<std::size_t>(k)]++] = {a.x + slope * (lines.y(k) - a.y), i};
  }
  intervals.reserve(crossings.size() / 2);
  StopNowAndThen stop(16);
  for (int k = 0; k < lines.count; ++k) {
    stop.step();
    const auto from = crossings.begin() + start[static_cast<std::size_t>(k)];
    const auto to = crossings.begin() + start[static_cast<std::size_t>(k) + 1];
    std::sort(from, to, [](const Crossing& p, const Crossing& q) { return p.x != q.x ? p.x < q.x : p.edge < q.edge; });
    for (auto c = from; to - c >= 2; c += 2) intervals.push_back({k, c[0].x, c[1].x, c[0].edge, c[1].edge});
  }
  return intervals;
}

void Outline::loosen(const geometry::SegmentIndex& edges, const Frame& frame) {
  constexpr double on_it_um = 3;  // areas that were cut apart share their border to the lattice
  std::vector<bool> loose(points_.size());
  bool any = false;
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    const Turned a = points_[i], b = points_[next(i)];
    loose[i] = edges.nearest(frame.back({std::midpoint(a.x, b.x), std::midpoint(a.y, b.y)}), on_it_um).has_value();
    any = any || loose[i];
  }
  if (any) loose_ = std::move(loose);
}

}  // namespace weft::infill
