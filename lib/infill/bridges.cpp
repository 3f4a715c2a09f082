// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/bridges.h"

#include "core/stop.h"
#include "geometry/offset.h"
#include "infill/scan.h"
#include "infill/strips.h"

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

/// How far a strand that runs on out of what hangs stands out from there, where it ends over nothing.
std::optional<double> stands_out_by(Turned end, double along, const Frame& frame, const OverSparse& around) {
  constexpr int most_cells = 100;  // until it leaves what hangs: else it runs along the edge
  const double cell = around.open.grid().cell;
  for (int k = 0; k < most_cells; ++k, end.x += along * cell)
    if (!around.hanging.at(frame.back(end)))
      return around.open.at(frame.back({end.x + along * cell, end.y})) ? std::optional(k * cell) : std::nullopt;
  return std::nullopt;
}

/// How strands of one direction hang between lines of infill.
struct Ways {
  double angle_rad = 0;
  double mean_um = 0;     ///< free ways, weighted by their length cubed: sag grows with a span's third power and more
  double free_share = 0;  ///< of their length: those that end over nothing
};

Ways ways_of(const Regions& areas, const OverSparse& around, const Beads& held_by, double angle_rad) {
  constexpr double spacing = 400;  // about a strand
  // A strand is laid straight because it is pulled; an end that nothing holds is not, and curls. So much longer is one
  // that sags as far.
  constexpr double stands_out = 6;
  const Frame frame(angle_rad, areas.front().outer.front());
  const Outline outline(areas, frame);
  const double height = outline.greatest_y() - outline.least_y();
  const int count = std::clamp(static_cast<int>(height / spacing), 4, 200);
  const LineSet lines{outline.least_y() + height / count / 2, height / count, count};
  const auto met = crossings(held_by, frame, lines);
  double all = 0, free = 0, cubes = 0, fourths = 0;
  const auto span = [&](double length, bool stands) {
    all += length, free += stands ? length : 0;
    if (stands) length *= stands_out;
    cubes += std::pow(length, 3), fourths += std::pow(length, 4);
  };
  auto at = met.begin();
  int line = -1;
  for (const Interval& i : outline.cut(lines)) {
    if (i.line != line)
      line = i.line, at = std::find_if(at, met.end(), [&](const Crossing& c) { return c.line >= line; });
    const double y = lines.y(line);
    const auto first = stands_out_by({i.from, y}, -1, frame, around), last = stands_out_by({i.to, y}, 1, frame, around);
    double from = i.from - first.value_or(0);
    bool stands = first.has_value();
    for (; at != met.end() && at->line == line && at->x < i.to; ++at)
      if (at->x > from) span(at->x - from, std::exchange(stands, false)), from = at->x;
    span(i.to + last.value_or(0) - from, stands || last);
  }
  return {angle_rad, cubes > 0 ? fourths / cubes : 0, all > 0 ? free / all : 0};
}

}  // namespace

std::optional<double> internal_bridge_angle_rad(const Region& area, const OverSparse& around, const SparseStyle& below,
                                                Um nozzle, bool narrow) {
  constexpr int directions = 18;
  constexpr double runs_on = 0.5;    // of its edge: then strands may run along it
  constexpr double short_way = 3;    // strands: lines that hang no further in any direction do not sag
  constexpr double clearly = 0.95;   // of a span: directions that are as good as the first give way to it
  constexpr double most_free = 0.5;  // of the strands' length: more ends over nothing
  const EdgeDirection edge = direction_of_edge(area);
  const bool runs = edge.share > runs_on;
  if (narrow && !runs) return std::nullopt;
  Beads infill;
  SparseStyle lines = below;
  lines.connect = false;  // its lines turn along the edge of the sparse area, not of this one
  fill_sparse(area, lines, infill);
  // A strand beside the edge, where no line of the infill ends yet, lies on what holds the edge.
  Regions inner = geometry::offset({area}, {.by = -2 * nozzle});
  if (inner.empty()) inner = {area};
  const auto ways_at = [&](double angle) { return ways_of(inner, around, infill, angle); };
  Ways best = ways_at(runs ? edge.angle_rad : below.angle_rad);
  const bool sags = best.mean_um > short_way * nozzle, held = best.free_share <= most_free;
  if (narrow || (runs && held && sags && best.mean_um <= easy_span * nozzle))
    return held && sags ? std::optional(best.angle_rad) : std::nullopt;
  double most_um = best.mean_um;
  for (int d = runs ? 0 : 1; d < directions; ++d) {
    stop_if_asked();
    const Ways ways = ways_at(below.angle_rad + d * std::numbers::pi / directions);
    if (ways.mean_um < clearly * best.mean_um) best = ways;
    most_um = std::max(most_um, ways.mean_um);
  }
  if (most_um <= short_way * nozzle) return std::nullopt;
  return best.angle_rad;
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
