// SPDX-License-Identifier: GPL-3.0-or-later
#include "plate/nest.h"

#include "core/convex_hull.h"
#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "geometry/simplify.h"
#include "geometry/spatial_index.h"
#include "plate/lattice.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

namespace weft::plate {
namespace {

using namespace weft::literals;

constexpr std::size_t most_placed = 10'000;
constexpr Um play = 2;  // what fits to the micron has room: a place, not a point

/// Corners of an outline: no-fit polygons cost their product, and there is one for every two shapes.
std::size_t most_corners(std::size_t shapes) {
  return shapes <= 8 ? 80 : shapes <= 40 ? 40 : 24;
}

Ring turned_round(Ring ring) {
  for (Point& p : ring) p = -p;
  return ring;
}

Ring hull_of(const Regions& outline) {
  std::vector<Point> corners;
  for (const auto& region : outline) corners.insert(corners.end(), region.outer.begin(), region.outer.end());
  return convex_hull(std::move(corners));
}

/// The polygon of so many sides, in even directions, that lies around a convex ring.
Ring around(const Ring& hull, std::size_t sides) {
  struct Line {
    double x, y, furthest;
  };
  std::vector<Line> lines;
  for (std::size_t i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(sides);
    Line line{std::cos(angle), std::sin(angle), -1e18};
    for (const Point p : hull) line.furthest = std::max(line.furthest, line.x * p.x + line.y * p.y);
    lines.push_back(line);
  }
  Ring out;
  for (std::size_t i = 0; i < sides; ++i) {
    const auto &a = lines[i], &b = lines[(i + 1) % sides];
    const double d = a.x * b.y - a.y * b.x;
    out.push_back(
        {rounded((a.furthest * b.y - b.furthest * a.y) / d), rounded((a.x * b.furthest - b.x * a.furthest) / d)});
  }
  return convex_hull(std::move(out));
}

/// Widened; where that has too many corners fewer of them, and never smaller: widened by as much more as simplifying
/// may cut off. Where that does not do a polygon around it does: things of many islands, or crumpled ones, hold little
/// between them that others would fit in.
std::vector<Ring> rings_of(const Regions& outline, Um by, std::size_t most) {
  for (Um bound = 0; bound < 1_mm; bound = bound == 0 ? 50 : 2 * bound) {
    const auto wide = geometry::offset(outline, {.by = by + bound, .corner = geometry::Corner::miter});
    std::vector<Ring> out;
    std::size_t corners = 0;
    for (const auto& region : bound == 0 ? wide : geometry::simplified(wide, bound)) {
      out.push_back(region.outer);
      corners += region.outer.size();
    }
    if (corners <= most) return out;
  }
  constexpr Um rounding = 1;
  const auto wide =
      geometry::offset({{hull_of(outline), {}}}, {.by = by + rounding, .corner = geometry::Corner::miter});
  return {around(hull_of(wide), most)};
}

/// Where a shape may be with all its corners in a convex surface.
Regions inside_of(const Ring& convex_surface, const std::vector<Ring>& shape) {
  std::vector<Point> corners;
  for (const auto& ring : shape) corners.insert(corners.end(), ring.begin(), ring.end());
  Regions out;
  for (const Point corner : convex_hull(std::move(corners))) {
    Ring moved = convex_surface;
    for (Point& p : moved) p = p - corner;
    out = out.empty() ? Regions{{std::move(moved), {}}} : geometry::intersect(out, {{std::move(moved), {}}});
    if (out.empty()) return out;
  }
  return out;
}

/// One way to lie, with what there is to know of it.
struct Shape {
  std::vector<Ring> small, wide;  ///< with what lies beside it, and with the spacing around that
  Box box;                        ///< of `small`
  bool high = false;
  Regions at_first;  ///< where it may be on an empty bed
};

enum class Way { middle_out, from_below, from_left };

/// Shapes that are placed, and what forbids what.
class Nest {
 public:
  Nest(std::span<const NestKind> kinds, const NestBed& bed) : kinds_(kinds), bed_(bed) {
    for (const auto& kind : kinds) {
      first_.push_back(shapes_.size());
      shapes_.resize(shapes_.size() + kind.outlines.size());
      size_.push_back(std::abs(static_cast<double>(double_area(hull_of(kind.outlines.front())))));
    }
    const std::size_t most = most_corners(shapes_.size());
    const Regions room = geometry::offset({{bed.surface, {}}}, {.by = play});
    const Ring hull = convex_hull({room.front().outer.begin(), room.front().outer.end()});
    Regions obstacles = geometry::subtract({{hull, {}}}, room);
    for (const auto& ring : bed.keep_out) obstacles.push_back({ring, {}});
    for (std::size_t k = 0; k < kinds.size(); ++k)
      for (std::size_t turn = 0; turn < kinds[k].outlines.size(); ++turn) {
        auto& shape = shapes_[first_[k] + turn];
        shape.small = rings_of(kinds[k].outlines[turn], bed.beside, most);
        shape.wide = rings_of(kinds[k].outlines[turn], bed.beside + bed.spacing - play, most);
        for (const auto& ring : shape.small) shape.box.add(box_of(ring));
        shape.high = bed.bar != Bar::none && kinds[k].high;
      }
    auto free = tasks::parallel_map(shapes_.size(), [&](std::size_t s) {
      Regions forbidden;
      for (const auto& obstacle : obstacles)
        for (const auto& ring : shapes_[s].small)
          for (auto& region : no_fit(obstacle.outer, ring)) forbidden.push_back(std::move(region));
      const Regions inside = inside_of(hull, shapes_[s].small);
      return forbidden.empty() ? inside : geometry::subtract(inside, forbidden);
    });
    for (std::size_t s = 0; s < shapes_.size(); ++s) shapes_[s].at_first = std::move(free[s]);
    pairs_.resize(shapes_.size());
  }

