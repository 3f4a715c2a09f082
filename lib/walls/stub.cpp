// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/stub.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace weft::walls {
namespace {

using Vertex = Line::Vertex;

constexpr std::size_t most_edges = 12;  // so many of a ring's longest edges are tried as directions
constexpr int looks = 16;               // chords by which directions are compared
constexpr std::size_t most_sides = 8;   // … and two by two as sides
constexpr double straight_um = 0.2;     // off its neighbours' chord: a corner; edges alike in length to that are equal
constexpr double straight = 2e-3;       // … or a turn of more, its sine
constexpr double least_turn_cos = 0.5;  // between the directions in which a ring runs along the two sides of a bead
constexpr double breadth_malus = 0.25;  // of the share, for a bead as broad as long
constexpr double step_um = 40;
constexpr double before_end_um = 4;  // there the width of an end is measured: an edge need not be quite square

struct Shape {
  double area = 0;
  Place centre;
};

Shape shape_of(const std::vector<Place>& ring) {
  Shape shape;
  const Place o = ring.front();
  double x = 0, y = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    const double twice = cross(o, ring[i], ring[i + 1]);
    shape.area += twice / 2;
    x += twice * (ring[i].x + ring[i + 1].x - 2 * o.x), y += twice * (ring[i].y + ring[i + 1].y - 2 * o.y);
  }
  if (std::abs(shape.area) < 1) return {};
  shape.centre = {o.x + x / (6 * shape.area), o.y + y / (6 * shape.area)};
  shape.area = std::abs(shape.area);
  return shape;
}

/// A line through a ring: where it lies inside for longest, and how much room there is beside it.
class Cut {
 public:
  Cut(const std::vector<Place>& ring, Place through, Place way) : ring_(ring), o_(through), u_(way) {
    std::vector<double> at;
    each_crossing(0, u_, [&](double t) { at.push_back(t); });
    std::sort(at.begin(), at.end());
    for (std::size_t i = 1; i < at.size(); i += 2)
      if (at[i] - at[i - 1] > to - from) from = at[i - 1], to = at[i];
  }
  double from = 0, to = 0;

  struct Room {
    double left = 0, right = 0;
  };
  Room beside(double x) const {
    Gap gap;
    each_crossing(x, {-u_.y, u_.x}, [&](double t) { gap.narrow(t); });
    return gap.room();
  }

  /// The area that a bead of even sides covers.
  double covered() const {
    const double length = to - from;
    if (!(length > 0)) return 0;
    std::array<Place, looks> places;
    std::array<Gap, looks> gaps;
    for (int i = 0; i < looks; ++i) places[index(i)] = at(from + (i + 0.5) * length / looks);
    const auto look_of = [&](Place q) {
      const double x = (q.x - o_.x) * u_.x + (q.y - o_.y) * u_.y;
      return (x - from) / length * looks - 0.5;
    };
    const Place across{-u_.y, u_.x};
    double a_look = look_of(ring_.back());
    for (std::size_t k = 0; k < ring_.size(); ++k) {  // each edge is looked at where it may be met, and one further
      const double b_look = look_of(ring_[k]);
      const auto first = static_cast<int>(std::clamp(std::min(a_look, b_look) - 1, 0.0, double{looks})),
                 end = static_cast<int>(std::clamp(std::max(a_look, b_look) + 2, 0.0, double{looks}));
      for (int i = first; i < end; ++i)
        edge_crossing(k, places[index(i)], across, [&](double t) { gaps[index(i)].narrow(t); });
      a_look = b_look;
    }
    double sum = 0;
    for (const Gap& gap : gaps) {
      const Room room = gap.room();
      sum += 2 * std::min(room.left, room.right);
    }
    return sum * length / looks;
  }

  Place at(double x) const { return {o_.x + x * u_.x, o_.y + x * u_.y}; }

 private:
  /// How far it is to what was crossed on either side.
  struct Gap {
    double left = 1e18, right = 1e18;
    void narrow(double t) { t < 0 ? right = std::min(right, -t) : left = std::min(left, t); }
    Room room() const { return left > 1e17 || right > 1e17 ? Room{} : Room{left, right}; }
  };
  static std::size_t index(int look) { return static_cast<std::size_t>(look); }

  /// Where the edge that ends at a corner crosses the line through p in direction v.
  template <class F>
  void edge_crossing(std::size_t corner, Place p, Place v, F f) const {
    const Place &before = ring_[corner > 0 ? corner - 1 : ring_.size() - 1], &after = ring_[corner];
    const Place a{before.x - p.x, before.y - p.y}, b{after.x - p.x, after.y - p.y};
    const double a_side = cross(v, a), b_side = cross(v, b);
    if ((a_side < 0) != (b_side < 0)) f(meeting(v, a, a_side, b, b_side));
  }
  /// Where the ring crosses the line through the place x on this one, in direction v.
  template <class F>
  void each_crossing(double x, Place v, F f) const {
    const Place p = at(x);
    for (std::size_t k = 0; k < ring_.size(); ++k) edge_crossing(k, p, v, f);
  }

