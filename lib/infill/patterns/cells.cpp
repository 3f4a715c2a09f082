// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/patterns/cells.h"

#include "core/disjoint_sets.h"
#include "core/stop.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <queue>
#include <tuple>

namespace weft::infill {
namespace {

constexpr double reach = 3.2;      // cells: no farther site borders on one
constexpr double shortest = 0.08;  // of a cell's side: a shorter border is a corner where four meet
constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

}  // namespace

std::vector<Corner> cell_of(const std::vector<Site>& sites, std::size_t site, int tile) {
  const Site& own = sites[site];
  constexpr double box = reach / 2;
  std::vector<Corner> cell{{{own.x - box, own.y - box}},
                           {{own.x + box, own.y - box}},
                           {{own.x + box, own.y + box}},
                           {{own.x - box, own.y + box}}};
  std::vector<Corner> left;
  for (std::size_t j = 0; j < sites.size() && !cell.empty(); ++j) {
    if (j == site) continue;
    const double dx = sites[j].x - own.x, dy = sites[j].y - own.y;
    const double nx = dx - tile * std::round(dx / tile), ny = dy - tile * std::round(dy / tile);
    if (std::hypot(nx, ny) > reach) continue;
    // |p|² − w ≤ |p − n|² − w' where p is from the site: 2 p·n ≤ n² + w − w'
    const double bound = (nx * nx + ny * ny + own.weight - sites[j].weight) / 2;
    const auto over = [&](Turned t) { return (t.x - own.x) * nx + (t.y - own.y) * ny - bound; };
    left.clear();
    for (std::size_t k = 0; k < cell.size(); ++k) {
      const Turned a = cell[k].at, b = cell[(k + 1) % cell.size()].at;
      const double at_a = over(a), at_b = over(b);
      if (at_a <= 0) left.push_back({a});
      if ((at_a <= 0) != (at_b <= 0)) {
        const double t = at_a / (at_a - at_b);
        left.push_back({{std::lerp(a.x, b.x, t), std::lerp(a.y, b.y, t)}});
      }
    }
    std::swap(cell, left);
  }
  return cell;
}

CellWalls::CellWalls(std::vector<Site> sites, int tile) : tile_(tile) {
  find(sites);
  draw_some_twice();
  pair_up();
  merge_loops();
}

/// Corners that lie almost on each other are one.
void CellWalls::find(const std::vector<Site>& sites) {
  std::vector<std::vector<Corner>> cells;
  std::vector<Turned> all;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    stop_if_asked();
    cells.push_back(cell_of(sites, i, tile_));
    for (const Corner& c : cells.back()) all.push_back(c.at);
  }
  const double tile = tile_;
  const auto wrapped = [&](double v) { return v - tile * std::floor(v / tile); };
  // those of a cell that are near each other, and those of different cells, by the places of a grid
  DisjointSets sets(all.size());
  std::map<std::pair<int, int>, std::vector<std::uint32_t>> grid;
  const int places = static_cast<int>(std::floor(tile / shortest));
  const auto place_of = [&](double v) { return static_cast<int>(wrapped(v) / tile * places) % places; };
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    const int x = place_of(all[i].x), y = place_of(all[i].y);
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const auto found = grid.find({(x + dx + places) % places, (y + dy + places) % places});
        if (found == grid.end()) continue;
        for (const std::uint32_t j : found->second) {
          const double ox = all[i].x - all[j].x, oy = all[i].y - all[j].y;
          if (std::hypot(ox - tile * std::round(ox / tile), oy - tile * std::round(oy / tile)) < shortest)
            sets.join(i, j);
        }
      }
    grid[{x, y}].push_back(i);
  }
  std::vector<std::uint32_t> number(all.size(), none);
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    const std::size_t s = sets.of(i);
    if (number[s] != none) continue;
    number[s] = static_cast<std::uint32_t>(corners_.size());
    corners_.push_back({wrapped(all[s].x), wrapped(all[s].y)});
  }
  std::map<std::tuple<std::uint32_t, std::uint32_t, int, int>, bool> known;
  std::uint32_t index = 0;
  for (const std::vector<Corner>& cell : cells) {
    const auto n = static_cast<std::uint32_t>(cell.size());
    for (std::uint32_t k = 0; k < n; ++k) {
      const std::uint32_t i = index + k, j = index + (k + 1) % n;
      std::uint32_t u = number[sets.of(i)], v = number[sets.of(j)];
      const auto tiles = [&](double at, double corner) { return static_cast<int>(std::round((at - corner) / tile)); };
      int wx = tiles(all[j].x, corners_[v].x) - tiles(all[i].x, corners_[u].x),
          wy = tiles(all[j].y, corners_[v].y) - tiles(all[i].y, corners_[u].y);
      if (u == v && wx == 0 && wy == 0) continue;
      if (v < u) std::swap(u, v), wx = -wx, wy = -wy;
      if (!known.emplace(std::tuple{u, v, wx, wy}, true).second) continue;
      walls_.push_back(
          {u, v, wx, wy,
           std::hypot(corners_[v].x + tile * wx - corners_[u].x, corners_[v].y + tile * wy - corners_[u].y), false});
    }
    index += n;
  }
}

