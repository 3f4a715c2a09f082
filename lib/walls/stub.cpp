#include "walls/stub.h"

#include <algorithm>
#include <cmath>

namespace weft::walls {
namespace {

using Vertex = Line::Vertex;

constexpr std::size_t most_edges = 12;  // so many of a ring's longest edges are tried as directions
constexpr int looks = 16;               // chords by which directions are compared
constexpr double alike = 1e-3;          // shares that differ by less are equal: then the longer way is taken
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

/// A line through a ring: how far it lies inside, and how much room there is beside it.
class Cut {
 public:
  Cut(const std::vector<Place>& ring, Place through, Place way) : ring_(ring), o_(through), u_(way) {
    double behind = -1e18, ahead = 1e18;
    each_crossing(0, u_, [&](double t) { t < 0 ? behind = std::max(behind, t) : ahead = std::min(ahead, t); });
    from = behind < -1e17 ? 0 : behind, to = ahead > 1e17 ? 0 : ahead;
  }
  double from = 0, to = 0;

  struct Room {
    double left = 0, right = 0;
  };
  Room beside(double x) const {
    double left = 1e18, right = 1e18;
    each_crossing(x, {-u_.y, u_.x}, [&](double t) { t < 0 ? right = std::min(right, -t) : left = std::min(left, t); });
    return left > 1e17 || right > 1e17 ? Room{} : Room{left, right};
  }

  /// Share of the area that a bead of even sides covers.
  double covered(double area) const {
    double sum = 0;
    for (int i = 0; i < looks; ++i) {
      const Room room = beside(from + (i + 0.5) * (to - from) / looks);
      sum += 2 * std::min(room.left, room.right);
    }
    return sum * (to - from) / looks / area;
  }

 private:
  /// Where the ring crosses the line through the place x on this one, in direction v.
  template <class F>
  void each_crossing(double x, Place v, F f) const {
    const Place p{o_.x + x * u_.x, o_.y + x * u_.y};
    for (std::size_t i = 0; i < ring_.size(); ++i) {
      if (const auto t = meets(p, v, ring_[i], ring_[i + 1 < ring_.size() ? i + 1 : 0])) f(*t);
    }
  }

  const std::vector<Place>& ring_;
  Place o_, u_;
};

/// Directions of the longest edges, and square to them.
std::vector<Place> directions(const std::vector<Place>& ring) {
  std::vector<std::pair<double, Place>> edges;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Place a = ring[i], b = ring[i + 1 < ring.size() ? i + 1 : 0];
    edges.push_back({distance(a, b), unit(a, b)});
  }
  std::stable_sort(edges.begin(), edges.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  if (edges.size() > most_edges) edges.resize(most_edges);
  std::vector<Place> out;
  for (const auto& [length, way] : edges) out.insert(out.end(), {way, {-way.y, way.x}});
  return out;
}

}  // namespace

std::vector<Vertex> stub_bead(const std::vector<Place>& ring) {
  if (ring.size() < 3) return {};
  const Shape shape = shape_of(ring);
  if (shape.area < 1) return {};
  Place best{1, 0};
  double best_share = -1e18, best_length = 0;
  for (const Place way : directions(ring)) {
    const Cut cut(ring, shape.centre, way);
    const double length = cut.to - cut.from;
    const double share = cut.covered(shape.area) - breadth_malus * shape.area / std::max(1.0, length * length);
    const bool same = std::abs(share - best_share) <= alike, same_length = std::abs(length - best_length) <= 1;
    if (same ? (same_length ? std::abs(way.x) > std::abs(best.x) + alike : length > best_length) : share > best_share)
      best = way, best_share = share, best_length = length;
  }
  const Cut cut(ring, shape.centre, best);
  const double length = cut.to - cut.from;
  if (length < 4 * before_end_um) return {};
  const int pieces = std::clamp(static_cast<int>(std::ceil(length / step_um)), 1, 200);
  std::vector<Vertex> path;
  for (int i = 0; i <= pieces; ++i) {
    const double x = cut.from + length * i / pieces;
    const auto room = cut.beside(std::clamp(x, cut.from + before_end_um, cut.to - before_end_um));
    path.push_back({{shape.centre.x + x * best.x, shape.centre.y + x * best.y}, std::max(1.0, room.left + room.right)});
  }
  const double scale = shape.area / area_of(path);
  for (Vertex& v : path) v.width *= scale;
  return path;
}

}  // namespace weft::walls
