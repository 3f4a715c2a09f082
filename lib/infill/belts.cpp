// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/belts.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "infill/belt_ring.h"
#include "infill/few_points.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace weft::infill {
namespace {

constexpr Um wall_within = 25;  // of the wall, on both sides: the edge that belts follow. Less than grids know of it
constexpr Um over_wall = 100;   // that an area is drawn over the wall beside it
constexpr Um over_line = 10;    // and over the line beside it

/// With places along long edges: a piece that stands for the wall may end at any of them.
Ring with_places(const Ring& ring) {
  constexpr double apart = 120;  // µm: a tenth of a piece that stands for a round wall
  Ring out;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i], b = ring[(i + 1) % ring.size()];
    const int pieces = std::max(1, static_cast<int>(distance(a, b) / apart));
    for (int k = 0; k < pieces; ++k) out.push_back(lerp(a, b, static_cast<double>(k) / pieces));
  }
  return out;
}

/// The edge that belts follow: pieces that stand for the wall, in the middle of it, so that their lines lack beside it
/// as much as they have too much. Where it is narrower than they may lie off, rings may cross: no line is so near to
/// it.
Region in_few_points(const Region& inside) {
  Region out{few_points(with_places(inside.outer), true, wall_within), {}};
  for (const Ring& hole : inside.holes) out.holes.push_back(few_points(with_places(hole), true, wall_within));
  return out;
}

/// What lies that far to the left and to the right of a line: rings, one a segment, which overlap at corners.
void draw(const BeltLine& line, double left, double right, std::vector<Ring>& rings) {
  const Polyline& path = line.path;
  const std::size_t n = path.size(), segments = line.closed ? n : n - 1;
  const auto normal = [&](std::size_t i) {  // of a segment, to the left, of length 1
    const Point a = path[i % n], b = path[(i + 1) % n];
    const double length = std::max(1.0, distance(a, b));
    return std::pair{-(b.y - a.y) / length, (b.x - a.x) / length};
  };
  constexpr double least = 0.25;  // of 1 + cos: corners sharper than about 140° are cut off
  const auto beside = [&](std::size_t i, double by) {
    const bool begins = !line.closed && i == 0, ends = !line.closed && i + 1 == n;
    const auto [ax, ay] = normal(begins ? 0 : (i + n - 1) % n);
    const auto [bx, by_] = normal(ends ? n - 2 : i);
    const double scale = by / std::max(least, 1 + ax * bx + ay * by_);
    return Point{path[i].x + rounded(scale * (ax + bx)), path[i].y + rounded(scale * (ay + by_))};
  };
  for (std::size_t i = 0; i < segments; ++i) {
    const std::size_t j = (i + 1) % n;
    Ring quad{beside(i, -right), beside(j, -right), beside(j, left), beside(i, left)};
    if (double_area(quad) < 0) std::reverse(quad.begin(), quad.end());
    rings.push_back(std::move(quad));
  }
}

/// A region of the inside while lines are laid in it, one depth after the other.
struct Work {
  Belts::Of of;
  Regions wall;
  std::vector<Ring> area;
  bool wide_enough = true;  // for the next line
};

/// The rings at one depth of all regions that have lines at the last one.
struct RingOf {
  Work* work;
  BeltRing ring;
};

std::vector<RingOf> rings_at(double depth, std::vector<Work>& all, const BeltGround& ground) {
  std::vector<RingOf> out;
  for (Work& work : all) {
    if (!std::exchange(work.wide_enough, false)) continue;
    stop_if_asked();
    for (Ring& ring : geometry::rings_of(geometry::offset(work.wall, {.by = -rounded(depth)})))
      out.push_back({&work, BeltRing(std::move(ring), depth, ground)});
  }
  return out;
}

/// Decides where the rings of one depth have lines: a step for all, then the next.
void decide(std::vector<RingOf>& rings, const LinesBefore& before) {
  const auto by_limit = [&](auto add, auto apply) {
    LengthLimit limit;
    for (const RingOf& each : rings) (each.ring.*add)(limit);
    const double um = limit.um();
    for (RingOf& each : rings) (each.ring.*apply)(um);
  };
  by_limit(&BeltRing::add_solid_runs, &BeltRing::open_solid_runs);
  for (RingOf& each : rings) each.ring.find_lines(before);
  by_limit(&BeltRing::add_pauses, &BeltRing::close_pauses);
  by_limit(&BeltRing::add_lines, &BeltRing::drop_lines);
}

}  // namespace

Belts find_belts(const Regions& inside, const Mask& solid, const Mask& sparse, const LayersInReach& layers, Um band) {
  Belts belts{{}, Mask(solid.grid())};
  if (!solid.any() || !sparse.any()) return belts;
  const BeltGround ground{solid, sparse, layers, static_cast<double>(band)};
  std::vector<Work> all;
  for (std::size_t i = 0; i < inside.size(); ++i) all.push_back({{i, {}, {}}, {in_few_points(inside[i])}, {}});
  const double half = band / 2.0;
  std::vector<BeltLine> last;  // of the depth before
  for (int k = 1; k <= most_belt_lines; ++k) {
    std::vector<RingOf> rings = rings_at((2 * k - 1) * half, all, ground);
    decide(rings, LinesBefore(std::exchange(last, {}), ground.band));
    for (const auto& [work, ring] : rings)
      for (BeltLine& line : ring.lines()) {
        draw(line, half, half + (k == 1 ? over_wall : over_line), work->area);
        last.push_back(line);
        work->of.lines.push_back(std::move(line));
        work->wide_enough = true;
      }
  }
  Regions areas;
  for (Work& work : all) {
    if (work.of.lines.empty()) continue;
    work.of.area = geometry::regions_from_rings(work.area);
    areas.insert(areas.end(), work.of.area.begin(), work.of.area.end());
    belts.found.push_back(std::move(work.of));
  }
  if (!areas.empty()) belts.area = Mask(solid.grid(), areas);
  return belts;
}

}  // namespace weft::infill
