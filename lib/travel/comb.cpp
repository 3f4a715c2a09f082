// SPDX-License-Identifier: GPL-3.0-or-later
#include "travel/comb.h"

#include "core/stop.h"
#include "geometry/box_columns.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace weft::travel {
namespace {

/// Direction of a->b, of length 1; no direction where they are one.
struct Direction {
  double x = 0, y = 0;
  bool none = true;
};
Direction direction(Point a, Point b) {
  const double x = static_cast<double>(b.x) - a.x, y = static_cast<double>(b.y) - a.y, length = distance(a, b);
  if (length == 0) return {};
  return {x / length, y / length, false};
}

/// The point moved outwards, to the right of the way that comes and goes so, by about `by_um` from both edges.
Point moved_right(const Direction& comes, Point p, const Direction& goes, double by_um) {
  if (comes.none || goes.none) return p;
  const double nx = comes.y + goes.y, ny = -comes.x - goes.x;  // sum of the unit normals to the right
  const double n2 = nx * nx + ny * ny;
  const double scale = 2.0 * by_um / std::max(n2, 0.5);  // a miter, bounded at sharp corners
  return {rounded(p.x + nx * scale), rounded(p.y + ny * scale)};
}

/// Whether ab runs through cd from one side to the other; running through an end of cd counts, ending on cd does not.
bool cross(Point a, Point b, Point c, Point d) {
  const std::int64_t c_side = orient(a, b, c), d_side = orient(a, b, d);
  if ((c_side > 0 && d_side > 0) || (c_side < 0 && d_side < 0) || (c_side == 0 && d_side == 0)) return false;
  const std::int64_t a_side = orient(c, d, a), b_side = orient(c, d, b);
  return (a_side > 0 && b_side < 0) || (a_side < 0 && b_side > 0);
}

}  // namespace

Comb::Comb(std::vector<Ring> rings) {
  std::erase_if(rings, [](const Ring& r) { return r.size() < 3; });
  std::vector<Box> boxes;
  for (const auto& r : rings) boxes.push_back(box_of(r));
  const geometry::BoxColumns columns(std::move(boxes));
  std::vector<std::uint32_t> depth(rings.size(), 0), parent(rings.size(), outside);
  StopNowAndThen stop(64);
  for (std::size_t i = 0; i < rings.size(); ++i) {
    stop.step();
    columns.each_around(i, [&](std::uint32_t j) {
      if (side_of(rings[j], rings[i][0]) != Side::inside) return;
      ++depth[i];
      const auto size = [&](std::size_t k) { return columns[k].size(); };
      if (parent[i] == outside ||
          std::int64_t{size(j).x} * size(j).y < std::int64_t{size(parent[i]).x} * size(parent[i]).y)
        parent[i] = j;
    });
  }
  std::vector<std::uint32_t> part(rings.size(), 0);
  std::uint32_t parts = 0;
  for (std::size_t i = 0; i < rings.size(); ++i)
    if (depth[i] % 2 == 0) part[i] = parts++;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const bool hole = depth[i] % 2 != 0;
    if ((double_area(rings[i]) > 0) == hole) std::reverse(rings[i].begin(), rings[i].end());
    add_ring(rings[i], hole, part[hole ? parent[i] : i]);
  }
  build_index();
}

Comb::Comb(const Regions& regions) {
  for (std::uint32_t i = 0; i < regions.size(); ++i) {
    add_ring(regions[i].outer, false, i);
    for (const auto& hole : regions[i].holes) add_ring(hole, true, i);
  }
  build_index();
}

void Comb::add_ring(const Ring& ring, bool is_hole, std::uint32_t part) {
  const auto begin = static_cast<std::uint32_t>(points_.size());
  double length = 0;
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (ring[i] == ring[(i + 1) % n]) continue;
    points_.push_back(ring[i]);
    along_.push_back(length);
    length += distance(ring[i], ring[(i + 1) % n]);
  }
  const auto end = static_cast<std::uint32_t>(points_.size());
  if (end - begin < 3) {
    points_.resize(begin), along_.resize(begin);
    return;
  }
  points_.push_back(points_[begin]), along_.push_back(length);  // so that both ends of an edge lie side by side
  ring_of_.resize(points_.size(), static_cast<std::uint32_t>(rings_.size()));
  rings_.push_back({begin, end, part, length, is_hole});
}

