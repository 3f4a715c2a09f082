// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/joists.h"

#include "geometry/clip_lines.h"
#include "geometry/delaunay.h"
#include "geometry/offset.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
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

}  // namespace

void clip_joists(Joists& joists, Um line) {
  if (joists.lines.empty()) return;
  const Regions inside = geometry::offset(joists.area, {.by = -line * 8 / 10});  // their ends lie on the loop
  std::vector<Polyline> left;
  for (auto& piece : geometry::clip_lines(joists.lines, inside))
    if (length_of(piece.line) >= line) left.push_back(std::move(piece.line));
  joists.lines = std::move(left);
}

Joists joists_between(Regions area, const std::vector<Point>& tips, const JoistStyle& style) {
  Joists out{std::move(area), {}};
  if (out.area.empty()) return out;
  Chosen chosen(tips, style);
  for (const auto& triangle : geometry::delaunay(tips)) chosen.take(triangle);
  out.lines = chosen.lines();
  clip_joists(out, style.line);
  return out;
}

}  // namespace weft::support