  std::vector<std::vector<Nested>> run(Way way, bool turned) {
    begin();
    std::vector<std::vector<Nested>> out(kinds_.size());
    std::vector<std::size_t> order(kinds_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return size_[a] > size_[b]; });
    for (const std::size_t k : order)
      for (std::size_t i = 0; i < kinds_[k].copies && put(k, way, turned, out); ++i) {
      }
    fill(order, way, turned, out);
    return out;
  }

  /// The only kind in a lattice, where that lies best on the bed, and behind it as low as can be.
  std::vector<std::vector<Nested>> run(const Lattice& lattice) {
    const std::size_t most = kinds_[0].copies > 0 ? kinds_[0].copies : most_placed;
    std::vector<Nested> best;
    constexpr int shifts = 4;  // along either side of a cell
    for (int i = 0; i < shifts; ++i)
      for (int k = 0; k < shifts; ++k) {
        const Point by{(lattice.u.x * i + lattice.v.x * k) / shifts, (lattice.u.y * i + lattice.v.y * k) / shifts};
        auto stands = stands_of(lattice, by);
        if (stands.size() > best.size()) best = std::move(stands);
      }
    if (best.size() > most) best.resize(most);
    begin();
    for (const auto& [at, turn] : best) placed_.push_back({turn, at});
    std::vector<std::vector<Nested>> out{std::move(best)};
    if (kinds_[0].copies == 0) fill({0}, Way::from_below, true, out);
    while (out[0].size() < kinds_[0].copies && put(0, Way::from_below, true, out)) {
    }
    return out;
  }

  /// The densest lattices of the only kind.
  std::vector<Lattice> lattices_of_kind() {
    constexpr std::size_t tried = 12;
    return lattices(
        shapes_.size(), [&](std::size_t a, std::size_t b) -> const Regions& { return no_fit_of(a, b); }, tried);
  }

 private:
  using Rank = std::array<std::int64_t, 3>;

  void begin() {
    placed_.clear();
    free_.clear();
    for (const auto& shape : shapes_) free_.push_back({shape.at_first, 0});
  }

  /// Those of which there may be any number, in turns.
  void fill(const std::vector<std::size_t>& order, Way way, bool turned, std::vector<std::vector<Nested>>& out) {
    std::size_t more = 0;
    for (bool any = true; any && more < most_placed;) {
      any = false;
      for (const std::size_t k : order)
        if (kinds_[k].copies == 0 && put(k, way, turned, out)) any = true, ++more;
    }
  }

