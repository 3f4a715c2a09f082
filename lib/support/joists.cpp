// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/joists.h"

#include "geometry/boolean.h"
#include "geometry/clip_lines.h"
#include "geometry/delaunay.h"
#include "geometry/offset.h"
#include "geometry/simplify.h"
#include "geometry/spatial_index.h"
#include "geometry/trimmed.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <utility>

namespace weft::support {
namespace {

using Edge = std::pair<std::size_t, std::size_t>;  ///< tips, the one further back across the strands first

/// Sides that become joists.
class Chosen {
 public:
  Chosen(const std::vector<Point>& tips, const JoistStyle& style)
      : tips_(tips), style_(style), across_x_(-std::sin(style.strands_rad)), across_y_(std::cos(style.strands_rad)) {}

  void take(const std::array<std::size_t, 3>& triangle) {
    double widest = -1;
    Edge best;
    for (std::size_t i = 0; i < 3; ++i) {
      Edge edge{triangle[i], triangle[(i + 1) % 3]};
      if (before(edge.second, edge.first)) std::swap(edge.first, edge.second);
      if (distance(tips_[edge.first], tips_[edge.second]) > style_.longest) continue;
      if (!style_.one_way) edges_.insert(edge);
      // Of sides as good those that lean one way: joists are then as far from each other everywhere.
      const double wide = (at(edge.second) - at(edge.first)) * (along(edge.second) > along(edge.first) ? 1.0 : 0.9);
      if (wide > widest) widest = wide, best = edge;
    }
    if (widest > 0) edges_.insert(best);
  }

  /// Joists one behind the other are one line.
  std::vector<Polyline> lines() const {
    std::map<std::size_t, std::vector<std::size_t>> from;
    std::set<Edge> left = edges_;
    for (const Edge& edge : edges_) from[edge.first].push_back(edge.second);
    std::vector<Edge> order(edges_.begin(), edges_.end());
    std::sort(order.begin(), order.end(), [&](const Edge& a, const Edge& b) {
      return a.first != b.first ? before(a.first, b.first) : before(a.second, b.second);
    });
    std::vector<Polyline> out;
    for (Edge edge : order) {
      if (left.erase(edge) == 0) continue;
      Polyline line{tips_[edge.first], tips_[edge.second]};
      for (bool on = true; on;) {
        on = false;
        for (const std::size_t next : from[edge.second])
          if (left.erase({edge.second, next}) != 0) {
            edge = {edge.second, next}, on = true;
            line.push_back(tips_[next]);
            break;
          }
      }
      out.push_back(std::move(line));
    }
    return out;
  }

 private:
  double at(std::size_t tip) const { return tips_[tip].x * across_x_ + tips_[tip].y * across_y_; }
  double along(std::size_t tip) const { return tips_[tip].x * across_y_ - tips_[tip].y * across_x_; }
  bool before(std::size_t a, std::size_t b) const { return std::pair(at(a), a) < std::pair(at(b), b); }

  const std::vector<Point>& tips_;
  const JoistStyle& style_;
  double across_x_, across_y_;
  std::set<Edge> edges_;
};

/// What of beads along lines and rings lies on something, with what bridges between two rests.
class Resting {
 public:
  Resting(const Regions& below, const JoistStyle& style) : below_(below), style_(style) {}

  /// Beads of the same level that are laid before: their ends carry as well.
  void carried_by(std::span<const Polyline> lines) {
    for (const Polyline& line : lines) ends_.insert(ends_.end(), {line.front(), line.back()});
  }

  /// @return whether all of a ring rests; else its pieces that do, in `out`
  bool ring(const Ring& ring, std::vector<Polyline>& out) const {
    Polyline points = walked(ring, true);
    const auto first = std::find_if(points.begin(), points.end(), [&](Point p) { return rests(p); });
    if (first == points.end()) return false;
    std::rotate(points.begin(), first, points.end());
    points.push_back(points.front());
    auto pieces = spans(points);
    if (pieces.size() == 1) return true;
    if (pieces.size() > 1 && pieces.back().back() == pieces.front().front()) {  // it goes on over the begin
      pieces.back().insert(pieces.back().end(), pieces.front().begin() + 1, pieces.front().end());
      pieces.front() = std::move(pieces.back());
      pieces.pop_back();
    }
    for (auto& piece : pieces) {
      geometry::drop_collinear_of_line(piece);
      if (length_of(piece) >= 4 * style_.line) out.push_back(std::move(piece));
    }
    return false;
  }
  /// Whether any of a line rests.
  bool line(const Polyline& line) const {
    const auto points = walked(line, false);
    return std::any_of(points.begin(), points.end(), [&](Point p) { return rests(p); });
  }

