// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/bridges.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "infill/scan.h"
#include "infill/strips.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
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

/// Lines of so many at least and at most that share the height of an outline evenly, about `spacing` apart.
LineSet lines_across(const Outline& outline, double spacing, int least, int most) {
  const double height = outline.greatest_y() - outline.least_y();
  const int count = std::clamp(static_cast<int>(height / spacing), least, most);
  return {outline.least_y() + height / count / 2, height / count, count};
}

/// Lines that stand for the strands of an area where only their directions are compared: about one for each.
LineSet few_across(const Outline& outline) {
  return lines_across(outline, 400, 4, 200);
}

Hung hung(const Regions& gaps, const Mask& below, double angle_rad) {
  const double beyond = 2.5 * below.grid().cell;  // how far past its end a strand must find support: the grid's doubt
  const Frame frame(angle_rad, gaps.front().outer.front());
  const Outline outline(gaps, frame);
  const LineSet lines = few_across(outline);
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

/// The infill that strands over areas lie on, without its joints: those turn along the edge of the sparse area, not of
/// these.
Beads infill_below(const Regions& areas, SparseStyle style) {
  style.connect = false;
  Beads out;
  for (const Region& area : areas) fill_sparse(area, style, out);
  return out;
}

/// How far a strand goes on at most for something to lie on. Two lines of the infill are met within two of their
/// distances; the third is for strands that cross them aslant, by up to 48°. Those of patterns that cross themselves,
/// which stand farther apart, are met sooner as well.
double reach_um(const SparseStyle& below) {
  return 3 * below.band / below.density;
}

bool is_beside_open(const Region& area, const OverSparse& around) {
  return Mask(around.open.grid(), {&area, 1}).grown(1).meets(around.open);
}

/// The infill below the area and around it, as far as strands may go on.
Beads infill_around(const Region& area, const SparseStyle& below) {
  return infill_below(geometry::offset({area}, {.by = rounded(reach_um(below))}), below);
}

bool by_line(const Crossing& a, const Crossing& b) {
  return a.line < b.line;
}

/// A strand in the frame of its direction.
struct Strand {
  double y = 0, from = 0, to = 0;
};

/// An end of a strand that lies on nothing, and the way on from there to what holds it.
struct FreeEnd {
  double along = 0;  ///< −1: its first end, 1: its last
  double by = 0;     ///< µm
};

/// How far on from an end the nearest thing is to lie on.
std::optional<double> way_on(const Strand& strand, double along, std::span<const Crossing> holds, const Frame& frame,
                             const OverSparse& around) {
  const double end = along < 0 ? strand.from : strand.to;
  const double reach = reach_um(around.below);
  double nearest = reach;
  for (const Crossing& c : holds)
    if (const double by = along * (c.x - end); by >= 0) nearest = std::min(nearest, by);
  const double cell = around.open.grid().cell;
  for (double by = cell; by < nearest; by += cell) {
    const Point p = frame.back({end + along * by, strand.y});
    if (!around.hanging.at(p) && !around.open.at(p)) return by;
  }
  return nearest < reach ? std::optional(nearest) : std::nullopt;
}

/// The ends at which a strand must go on to lie on two things, the nearer first.
std::vector<FreeEnd> missing_ends(const Strand& strand, std::span<const Crossing> holds, const Frame& frame,
                                  const OverSparse& around) {
  constexpr int enough = 2;
  int held = static_cast<int>(std::count_if(holds.begin(), holds.end(),
                                            [&](const Crossing& c) { return c.x > strand.from && c.x < strand.to; }));
  std::vector<FreeEnd> free;
  for (const double along : {-1.0, 1.0}) {
    const Turned end{along < 0 ? strand.from : strand.to, strand.y};
    if (!stands_out_by(end, along, frame, around))
      ++held;
    else if (const auto by = way_on(strand, along, holds, frame, around))
      free.push_back({along, *by});
  }
  if (free.size() == 2 && free[1].by < free[0].by) std::swap(free[0], free[1]);
  free.resize(std::min(free.size(), static_cast<std::size_t>(std::max(0, enough - held))));
  return free;
}

/// How strands of one direction hang between lines of infill.
struct Ways {
  double angle_rad = 0;
  double mean_um = 0;     ///< free ways, weighted by their length cubed: sag grows with a span's third power and more
  double free_share = 0;  ///< of their length: those that end over nothing
};

Ways ways_of(const Regions& areas, const OverSparse& around, const Beads& held_by, double angle_rad) {
  // A strand is laid straight because it is pulled; an end that nothing holds is not, and curls. So much longer is one
  // that sags as far.
  constexpr double stands_out = 6;
  const Frame frame(angle_rad, areas.front().outer.front());
  const Outline outline(areas, frame);
  const LineSet lines = few_across(outline);
  const auto met = crossings(held_by, frame, lines);
  double all = 0, free = 0, cubes = 0, fourths = 0;
  const auto span = [&](double length, bool stands) {
    all += length, free += stands ? length : 0;
    if (stands) length *= stands_out;
    cubes += std::pow(length, 3), fourths += std::pow(length, 4);
  };
  for (const Interval& i : outline.cut(lines)) {
    const auto [begin, end] = std::equal_range(met.begin(), met.end(), Crossing{i.line, 0}, by_line);
    Strand strand{lines.y(i.line), i.from, i.to};
    auto first = stands_out_by({strand.from, strand.y}, -1, frame, around);
    auto last = stands_out_by({strand.to, strand.y}, 1, frame, around);
    for (const FreeEnd& each : missing_ends(strand, {begin, end}, frame, around)) {
      (each.along < 0 ? strand.from : strand.to) += each.along * each.by;
      (each.along < 0 ? first : last).reset();
    }
    double from = strand.from - first.value_or(0);
    bool stands = first.has_value();
    for (auto at = begin; at != end && at->x < strand.to; ++at)
      if (at->x > from) span(at->x - from, std::exchange(stands, false)), from = at->x;
    span(strand.to + last.value_or(0) - from, stands || last);
  }
  return {angle_rad, cubes > 0 ? fourths / cubes : 0, all > 0 ? free / all : 0};
}

}  // namespace

