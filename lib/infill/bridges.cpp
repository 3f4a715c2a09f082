// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/bridges.h"

#include "core/stop.h"
#include "geometry/offset.h"
#include "infill/scan.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace weft::infill {
namespace {

using namespace weft::literals;

/// How the strands of one direction hang: those with a support at both ends, or at one at least.
struct Strands {
  double share = 0;         ///< of the length of all
  double long_span_um = 0;  ///< mean, weighted by length cubed: short strands across corners must not count
};
struct Hung {
  double angle_rad = 0;
  Strands resting, held;
};

Hung hung(const Regions& gaps, const Mask& below, double angle_rad) {
  constexpr double spacing = 400;                 // about a strand
  const double beyond = 2.5 * below.grid().cell;  // how far past its end a strand must find support: the grid's doubt
  const Frame frame(angle_rad, gaps.front().outer.front());
  const Outline outline(gaps, frame);
  const double height = outline.greatest_y() - outline.least_y();
  const int count = std::clamp(static_cast<int>(height / spacing), 4, 200);
  const LineSet lines{outline.least_y() + height / count / 2, height / count, count};
  struct Sums {
    double length = 0, cubes = 0, fourths = 0;
    void add(double l) { length += l, cubes += std::pow(l, 3), fourths += std::pow(l, 4); }
    Strands of(double all) const { return {all > 0 ? length / all : 0, length > 0 ? fourths / cubes : 0}; }
  } resting, held;
  double all = 0;
  for (const Interval& i : outline.cut(lines)) {
    const double y = lines.y(i.line), length = i.to - i.from;
    const bool here = below.at(frame.back({i.from - beyond, y})), there = below.at(frame.back({i.to + beyond, y}));
    all += length;
    if (here && there) resting.add(length);
    if (here || there) held.add(length);
  }
  return {angle_rad, resting.of(all), held.of(all)};
}

/// Places along a line of a frame where beads cross it.
struct Crossing {
  int line = 0;
  double x = 0;
};

std::vector<Crossing> crossings(const Beads& beads, const Frame& frame, const LineSet& lines) {
  std::vector<Crossing> out;
  for (const Bead& bead : beads)
    for (std::size_t i = 1; i < bead.path.size() + (bead.closed ? 1 : 0); ++i) {
      Turned a = frame.into(bead.path[i - 1].at), b = frame.into(bead.path[i % bead.path.size()].at);
      if (a.y > b.y) std::swap(a, b);
      const int first = std::max(0, static_cast<int>(std::ceil((a.y - lines.first) / lines.spacing)));
      const int last = std::min(lines.count - 1, static_cast<int>(std::floor((b.y - lines.first) / lines.spacing)));
      for (int k = first; k <= last && a.y < b.y; ++k)
        out.push_back({k, a.x + (lines.y(k) - a.y) / (b.y - a.y) * (b.x - a.x)});
    }
  std::sort(out.begin(), out.end(),
            [](const Crossing& a, const Crossing& b) { return a.line != b.line ? a.line < b.line : a.x < b.x; });
  return out;
}

/// Whether a strand that ends there, or runs on out of what hangs, ends over nothing.
bool ends_in_air(Turned end, double along, const Frame& frame, const OverSparse& around) {
  constexpr int most_cells = 30;  // until it leaves what hangs: else it runs along the edge
  const double cell = around.open.grid().cell;
  for (int k = 0; k < most_cells; ++k, end.x += along * cell)
    if (!around.hanging.at(frame.back(end))) return around.open.at(frame.back({end.x + along * cell, end.y}));
  return false;
}

/// The mean free way of strands in that direction, µm, weighted by its length cubed: sag grows with the third power of
/// a span and more, so the long ones decide.
double mean_span_um(const Regions& areas, const OverSparse& around, const Beads& held_by, double angle_rad) {
  constexpr double spacing = 400;  // about a strand
  constexpr double stands_out =
      2.6;  // a beam held at one end sags as one so much longer that is held at both: (384/8)^¼
  const Frame frame(angle_rad, areas.front().outer.front());
  const Outline outline(areas, frame);
  const double height = outline.greatest_y() - outline.least_y();
  const int count = std::clamp(static_cast<int>(height / spacing), 4, 200);
  const LineSet lines{outline.least_y() + height / count / 2, height / count, count};
  const auto met = crossings(held_by, frame, lines);
  double cubes = 0, fourths = 0;
  const auto span = [&](double length) { cubes += std::pow(length, 3), fourths += std::pow(length, 4); };
  auto at = met.begin();
  int line = -1;
  for (const Interval& i : outline.cut(lines)) {
    if (i.line != line)
      line = i.line, at = std::find_if(at, met.end(), [&](const Crossing& c) { return c.line >= line; });
    const double y = lines.y(line);
    double from = i.from, first = ends_in_air({i.from, y}, -1, frame, around) ? stands_out : 1;
    for (; at != met.end() && at->line == line && at->x < i.to; ++at)
      if (at->x > from) span(std::exchange(first, 1) * (at->x - from)), from = at->x;
    span(first * (i.to - from) * (ends_in_air({i.to, y}, 1, frame, around) ? stands_out : 1));
  }
  return cubes > 0 ? fourths / cubes : 0;
}

}  // namespace

std::optional<double> internal_bridge_angle_rad(const Region& area, const OverSparse& around, const SparseStyle& below,
                                                Um nozzle) {
  constexpr int directions = 18;
  constexpr double short_way = 3;   // strands: lines that hang no further in any direction do not sag
  constexpr double clearly = 0.95;  // of a span: directions that are as good as the infill's own give way to it
  Beads infill;
  SparseStyle lines = below;
  lines.connect = false;  // its lines turn along the edge of the sparse area, not of this one
  fill_sparse(area, lines, infill);
  // A strand beside the edge, where no line of the infill ends yet, lies on what holds the edge.
  Regions inner = geometry::offset({area}, {.by = -2 * nozzle});
  if (inner.empty()) inner = {area};
  const auto span_at = [&](double angle) { return mean_span_um(inner, around, infill, angle); };
  double best = below.angle_rad, least = span_at(best), most = least;
  for (int d = 1; d < directions; ++d) {
    stop_if_asked();
    const double angle = below.angle_rad + d * std::numbers::pi / directions, span = span_at(angle);
    if (span < clearly * least) best = angle, least = span;
    most = std::max(most, span);
  }
  if (most <= short_way * nozzle) return std::nullopt;
  return best;
}

std::optional<Held> held_over(const Regions& gaps, const Mask& below) {
  constexpr int directions = 36;
  constexpr double least_share = 0.5;   // below it most strands would end in air
  constexpr double nearly_best = 0.05;  // directions that rest as well as the best are told apart by their spans
  std::vector<Hung> found;
  for (int d = 0; d < directions; ++d) {
    stop_if_asked();
    found.push_back(hung(gaps, below, d * std::numbers::pi / directions));
  }
  for (const auto strands : {&Hung::resting, &Hung::held}) {
    double best_share = 0;
    for (const Hung& h : found) best_share = std::max(best_share, (h.*strands).share);
    if (best_share < least_share) continue;
    const Hung* best = nullptr;
    for (const Hung& h : found)
      if ((h.*strands).share >= best_share - nearly_best &&
          (best == nullptr || (h.*strands).long_span_um < (best->*strands).long_span_um))
        best = &h;
    return Held{best->angle_rad, strands == &Hung::held, (best->*strands).long_span_um};
  }
  return std::nullopt;
}

}  // namespace weft::infill