  const std::vector<Place>& ring_;
  Place o_, u_;
};

struct Edge {
  double length = 0;
  Place a, way;
};

/// A ring without what lies on the way between its neighbours: ribs of an axis cut its edges.
std::vector<Place> corners_of(const std::vector<Place>& ring) {
  std::vector<Place> points, out;
  for (const Place p : ring)
    if (points.empty() || (distance(points.back(), p) > straight_um && distance(points.front(), p) > straight_um))
      points.push_back(p);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Place before = points[i > 0 ? i - 1 : points.size() - 1], after = points[i + 1 < points.size() ? i + 1 : 0];
    const Place u = unit(before, points[i]), v = unit(points[i], after);
    if (std::abs(cross(before, after, points[i])) > straight_um * distance(before, after) ||
        std::abs(cross(u, v)) > straight || u.x * v.x + u.y * v.y < 0)
      out.push_back(points[i]);
  }
  return out;
}

std::vector<Edge> longest_edges(const std::vector<Place>& ring, std::size_t most) {
  std::vector<Edge> out;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Place a = ring[i], b = ring[i + 1 < ring.size() ? i + 1 : 0];
    out.push_back({distance(a, b), a, unit(a, b)});
  }
  std::stable_sort(out.begin(), out.end(), [](const Edge& a, const Edge& b) { return a.length > b.length; });
  while (most < out.size() && out[most].length > out[most - 1].length - straight_um) ++most;  // none before its equal
  if (out.size() > most) out.resize(most);
  return out;
}

struct ThroughLine {
  Place through, way;
};
bool same(const ThroughLine& l, const ThroughLine& m) {
  return l.through.x == m.through.x && l.through.y == m.through.y && l.way.x == m.way.x && l.way.y == m.way.y;
}

/// Lines that a bead may follow: half-way between two edges, along an edge, and square to one.
std::vector<ThroughLine> lines_through(const std::vector<Place>& ring, Place centre) {
  std::vector<ThroughLine> out;
  for (const Edge& e : longest_edges(ring, most_edges))
    out.insert(out.end(), {{centre, e.way}, {centre, {-e.way.y, e.way.x}}});
  const auto sides = longest_edges(ring, most_sides);
  for (std::size_t i = 0; i < sides.size(); ++i)
    for (std::size_t j = i + 1; j < sides.size(); ++j) {
      const Place u = sides[i].way, v = sides[j].way;
      if (u.x * v.x + u.y * v.y > least_turn_cos) continue;
      const Place way = unit(v, u), n{-way.y, way.x};
      const double a = cross(u, {centre.x - sides[i].a.x, centre.y - sides[i].a.y}),
                   b = cross(v, {centre.x - sides[j].a.x, centre.y - sides[j].a.y});
      const double shift = (b - a) / (cross(u, n) - cross(v, n));  // there it is as far from one as from the other
      out.push_back({{centre.x + shift * n.x, centre.y + shift * n.y}, way});
    }
  return out;
}

}  // namespace

std::vector<Vertex> stub_bead(const std::vector<Place>& outline) {
  const auto ring = corners_of(outline);
  if (ring.size() < 3) return {};
  const Shape shape = shape_of(ring);
  if (shape.area < 1) return {};
  std::optional<Cut> best;
  double best_share = -1e18;
  const auto lines = lines_through(ring, shape.centre);  // parallel edges bring the same ones
  for (auto line = lines.begin(); line != lines.end(); ++line) {
    if (std::any_of(lines.begin(), line, [&](const ThroughLine& l) { return same(l, *line); })) continue;
    const Cut cut(ring, line->through, line->way);
    const double length = std::max(1.0, cut.to - cut.from);
    const double share = cut.covered() / shape.area - breadth_malus * shape.area / (length * length);
    if (share > best_share) best.emplace(cut), best_share = share;
  }
  const Cut& cut = *best;
  const double length = cut.to - cut.from;
  if (length < 4 * before_end_um) return {};
  const int pieces = std::clamp(static_cast<int>(std::ceil(length / step_um)), 1, 200);
  std::vector<Vertex> path;
  for (int i = 0; i <= pieces; ++i) {
    const double x = cut.from + length * i / pieces;
    const auto room = cut.beside(std::clamp(x, cut.from + before_end_um, cut.to - before_end_um));
    path.push_back({cut.at(x), std::max(1.0, room.left + room.right)});
  }
  const double scale = shape.area / area_of(path);
  for (Vertex& v : path) v.width *= scale;
  return path;
}

}  // namespace weft::walls