std::optional<double> internal_bridge_angle_rad(const Region& area, const OverSparse& around, Um nozzle, bool narrow) {
  constexpr int directions = 18;
  constexpr double short_way = 3;    // strands: lines that hang no further in any direction do not sag
  constexpr double clearly = 0.8;    // of a span, so 0.4 of its sag: else the first direction stays
  constexpr double most_free = 0.5;  // of the strands' length: more ends over nothing
  const auto along = angle_of_axis(area, narrow ? std::optional<double>(nozzle) : std::nullopt);
  if (narrow && !along) return std::nullopt;
  Beads infill = infill_below({area}, around.below);
  if (infill.empty() && is_beside_open(area, around)) infill = infill_around(area, around.below);
  // A strand beside the edge, where no line of the infill ends yet, lies on what holds the edge.
  Regions inner = geometry::offset({area}, {.by = -2 * nozzle});
  if (inner.empty()) inner = {area};
  const auto ways_at = [&](double angle) { return ways_of(inner, around, infill, angle); };
  Ways best = ways_at(along.value_or(around.below.angle_rad));
  const bool sags = best.mean_um > short_way * nozzle, held = best.free_share <= most_free;
  if (narrow || (along && held && sags && best.mean_um <= easy_span * nozzle))
    return held && sags ? std::optional(best.angle_rad) : std::nullopt;
  double most_um = best.mean_um;
  for (int d = along ? 0 : 1; d < directions; ++d) {
    stop_if_asked();
    const Ways ways = ways_at(around.below.angle_rad + d * std::numbers::pi / directions);
    if (ways.mean_um < clearly * best.mean_um) best = ways;
    most_um = std::max(most_um, ways.mean_um);
  }
  if (most_um <= short_way * nozzle) return std::nullopt;
  return best.angle_rad;
}

Regions up_to_holds(const Region& area, double angle_rad, const OverSparse& around, double line) {
  if (!is_beside_open(area, around)) return {};
  const Frame frame(angle_rad, area.outer.front());
  const Outline outline(area, frame);
  const LineSet strands = lines_across(outline, line, 1, std::numeric_limits<int>::max());
  const auto holds = crossings(infill_around(area, around.below), frame, strands);
  Regions out;
  for (const Interval& i : outline.cut(strands)) {
    const Strand strand{strands.y(i.line), i.from, i.to};
    const auto [first, last] = std::equal_range(holds.begin(), holds.end(), Crossing{i.line, 0}, by_line);
    for (const FreeEnd& end : missing_ends(strand, {first, last}, frame, around)) {
      const double from = end.along < 0 ? i.from : i.to, to = from + end.along * (end.by + line);
      const double low = strand.y - strands.spacing / 2, high = strand.y + strands.spacing / 2;
      out.push_back({{frame.back({std::min(from, to), low}), frame.back({std::max(from, to), low}),
                      frame.back({std::max(from, to), high}), frame.back({std::min(from, to), high})},
                     {}});
    }
  }
  return geometry::unite(out);
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