void Comb::build_index() {
  if (points_.empty()) return;
  moved_.resize(points_.size());
  for (const auto& ring : rings_) {
    Direction comes = direction(points_[ring.end - 1], points_[ring.begin]);
    for (std::uint32_t i = ring.begin; i < ring.end; ++i) {
      const Direction goes = direction(points_[i], points_[i + 1]);
      moved_[i] = moved_right(comes, points_[i], goes, slack_um);
      comes = goes;
    }
    moved_[ring.end] = moved_[ring.begin];
  }
  box_ = box_of(moved_);
  const double w = box_.size().x + 1.0, h = box_.size().y + 1.0;
  cell_ = std::max<std::int64_t>(500,
                                 static_cast<std::int64_t>(std::sqrt(w * h / static_cast<double>(points_.size()))) + 1);
  columns_ = static_cast<int>(box_.size().x / cell_) + 1;
  rows_ = static_cast<int>(box_.size().y / cell_) + 1;
  const std::size_t cells = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  std::vector<std::uint32_t> count(cells + 1, 0);
  const auto each_cell = [&](std::uint32_t e, const auto& visit) {
    const Point a = moved_[e], b = moved_[e + 1];
    const auto row = [&](std::int64_t y) { return static_cast<int>((y - box_.min.y) / cell_); };
    const auto column = [&](std::int64_t x) { return static_cast<int>((x - box_.min.x) / cell_); };
    const Point low = a.y <= b.y ? a : b, high = a.y <= b.y ? b : a;
    const int r0 = row(low.y), r1 = row(high.y);
    for (int r = r0; r <= r1; ++r) {
      double x0 = low.x, x1 = high.x;
      if (r0 != r1) {
        const double slope = (static_cast<double>(high.x) - low.x) / (static_cast<double>(high.y) - low.y);
        const double y0 = static_cast<double>(box_.min.y) + static_cast<double>(r) * static_cast<double>(cell_);
        if (r > r0) x0 = low.x + slope * (y0 - low.y);
        if (r < r1) x1 = low.x + slope * (y0 + static_cast<double>(cell_) - low.y);
      }
      // One micron to each side covers the rounding.
      const int c0 = std::clamp(column(static_cast<std::int64_t>(std::min(x0, x1)) - 1), 0, columns_ - 1);
      const int c1 = std::clamp(column(static_cast<std::int64_t>(std::max(x0, x1)) + 1), 0, columns_ - 1);
      for (int c = c0; c <= c1; ++c)
        visit(static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(c));
    }
  };
  const auto each_edge = [&](const auto& visit) {
    for (const auto& ring : rings_)
      for (std::uint32_t e = ring.begin; e < ring.end; ++e) visit(e);
  };
  each_edge([&](std::uint32_t e) { each_cell(e, [&](std::size_t c) { ++count[c + 1]; }); });
  for (std::size_t c = 0; c < cells; ++c) count[c + 1] += count[c];
  first_ = count;
  edges_.resize(count[cells]);
  each_edge([&](std::uint32_t e) { each_cell(e, [&](std::size_t c) { edges_[count[c]++] = e; }); });
}

/// Calls visit(edge) for edges near the segment, about from a to b and some twice, until it returns true; returns
/// whether it did.
template <class Visit>
bool Comb::visit_edges(Point a, Point b, const Visit& visit) const {
  if (points_.empty()) return false;
  // A micron or two to each side covers the rounding.
  const Point low = a.y <= b.y ? a : b, high = a.y <= b.y ? b : a;
  const Um bottom = low.y - box_.min.y - 1, top = high.y - box_.min.y + 1;
  if (top < 0 || bottom > box_.size().y) return false;
  const auto cell = static_cast<double>(cell_), cells_a_micron = 1 / cell;
  const auto cells_until = [&](double from_min) { return static_cast<int>(from_min * cells_a_micron); };
  const int r0 = cells_until(std::max(bottom, 0)), r1 = cells_until(std::min(top, box_.size().y));
  const double rise = static_cast<double>(high.y) - low.y;
  const double slope = rise > 0 ? (static_cast<double>(high.x) - low.x) / rise : 0.0;
  const double low_x = static_cast<double>(low.x) - box_.min.x, high_x = static_cast<double>(high.x) - box_.min.x,
               low_y = static_cast<double>(low.y) - box_.min.y, high_y = static_cast<double>(high.y) - box_.min.y,
               width = box_.size().x;
  const bool up = a.y <= b.y, right = a.x <= b.x;
  for (int row = r0; row <= r1; ++row) {
    const int r = up ? row : r0 + r1 - row;
    const double y0 = r * cell, y1 = y0 + cell;
    const double x0 = y0 > low_y ? low_x + slope * (y0 - low_y) : low_x,
                 x1 = y1 < high_y ? low_x + slope * (y1 - low_y) : high_x;
    const double from = std::min(x0, x1) - 2, to = std::max(x0, x1) + 2;
    if (to < 0 || from > width) continue;
    const int c0 = cells_until(std::max(from, 0.0)), c1 = cells_until(std::min(to, width));
    for (int column = c0; column <= c1; ++column) {
      const int c = right ? column : c0 + c1 - column;
      const std::size_t here =
          static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(c);
      for (std::uint32_t k = first_[here]; k < first_[here + 1]; ++k)
        if (visit(edges_[k])) return true;
    }
  }
  return false;
}