 private:
  bool rests(Point p) const {
    return below_.region_at(p).has_value() ||
           std::any_of(ends_.begin(), ends_.end(), [&](Point end) { return distance(end, p) <= style_.line; });
  }
  /// From a rest to another as far as none is too far from the next one.
  std::vector<Polyline> spans(const Polyline& points) const {
    std::vector<Polyline> out;
    std::size_t last = 0;
    double since_um = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i > 0) since_um += distance(points[i - 1], points[i]);
      if (!rests(points[i])) continue;
      if (out.empty() || since_um > style_.longest)
        out.emplace_back();
      else
        out.back().insert(out.back().end(), points.begin() + static_cast<std::ptrdiff_t>(last) + 1,
                          points.begin() + static_cast<std::ptrdiff_t>(i));
      out.back().push_back(points[i]);
      last = i, since_um = 0;
    }
    return out;
  }
  /// Its corners, and points between them.
  static Polyline walked(std::span<const Point> line, bool closed) {
    constexpr double apart = 200;
    Polyline out;
    for (std::size_t i = 0; i + (closed ? 0 : 1) < line.size(); ++i) {
      const Point a = line[i], b = line[(i + 1) % line.size()];
      const int pieces = std::max(1, static_cast<int>(distance(a, b) / apart));
      for (int k = 0; k < pieces; ++k) out.push_back(lerp(a, b, static_cast<double>(k) / pieces));
    }
    if (!closed) out.push_back(line.back());
    return out;
  }

  geometry::SegmentIndex below_;
  const JoistStyle& style_;
  std::vector<Point> ends_;
};

/// Branches that have no other for a joist to run to.
class Lone {
 public:
  Lone(const std::vector<Point>& tips, const std::vector<Polyline>& lines, const JoistStyle& style) : style_(style) {
    std::set<Point> taken;
    for (const Polyline& line : lines) taken.insert(line.begin(), line.end());
    std::copy_if(tips.begin(), tips.end(), std::back_inserter(tips_), [&](Point p) { return taken.insert(p).second; });
  }

  /// On each that a region lies on, two beads that cross, as far as its rim.
  std::vector<Polyline> crosses(const Region& region) const {
    std::vector<Polyline> out;
    std::optional<geometry::SegmentIndex> rim;
    for (const Point tip : tips_) {
      if (side_of(region, tip) != Side::inside) continue;
      if (!rim) rim.emplace(geometry::offset({region}, {.by = -style_.line * 8 / 10}));
      if (!rim->region_at(tip)) continue;
      for (const double angle : {style_.strands_rad, style_.strands_rad + std::numbers::pi / 2})
        out.push_back({arm(tip, angle, *rim), tip, arm(tip, angle + std::numbers::pi, *rim)});
    }
    return out;
  }

 private:
  Point arm(Point tip, double angle, const geometry::SegmentIndex& rim) const {
    const double reach = style_.longest / 2.0;
    const Point end = tip + Point{rounded(reach * std::cos(angle)), rounded(reach * std::sin(angle))};
    std::vector<geometry::SegmentIndex::Crossing> found;
    rim.crossings(tip, end, found);
    return found.empty() ? end : lerp(tip, end, found.front().along);
  }

  const JoistStyle& style_;
  std::vector<Point> tips_;
};

/// The rims of a region, or what of them rests.
struct Rims {
  bool all = true;               ///< whether they rest as they are
  std::vector<Polyline> pieces;  ///< what does
};

Rims rims_on(const Resting& resting, const std::vector<Ring>& rings) {
  Rims out;
  std::vector<Polyline> whole;
  for (Ring ring : rings)
    if (resting.ring(ring, out.pieces))
      ring.push_back(ring.front()), whole.push_back(std::move(ring));
    else
      out.all = false;
  std::move(whole.begin(), whole.end(), std::back_inserter(out.pieces));
  return out;
}

void lay_rims(const JoistPlace& place, const Lone& lone, const JoistStyle& style, Joists& out) {
  const Resting resting(place.below, style);
  for (const Region& region : out.area) {
    // Under a slope each strip hangs on to the roof of the one below it: its loops are what steps lie on.
    const bool holds_on = !geometry::trimmed(place.beside, box_of(region.outer)).empty();
    std::vector<Ring> rings;
    if (!holds_on) rings = geometry::rings_of(geometry::offset({region}, {.by = -style.line / 2}));
    Rims rims = rims_on(resting, rings);
    if (rims.all) {
      out.rimmed.push_back(region);
      continue;
    }
    std::vector<Polyline>* to = &out.lines;
    if (auto crosses = lone.crosses(region); !crosses.empty()) {
      Resting on_crosses = resting;
      on_crosses.carried_by(crosses);
      rims = rims_on(on_crosses, rings);
      std::move(crosses.begin(), crosses.end(), std::back_inserter(out.lines));
      to = &out.after;
    }
    std::move(rims.pieces.begin(), rims.pieces.end(), std::back_inserter(*to));
  }
}

