// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/bridges.h"

#include "core/stop.h"
#include "infill/scan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::infill {
namespace {

using namespace weft::literals;

/// How the strands of one direction hang.
struct Hanging {
  double angle_rad = 0;
  double resting_share = 0;  ///< of their length, that of strands with a support at both ends
  double long_span_um = 0;   ///< mean of those, weighted by length cubed: short strands across corners must not count
};

Hanging hanging(const Region& gap, const Mask& below, double angle_rad) {
  constexpr double spacing = 400;                 // about a strand
  const double beyond = 2.5 * below.grid().cell;  // how far past its end a strand must find support: the grid's doubt
  const Frame frame(angle_rad, gap.outer.front());
  const Outline outline(gap, frame);
  const double height = outline.greatest_y() - outline.least_y();
  const int count = std::clamp(static_cast<int>(height / spacing), 4, 200);
  const LineSet lines{outline.least_y() + height / count / 2, height / count, count};
  double all = 0, resting = 0, cubes = 0, fourths = 0;
  for (const Interval& i : outline.cut(lines)) {
    const double y = lines.y(i.line), length = i.to - i.from;
    all += length;
    if (!below.at(frame.back({i.from - beyond, y})) || !below.at(frame.back({i.to + beyond, y}))) continue;
    resting += length, cubes += std::pow(length, 3), fourths += std::pow(length, 4);
  }
  return {angle_rad, all > 0 ? resting / all : 0, resting > 0 ? fourths / cubes : 0};
}

}  // namespace

std::optional<double> bridge_angle_rad(const Region& gap, const Mask& below) {
  constexpr int directions = 36;
  constexpr double least_share = 0.5;   // below it most strands would end in air
  constexpr double nearly_best = 0.05;  // directions that rest as well as the best are told apart by their spans
  std::vector<Hanging> found;
  double best_share = 0;
  for (int d = 0; d < directions; ++d) {
    stop_if_asked();
    found.push_back(hanging(gap, below, d * std::numbers::pi / directions));
    best_share = std::max(best_share, found.back().resting_share);
  }
  if (best_share < least_share) return std::nullopt;
  const Hanging* best = nullptr;
  for (const Hanging& h : found)
    if (h.resting_share >= best_share - nearly_best && (best == nullptr || h.long_span_um < best->long_span_um))
      best = &h;
  return best->angle_rad;
}

}  // namespace weft::infill