  /// All points of a lattice at which its things lie on the bed, the lowest first.
  std::vector<Nested> stands_of(const Lattice& lattice, Point by) const {
    const Box bed = box_of(bed_.surface);
    std::vector<geometry::SegmentIndex> free;
    for (const auto& shape : shapes_) free.emplace_back(shape.at_first);
    // Points u·i + v·k with one of them in the box: solved for its corners.
    const double d = double(lattice.u.x) * lattice.v.y - double(lattice.u.y) * lattice.v.x;
    double low_i = 1e9, high_i = -1e9, low_k = 1e9, high_k = -1e9;
    for (const Point p : {bed.min, Point{bed.max.x, bed.min.y}, bed.max, Point{bed.min.x, bed.max.y}}) {
      const double i = (double(p.x) * lattice.v.y - double(p.y) * lattice.v.x) / d;
      const double k = (double(p.y) * lattice.u.x - double(p.x) * lattice.u.y) / d;
      low_i = std::min(low_i, i), high_i = std::max(high_i, i), low_k = std::min(low_k, k),
      high_k = std::max(high_k, k);
    }
    std::vector<Nested> out;
    for (auto i = static_cast<Um>(std::floor(low_i)) - 2; i <= high_i + 2; ++i)
      for (auto k = static_cast<Um>(std::floor(low_k)) - 2; k <= high_k + 2; ++k)
        for (const auto& [at, turn] : lattice.motif) {
          const Point p{by.x + i * lattice.u.x + k * lattice.v.x + at.x,
                        by.y + i * lattice.u.y + k * lattice.v.y + at.y};
          if (!shapes_[turn].at_first.empty() && bed.contains(p) && free[turn].region_at(p)) out.push_back({p, turn});
        }
    std::sort(out.begin(), out.end(),
              [](const Nested& a, const Nested& b) { return std::pair(a.at.y, a.at.x) < std::pair(b.at.y, b.at.x); });
    return out;
  }

  bool put(std::size_t k, Way way, bool turned, std::vector<std::vector<Nested>>& out) {
    stop_if_asked();
    const std::size_t turns = turned ? kinds_[k].outlines.size() : 1;
    const auto offers = tasks::parallel_map(turns, [&](std::size_t turn) {
      refresh(first_[k] + turn);
      return best(first_[k] + turn, way);
    });
    std::optional<std::size_t> chosen;
    for (std::size_t turn = 0; turn < turns; ++turn)
      if (offers[turn] && (!chosen || offers[turn]->first < offers[*chosen]->first)) chosen = turn;
    if (!chosen) return false;
    const Point at = offers[*chosen]->second;
    out[k].push_back({at, *chosen});
    placed_.push_back({first_[k] + *chosen, at});
    return true;
  }

  Rank rank(const Box& box, Point p, Way way) const {
    const Point low = box.min + p, high = box.max + p;
    if (way == Way::from_below) return {high.y, low.x, low.y};
    if (way == Way::from_left) return {high.x, low.y, low.x};
    const auto away = [&](Point corner) { return distance2(corner, bed_.middle); };
    return {std::max({away(low), away(high), away({low.x, high.y}), away({high.x, low.y})}), p.y, p.x};
  }

  std::optional<std::pair<Rank, Point>> best(std::size_t s, Way way) const {
    std::optional<std::pair<Rank, Point>> out;
    const auto offer = [&](Point p) {
      const Rank own = rank(shapes_[s].box, p, way);
      if (!out || own < out->first) out = {own, p};
    };
    for (const auto& region : free_[s].regions) {
      for (const Point p : region.outer) offer(p);
      for (const auto& hole : region.holes)
        for (const Point p : hole) offer(p);
      if (way == Way::middle_out && side_of(region, bed_.middle) == Side::inside) offer(bed_.middle);
    }
    return out;
  }

  /// What was placed since is taken off where a shape may be.
  void refresh(std::size_t s) {
    auto& free = free_[s];
    Regions forbidden;
    for (; free.placed < placed_.size(); ++free.placed) {
      const auto& [by, at] = placed_[free.placed];
      for (auto& region : moved(no_fit_of(by, s), at)) forbidden.push_back(std::move(region));
    }
    if (!forbidden.empty() && !free.regions.empty()) free.regions = geometry::subtract(free.regions, forbidden);
  }

