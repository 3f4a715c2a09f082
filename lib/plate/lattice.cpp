// SPDX-License-Identifier: GPL-3.0-or-later
#include "plate/lattice.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/spatial_index.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

namespace weft::plate {
namespace {

constexpr std::size_t most_tries = 1000;  // of pairs, in all

Regions swapped(Regions regions) {
  for (auto& region : regions) {
    const auto swap = [](Ring& ring) {
      for (Point& p : ring) std::swap(p.x, p.y);
      std::reverse(ring.begin(), ring.end());
    };
    swap(region.outer);
    for (auto& hole : region.holes) swap(hole);
  }
  return regions;
}

/// Displacements that are forbidden, to be asked for many. Its edge is allowed: things touch there.
class Forbidden {
 public:
  explicit Forbidden(const Regions& regions) : index_(regions) {}
  /// Either of two meets the other: what holds for `by` holds for the way back.
  bool holds(Point by) const { return in(by) || in(Point{} - by); }

 private:
  bool in(Point by) const { return index_.box().contains(by) && index_.winding(by).value_or(0) != 0; }

  geometry::SegmentIndex index_;
};

/// Where the ring crosses the X axis to the right of 0.
void add_crossings(const Ring& ring, std::vector<Um>& out) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i], b = ring[i + 1 == ring.size() ? 0 : i + 1];
    if (a.y == 0 && a.x > 0) out.push_back(a.x);
    if ((a.y < 0) == (b.y < 0)) continue;
    const double x = a.x + static_cast<double>(-a.y) / (double(b.y) - a.y) * (double(b.x) - a.x);
    if (x > 0) out.push_back(static_cast<Um>(std::ceil(x)));
  }
}

/// The shortest step along X at which a motif may be repeated without end.
std::optional<Um> step_of(const Regions& regions, const Forbidden& forbidden, Um reach) {
  std::vector<Um> crossings;
  for (const auto& region : regions) {
    add_crossings(region.outer, crossings);
    for (const auto& hole : region.holes) add_crossings(hole, crossings);
  }
  std::sort(crossings.begin(), crossings.end());
  for (const Um step : crossings) {
    bool free = true;
    for (Um by = step; by <= reach && free; by += step) free = !forbidden.holds({by, 0});
    if (free) return step;
  }
  return std::nullopt;
}

/// Rows along X with the least of the bed for each motif.
std::optional<std::pair<Point, Point>> rows_of(const Regions& regions) {
  const Box box = weft::box_of(regions);
  const Forbidden forbidden(regions);
  const auto step = step_of(regions, forbidden, box.max.x);
  if (!step || *step <= 0) return std::nullopt;
  const Um reach = 2 * std::max(box.size().x, box.size().y);
  const auto free = [&](Point v) {
    for (Um k = 1; k * v.y <= box.max.y; ++k) {
      Um x = (k * v.x) % *step;
      for (x -= (x + box.max.x) / *step * *step; x <= box.max.x; x += *step)
        if (forbidden.holds({x, k * v.y})) return false;
    }
    return v.y > 0;
  };
  // All that neighbours in a row forbid together: the next row is at one of its corners.
  Regions row;
  for (Um by = -(*step); by <= *step; by += *step)
    for (auto& region : moved(regions, {by, 0})) row.push_back(std::move(region));
  std::vector<Point> corners;
  for (const auto& region : geometry::unite(row))
    for (const Point p : region.outer)
      if (p.y > 0 && p.y <= reach) corners.push_back({((p.x % *step) + *step) % *step, p.y});
  std::sort(corners.begin(), corners.end(), [](Point a, Point b) { return std::pair(a.y, a.x) < std::pair(b.y, b.x); });
  for (const Point v : corners)
    if (free(v)) return std::pair(Point{*step, 0}, v);
  return std::nullopt;
}

/// A motif to be tried: one thing, or two.
struct Try {
  std::size_t a = 0, b = 0;
  std::optional<Point> at;  ///< of b
};

/// No more corners than that, evenly spread.
std::vector<Point> corners_of(const Regions& regions, std::size_t most) {
  std::vector<Point> all;
  for (const auto& region : regions) all.insert(all.end(), region.outer.begin(), region.outer.end());
  if (all.size() <= most) return all;
  std::vector<Point> out;
  for (std::size_t i = 0; i < most; ++i) out.push_back(all[i * all.size() / most]);
  return out;
}

std::vector<Try> tries_of(std::size_t turns, const NoFit& no_fit) {
  std::vector<Try> out;
  for (std::size_t a = 0; a < turns; ++a) out.push_back({a, a, std::nullopt});
  const std::size_t pairs = turns * (turns - 1) / 2;
  for (std::size_t a = 0; a < turns; ++a)
    for (std::size_t b = a + 1; b < turns; ++b)
      for (const Point at : corners_of(no_fit(a, b), std::max<std::size_t>(most_tries / pairs, 8)))
        out.push_back({a, b, at});
  return out;
}

/// What two of the motif forbid to each other.
Regions forbidden_by(const Try& motif, const NoFit& no_fit) {
  Regions out = no_fit(motif.a, motif.a);
  if (!motif.at) return out;
  const auto add = [&](const Regions& regions, Point by) {
    for (auto& region : moved(regions, by)) out.push_back(std::move(region));
  };
  add(no_fit(motif.b, motif.b), {});
  add(no_fit(motif.a, motif.b), Point{} - *motif.at);
  add(no_fit(motif.b, motif.a), *motif.at);
  return geometry::unite(out);
}

}  // namespace

std::vector<Lattice> lattices(std::size_t turns, const NoFit& no_fit, std::size_t most) {
  for (std::size_t a = 0; a < turns; ++a)  // found once: below it is asked for from many threads
    for (std::size_t b = 0; b < turns; ++b) (void)no_fit(a, b);
  const auto tries = tries_of(turns, no_fit);
  auto found = tasks::parallel_map(tries.size(), [&](std::size_t i) {
    stop_if_asked();
    const auto& motif = tries[i];
    const Regions regions = forbidden_by(motif, no_fit);
    std::vector<Lattice> out;
    for (const bool along_y : {false, true}) {
      const auto rows = rows_of(along_y ? swapped(regions) : regions);
      if (!rows) continue;
      Lattice lattice{{{{}, motif.a}}, rows->first, rows->second, 0};
      if (motif.at) lattice.motif.push_back({*motif.at, motif.b});
      lattice.mm2 = to_mm(lattice.u.x) * to_mm(lattice.v.y) / static_cast<double>(lattice.motif.size());
      if (along_y) std::swap(lattice.u.x, lattice.u.y), std::swap(lattice.v.x, lattice.v.y);
      out.push_back(std::move(lattice));
    }
    return out;
  });
  std::vector<Lattice> out;
  for (auto& each : found) std::move(each.begin(), each.end(), std::back_inserter(out));
  std::stable_sort(out.begin(), out.end(), [](const Lattice& a, const Lattice& b) { return a.mm2 < b.mm2; });
  if (out.size() > most) out.resize(most);
  return out;
}

}  // namespace weft::plate