bool Comb::sees(Point a, Point b, IgnoredRings ignored) const {
  if (a == b) return true;
  return !visit_edges(
      a, b, [&](std::uint32_t e) { return cross(a, b, moved_[e], moved_[e + 1]) && !ignored.has(ring_of_[e]); });
}

std::uint32_t Comb::part_of(Point p) const {
  const std::uint32_t edge = edge_beside(p);
  if (edge == outside || moved_[edge + 1].y < moved_[edge].y) return outside;  // the inside is left of a rising edge
  return rings_[ring_of_[edge]].part;
}

std::uint32_t Comb::hole_around(Point p) const {
  const std::uint32_t edge = edge_beside(p);
  if (edge == outside || moved_[edge + 1].y > moved_[edge].y || !rings_[ring_of_[edge]].hole) return outside;
  return ring_of_[edge];
}

/// The nearest edge to the right of p, half a micron up where no vertex lies: its direction tells the side.
std::uint32_t Comb::edge_beside(Point p) const {
  if (points_.empty() || !box_.contains(p)) return outside;
  const int row = std::min(rows_ - 1, static_cast<int>((std::int64_t{p.y} - box_.min.y) / cell_));
  const int column = static_cast<int>((std::int64_t{p.x} - box_.min.x) / cell_);
  double nearest = std::numeric_limits<double>::infinity();
  std::uint32_t edge = outside;
  const double y = p.y + 0.5;
  for (int c = column; c < columns_; ++c) {
    const double cell_left = static_cast<double>(box_.min.x) + static_cast<double>(c) * static_cast<double>(cell_);
    if (nearest < cell_left - 2) break;
    const std::size_t cell =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(c);
    for (std::uint32_t k = first_[cell]; k < first_[cell + 1]; ++k) {
      const Point a = moved_[edges_[k]], b = moved_[edges_[k] + 1];
      if ((a.y > p.y) == (b.y > p.y)) continue;
      const double x = a.x + (y - a.y) * (static_cast<double>(b.x) - a.x) / (static_cast<double>(b.y) - a.y);
      if (x >= p.x && (x < nearest || (x == nearest && edges_[k] < edge))) nearest = x, edge = edges_[k];
    }
  }
  return edge;
}

std::optional<Point> Comb::nearest_on_boundary(Point p, Um within) const {
  if (points_.empty()) return std::nullopt;
  double best2 = static_cast<double>(within) * within;
  std::optional<Point> best;
  const auto nearest_on = [&](std::uint32_t e) {
    const Point a = points_[e], b = points_[e + 1];
    const double ux = static_cast<double>(b.x) - a.x, uy = static_cast<double>(b.y) - a.y;
    const double px = static_cast<double>(p.x) - a.x, py = static_cast<double>(p.y) - a.y;
    const double t = std::clamp((px * ux + py * uy) / (ux * ux + uy * uy), 0.0, 1.0);
    const double dx = px - t * ux, dy = py - t * uy;
    if (dx * dx + dy * dy < best2) best2 = dx * dx + dy * dy, best = lerp(a, b, t);
  };
  // Row by row: the cells of each lie side by side. Two microns to each side cover the rounding.
  const std::int64_t x = std::int64_t{p.x} - box_.min.x, y = std::int64_t{p.y} - box_.min.y, reach = within + 2;
  const std::int64_t left = std::max<std::int64_t>(0, (x - reach) / cell_),
                     right = x + reach < 0 ? -1 : std::min<std::int64_t>(columns_ - 1, (x + reach) / cell_);
  const std::int64_t low = std::max<std::int64_t>(0, (y - within) / cell_),
                     high = std::min<std::int64_t>(rows_ - 1, (y + within) / cell_);
  for (std::int64_t row = low; row <= high && left <= right; ++row) {
    const std::int64_t begin = row * columns_;
    for (std::uint32_t k = first_[static_cast<std::size_t>(begin + left)],
                       end = first_[static_cast<std::size_t>(begin + right + 1)];
         k < end; ++k)
      nearest_on(edges_[k]);
  }
  return best;
}