/// The shortest walls between corners with an odd number of them first; what is left over is paired by the shortest
/// way.
void CellWalls::draw_some_twice() {
  std::vector<std::vector<std::uint32_t>> at(corners_.size());
  for (std::uint32_t w = 0; w < walls_.size(); ++w) at[walls_[w].u].push_back(w), at[walls_[w].v].push_back(w);
  std::vector<bool> odd(corners_.size());
  for (std::size_t c = 0; c < corners_.size(); ++c) odd[c] = at[c].size() % 2 == 1;
  std::vector<std::uint32_t> order(walls_.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return walls_[a].length < walls_[b].length; });
  for (const std::uint32_t w : order) {
    Wall& wall = walls_[w];
    if (wall.u != wall.v && odd[wall.u] && odd[wall.v]) wall.twice = true, odd[wall.u] = odd[wall.v] = false;
  }
  for (std::uint32_t start = 0; start < corners_.size(); ++start) {
    if (!odd[start]) continue;
    stop_if_asked();
    constexpr double far = std::numeric_limits<double>::infinity();
    std::vector<double> way(corners_.size(), far);
    std::vector<std::uint32_t> by(corners_.size(), none);
    std::priority_queue<std::pair<double, std::uint32_t>, std::vector<std::pair<double, std::uint32_t>>, std::greater<>>
        open;
    open.emplace(way[start] = 0, start);
    std::uint32_t end = none;
    while (!open.empty()) {
      const auto [d, c] = open.top();
      open.pop();
      if (d > way[c]) continue;
      if (c != start && odd[c]) {
        end = c;
        break;
      }
      for (const std::uint32_t w : at[c]) {
        const std::uint32_t other = walls_[w].u == c ? walls_[w].v : walls_[w].u;
        // a wall that is drawn twice already is drawn once then
        const double next = d + (walls_[w].twice ? 0 : walls_[w].length);
        if (next < way[other]) way[other] = next, by[other] = w, open.emplace(next, other);
      }
    }
    if (end == none) continue;
    odd[start] = odd[end] = false;
    for (std::uint32_t c = end; c != start;) {
      Wall& wall = walls_[by[c]];
      wall.twice = !wall.twice;
      c = wall.u == c ? wall.v : wall.u;
    }
  }
}

double CellWalls::angle_of(LineEnd end) const {
  const Wall& wall = walls_[end / 4];
  const double dx = corners_[wall.v].x + tile_ * wall.wrap_x - corners_[wall.u].x,
               dy = corners_[wall.v].y + tile_ * wall.wrap_y - corners_[wall.u].y;
  return end % 2 == 0 ? std::atan2(dy, dx) : std::atan2(-dy, -dx);
}

/// Ends that are neighbours around a corner are joined there: so no line crosses another.
void CellWalls::pair_up() {
  at_corner_.resize(corners_.size());
  for (std::uint32_t w = 0; w < walls_.size(); ++w)
    for (std::uint32_t side = 0; side < (walls_[w].twice ? 2U : 1U); ++side)
      for (std::uint32_t end = 0; end < 2; ++end) {
        const LineEnd e = 4 * w + 2 * side + end;
        at_corner_[corner_of(e)].push_back(e);
      }
  shifted_.assign(corners_.size(), false);
  partner_.assign(4 * walls_.size(), none);
  for (std::size_t c = 0; c < corners_.size(); ++c) {
    std::vector<LineEnd>& ends = at_corner_[c];
    // of the two along one wall the right one comes first: that is side 1 seen from u, side 0 from v
    const auto key = [&](LineEnd e) { return std::pair{angle_of(e), ((e >> 1U) ^ e ^ 1U) & 1U}; };
    std::sort(ends.begin(), ends.end(), [&](LineEnd a, LineEnd b) { return key(a) < key(b); });
    const auto turns_back = [&](std::size_t first) {
      int count = 0;
      for (std::size_t k = first; k < ends.size() + first; k += 2)
        count += ends[k % ends.size()] / 4 == ends[(k + 1) % ends.size()] / 4 ? 1 : 0;
      return count;
    };
    if (ends.size() % 2 != 0) continue;  // a border that could not be found from both sides
    shifted_[c] = turns_back(1) < turns_back(0);
    for (std::size_t k = shifted_[c] ? 1 : 0; k < ends.size() + (shifted_[c] ? 1 : 0); k += 2) {
      const LineEnd a = ends[k % ends.size()], b = ends[(k + 1) % ends.size()];
      partner_[a] = b, partner_[b] = a;
    }
  }
}