/// Where lines may be: within the area, and on their way from it to branches beyond.
/// @param inside  the area but for its rim
Regions ways(const std::vector<Polyline>& lines, const Regions& area, Regions inside, const JoistPlace& place) {
  if (!place.beside.empty()) return inside;  // which is a loop
  const geometry::SegmentIndex of_area(area), within(inside);
  std::vector<Ring> bands;
  for (const Polyline& all : lines)
    for (std::size_t i = 1; i < all.size(); ++i) {
      const Polyline edge{all[i - 1], all[i]};
      if (of_area.region_at(edge[0]) && of_area.region_at(edge[1])) continue;
      if (geometry::clip_lines({&edge, 1}, within).empty()) continue;
      const auto beyond = geometry::clip_lines({&edge, 1}, of_area, geometry::Keep::outside);
      if (!std::all_of(beyond.begin(), beyond.end(),
                       [&](const auto& piece) { return place.free(piece.line.front(), piece.line.back()); }))
        continue;
      constexpr double half = 10;
      const double length = distance(edge[0], edge[1]);
      const Point along{rounded(half * (edge[1].x - edge[0].x) / length),
                        rounded(half * (edge[1].y - edge[0].y) / length)};
      const Point side{-along.y, along.x}, a = edge[0] - along, b = edge[1] + along;
      bands.push_back({a - side, b - side, b + side, a + side});
    }
  if (bands.empty()) return inside;
  const Regions more = geometry::regions_from_rings(bands);
  inside.insert(inside.end(), more.begin(), more.end());
  return geometry::unite(inside);
}

/// From branches near the rim beads run out to it, across the strands along it, which would have nothing below. So
/// little of them is free that they stay straight.
void run_out_to_rim(std::vector<Polyline>& lines, const Regions& inside, const JoistStyle& style) {
  const double reach = 5.0 * style.line;
  const geometry::SegmentIndex rim(inside);
  const Point across{rounded(-reach * std::sin(style.strands_rad)), rounded(reach * std::cos(style.strands_rad))};
  std::set<std::pair<Point, bool>> done;  // tips, and whether on the far side
  const auto leaves = [&](Point tip, Point to) {
    const double ahead =
        (static_cast<double>(to.x - tip.x) * across.x + static_cast<double>(to.y - tip.y) * across.y) / reach;
    if (!rim.region_at(to) && 2 * std::abs(ahead) > distance(tip, to)) done.insert({tip, ahead > 0});
  };
  for (const Polyline& line : lines)
    for (std::size_t i = 1; i < line.size(); ++i) leaves(line[i - 1], line[i]), leaves(line[i], line[i - 1]);
  std::vector<Polyline> more;
  const auto run_out = [&](Polyline& line, Point tip, bool far) {
    if (!rim.region_at(tip) || !done.insert({tip, far}).second) return;
    const Point way = far ? across : -across;
    std::vector<geometry::SegmentIndex::Crossing> found;
    rim.crossings(tip, tip + way, found);
    if (found.empty()) return;
    const Point at = lerp(tip, tip + way, found.front().along);
    if (tip == line.front() && !far)
      line.insert(line.begin(), at);
    else if (tip == line.back() && far)
      line.push_back(at);
    else
      more.push_back({tip, at});
  };
  for (Polyline& line : lines)
    for (const Point tip : Polyline(line)) run_out(line, tip, false), run_out(line, tip, true);
  std::move(more.begin(), more.end(), std::back_inserter(lines));
}

}  // namespace

Joists joists_between(Regions area, const JoistPlace& place, const JoistStyle& style) {
  Joists out{std::move(area), {}, {}, {}};
  if (out.area.empty()) return out;
  Chosen chosen(place.tips, style);
  for (const auto& triangle : geometry::delaunay(place.tips)) chosen.take(triangle);
  auto lines = chosen.lines();
  Regions inside = geometry::offset(out.area, {.by = -style.line * 8 / 10});  // their ends lie on the rim
  if (style.one_way && place.beside.empty()) run_out_to_rim(lines, inside, style);
  const Lone lone(place.tips, lines, style);
  auto pieces = geometry::clip_lines(lines, ways(lines, out.area, std::move(inside), place));
  std::erase_if(pieces, [&](const auto& piece) { return length_of(piece.line) < style.line; });
  lay_rims(place, lone, style, out);
  if (place.beside.empty()) {
    Regions below = place.below;  // and the rims that they end on
    const Regions within = geometry::offset(out.rimmed, {.by = -style.line});
    for (auto& rim : geometry::subtract(out.rimmed, within)) below.push_back(std::move(rim));
    const Resting resting(below, style);
    std::erase_if(pieces, [&](const auto& piece) { return !resting.line(piece.line); });
  }
  for (auto& piece : pieces) out.lines.push_back(std::move(piece.line));
  return out;
}

}  // namespace weft::support