void Comb::hits(Point p, Point q, IgnoredRings ignored, std::vector<Hit>& out) const {
  out.clear();
  visit_edges(p, q, [&](std::uint32_t e) {
    const Point a = moved_[e], b = moved_[e + 1];
    if (!ignored.has(ring_of_[e]) && cross(p, q, a, b)) out.push_back({crossed_at(p, q, a, b), e});
    return false;
  });
  std::sort(out.begin(), out.end(),
            [](const Hit& a, const Hit& b) { return a.t < b.t || (a.t == b.t && a.edge < b.edge); });
  out.erase(std::unique(out.begin(), out.end(), [](const Hit& a, const Hit& b) { return a.edge == b.edge; }),
            out.end());
}

void Comb::walk(Polyline& way, std::uint32_t from_edge, std::uint32_t to_edge, Point from, Point to) const {
  const auto& ring = rings_[ring_of_[from_edge]];
  const double s = along_[from_edge] + distance(points_[from_edge], from),
               e = along_[to_edge] + distance(points_[to_edge], to);
  double ahead = e - s;
  if (ahead < 0) ahead += ring.length;
  way.push_back(from);
  if (ahead <= ring.length / 2) {
    if (from_edge != to_edge || e < s)
      for (std::uint32_t k = next(from_edge);; k = next(k)) {
        way.push_back(points_[k]);
        if (k == to_edge) break;
      }
  } else {
    const std::uint32_t stop = next(to_edge);
    if (from_edge != to_edge || e > s)
      for (std::uint32_t k = from_edge;; k = k == ring.begin ? ring.end - 1 : k - 1) {
        way.push_back(points_[k]);
        if (k == stop) break;
      }
  }
  way.push_back(to);
}

Polyline Comb::along_rings(Point p, Point q, const std::vector<Hit>& found) const {
  Polyline way{p};
  for (std::size_t i = 0; i < found.size();) {
    const std::uint32_t ring = ring_of_[found[i].edge];
    std::size_t last = i;
    for (std::size_t k = i + 1; k < found.size(); ++k)
      if (ring_of_[found[k].edge] == ring) last = k;
    const auto on_boundary = [&](const Hit& h) {
      const Point at = lerp(p, q, h.t), a = points_[h.edge], b = points_[h.edge + 1];
      const double ux = static_cast<double>(b.x) - a.x, uy = static_cast<double>(b.y) - a.y;
      const double t =
          ((static_cast<double>(at.x) - a.x) * ux + (static_cast<double>(at.y) - a.y) * uy) / (ux * ux + uy * uy);
      return lerp(a, b, std::clamp(t, 0.0, 1.0));
    };
    if (last > i) walk(way, found[i].edge, found[last].edge, on_boundary(found[i]), on_boundary(found[last]));
    i = last + 1;
  }
  way.push_back(q);
  return way;
}

bool Comb::pull_taut(Polyline& way, IgnoredRings ignored) const {
  Polyline taut{way.front()};
  std::size_t at = 0;
  while (at + 1 < way.size()) {
    stop_if_asked();
    std::size_t reach = at + 1, step = 1;
    while (true) {  // gallop as far as one sees, then halve
      const std::size_t probe = std::min(reach + step, way.size() - 1);
      if (probe == reach) break;
      if (sees(way[at], way[probe], ignored)) {
        reach = probe, step *= 2;
      } else if (step == 1) {
        break;
      } else {
        step = std::max<std::size_t>(1, step / 4);
      }
    }
    if (reach == at + 1 && !sees(way[at], way[reach], ignored)) return false;
    taut.push_back(way[reach]);
    at = reach;
  }
  way = std::move(taut);
  return true;
}

std::optional<Polyline> Comb::way(Point p, Point q, IgnoredRings ignored) const {
  if (sees(p, q, ignored)) return Polyline{q};
  std::vector<Hit> found;
  hits(p, q, ignored, found);
  Polyline way = along_rings(p, q, found);
  if (!pull_taut(way, ignored)) return std::nullopt;
  // A second pass from the other end straightens what the greedy first one left bent.
  std::reverse(way.begin(), way.end());
  if (!pull_taut(way, ignored)) return std::nullopt;
  std::reverse(way.begin(), way.end());
  way.erase(way.begin());
  return way;
}

}  // namespace weft::travel