/// Where two loops meet in a corner of four ends, these may be paired the other way: the two are then one.
void CellWalls::merge_loops() {
  DisjointSets loops(2 * walls_.size());
  for (LineEnd e = 0; e < partner_.size(); ++e)
    if (partner_[e] != none) loops.join(e / 2, partner_[e] / 2);
  for (const std::vector<LineEnd>& ends : at_corner_) {
    if (ends.size() != 4 || partner_[ends[0]] == none) continue;
    if (loops.of(ends[0] / 2) == loops.of(ends[2] / 2)) continue;
    loops.join(ends[0] / 2, ends[2] / 2);
    const bool with_next = partner_[ends[0]] == ends[1];
    const std::array<std::pair<LineEnd, LineEnd>, 2> pairs =
        with_next ? std::array{std::pair{ends[1], ends[2]}, std::pair{ends[3], ends[0]}}
                  : std::array{std::pair{ends[0], ends[1]}, std::pair{ends[2], ends[3]}};
    for (const auto& [a, b] : pairs) partner_[a] = b, partner_[b] = a;
  }
}

/// The other end of the same line.
CellWalls::Place CellWalls::across(Place at) const {
  const Wall& wall = walls_[at.end / 4];
  const int way = at.end % 2 == 0 ? 1 : -1;
  return {at.end ^ 1U, at.x + way * wall.wrap_x, at.y + way * wall.wrap_y};
}

/// From one end of a line to the other; lines side by side stand half a band off, and back from the corner.
void CellWalls::add_line(Place from, double band, double cell, Curve& to) const {
  const Place until = across(from);
  const auto place = [&](const Place& p) {
    const Turned c = corners_[corner_of(p.end)];
    return Turned{(c.x + p.x * tile_) * cell, (c.y + p.y * tile_) * cell};
  };
  const Turned a = place(from), b = place(until);
  const Wall& wall = walls_[from.end / 4];
  if (!wall.twice) {
    for (const Turned t : {a, b}) to.points.push_back(t);
    return;
  }
  const double length = std::max(std::hypot(b.x - a.x, b.y - a.y), 1.0);
  const double dx = (b.x - a.x) / length, dy = (b.y - a.y) / length, back = std::min(0.75 * band, 0.3 * length);
  const bool left = (from.end & 2U) == 0, forward = from.end % 2 == 0;
  const double side = (left == forward ? 0.5 : -0.5) * band;
  to.points.push_back({a.x + dx * back - dy * side, a.y + dy * back + dx * side});
  to.points.push_back({b.x - dx * back - dy * side, b.y - dy * back + dx * side});
}

Drawing CellWalls::drawn(const PatternPlace& p, double cell) const {
  const double tile = tile_ * cell;
  const auto tiles = [&](double v) { return static_cast<int>(std::floor(v / tile)); };
  const int x0 = tiles(p.area.min.x) - 1, y0 = tiles(p.area.min.y) - 1, nx = tiles(p.area.max.x) + 2 - x0,
            ny = tiles(p.area.max.y) + 2 - y0;
  const auto inside = [&](const Place& at) { return at.x >= x0 && at.x < x0 + nx && at.y >= y0 && at.y < y0 + ny; };
  // a line belongs to the tile of its wall's corner u
  const auto line_of = [&](Place at) {
    const Place u = at.end % 2 == 0 ? at : across(at);
    return std::pair{u, static_cast<std::size_t>((u.y - y0) * nx + u.x - x0) * 2 * walls_.size() + u.end / 2};
  };
  std::vector<bool> done(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) * 2 * walls_.size(), false);
  Drawing out{.pitch = cell / 2};
  for (int y = y0; y < y0 + ny; ++y)
    for (int x = x0; x < x0 + nx; ++x)
      for (LineEnd e = 0; e < partner_.size(); e += 2) {
        if ((e & 2U) != 0 && !walls_[e / 4].twice) continue;
        const Place start{e, x, y};
        if (done[line_of(start).second]) continue;
        stop_if_asked();
        // back to where it comes from outside, or once around
        Place first = start;
        bool closed = false;
        for (;;) {
          const LineEnd before = partner_[first.end];
          if (before == none) break;
          const Place previous = across({before, first.x, first.y});
          if (!inside(line_of(previous).first)) break;
          first = previous;
          if (first.end == start.end && first.x == start.x && first.y == start.y) {
            closed = true;
            break;
          }
        }
        Curve& curve = out.curves.emplace_back();
        curve.closed = closed;
        for (Place at = first;;) {
          const auto [u, line] = line_of(at);
          if (!inside(u) || done[line]) break;
          done[line] = true;
          add_line(at, p.band, cell, curve);
          const Place end = across(at);
          if (partner_[end.end] == none) break;
          at = {partner_[end.end], end.x, end.y};
        }
      }
  return out;
}

}  // namespace weft::infill