  /// The no-fit polygon of each two shapes is found once. Of another `s` another thread may ask.
  const Regions& no_fit_of(std::size_t placed, std::size_t s) {
    const auto [at, is_new] = pairs_[s].try_emplace(placed);
    if (!is_new) return at->second;
    if (shapes_[placed].high && shapes_[s].high) return at->second = {{strip(shapes_[placed].box, shapes_[s].box), {}}};
    Regions all;
    for (const auto& a : shapes_[placed].wide)
      for (const auto& b : shapes_[s].small)
        for (auto& region : no_fit(a, b)) all.push_back(std::move(region));
    return at->second = geometry::unite(all);
  }

  /// Where b may not be for the bar that goes over a, or the other way round: all along it.
  Ring strip(const Box& a, const Box& b) const {
    const Box bed = box_of(bed_.surface);
    const Um far = 2 * std::max(bed.size().x, bed.size().y), room = bed_.spacing - play;
    Box out{a.min - b.max - Point{room, room}, a.max - b.min + Point{room, room}};
    if (bed_.bar == Bar::along_x)
      out.min.x = -far, out.max.x = far;
    else
      out.min.y = -far, out.max.y = far;
    return {out.min, {out.max.x, out.min.y}, out.max, {out.min.x, out.max.y}};
  }

  struct Free {
    Regions regions;
    std::size_t placed = 0;  ///< how many of them it knows of
  };
  std::span<const NestKind> kinds_;
  const NestBed& bed_;
  std::vector<std::size_t> first_;  ///< of each kind: its first shape
  std::vector<double> size_;        ///< of each kind, by its hull
  std::vector<Shape> shapes_;
  std::vector<Free> free_;                             ///< by shape
  std::vector<std::pair<std::size_t, Point>> placed_;  ///< shapes
  std::vector<std::map<std::size_t, Regions>> pairs_;  ///< of each shape: where it may not be, by what stands
};

std::size_t count_of(const std::vector<std::vector<Nested>>& places) {
  std::size_t out = 0;
  for (const auto& kind : places) out += kind.size();
  return out;
}

}  // namespace

Regions no_fit(const Ring& a, const Ring& b) {
  const Ring c = turned_round(b);
  if (is_convex(a) && is_convex(c)) {
    std::vector<Point> corners;
    for (const Point p : a)
      for (const Point q : c) corners.push_back(p + q);
    return {{convex_hull(std::move(corners)), {}}};
  }
  std::vector<Ring> swept;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < c.size(); ++j) {
      const Point p = a[i], q = a[(i + 1) % a.size()], u = c[j], v = c[(j + 1) % c.size()];
      Ring quad{p + u, q + u, q + v, p + v};
      if (double_area(quad) < 0) std::reverse(quad.begin(), quad.end());
      if (double_area(quad) != 0) swept.push_back(std::move(quad));
    }
  Regions out = geometry::regions_from_rings(swept, geometry::WindingRule::nonzero);
  for (auto& region : out) region.holes.clear();
  return geometry::unite(out);
}

std::vector<std::vector<Nested>> nest(std::span<const NestKind> kinds, const NestBed& bed) {
  Nest nest(kinds, bed);
  const bool fills = std::any_of(kinds.begin(), kinds.end(), [](const NestKind& kind) { return kind.copies == 0; });
  const bool turns =
      std::any_of(kinds.begin(), kinds.end(), [](const NestKind& kind) { return kind.outlines.size() > 1; });
  std::size_t asked = 0;
  for (const auto& kind : kinds) asked += kind.copies;
  std::optional<std::vector<std::vector<Nested>>> out;
  for (const bool turned : {false, true})
    for (const Way way : {Way::middle_out, Way::from_below, Way::from_left}) {
      if (turned && !turns) continue;
      auto next = nest.run(way, turned);
      if (!out || count_of(next) > count_of(*out)) out = std::move(next);
      if (!fills && count_of(*out) == asked) return *out;
    }
  if (kinds.size() == 1 && !(kinds[0].high && bed.bar != Bar::none))
    for (const auto& lattice : nest.lattices_of_kind()) {
      auto next = nest.run(lattice);
      if (count_of(next) > count_of(*out)) out = std::move(next);
      if (!fills && count_of(*out) == asked) return *out;
    }
  return *out;
}

}  // namespace weft::plate
