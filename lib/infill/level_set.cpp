// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/level_set.h"

#include <limits>

namespace weft::infill {
namespace {

constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();

/// Edges of the grid that a curve crosses, each with the one before and the one after on the curve.
class Tracer {
 public:
  Tracer(const LevelGrid& grid, const std::vector<double>& values)
      : grid_(grid),
        values_(values),
        count_(grid.columns * grid.rows),
        next_(2 * count_, nobody),
        before_(2 * count_, nobody) {}

  std::vector<Curve> run() {
    for (std::size_t j = 0; j + 1 < grid_.rows; ++j)
      for (std::size_t i = 0; i + 1 < grid_.columns; ++i) look_at(i, j);
    std::vector<Curve> out;
    for (std::uint32_t e = 0; e < next_.size(); ++e)
      if (next_[e] != nobody && before_[e] == nobody) follow(e, false, out);
    for (std::uint32_t e = 0; e < next_.size(); ++e)
      if (next_[e] != nobody) follow(e, true, out);
    return out;
  }

 private:
  double value(std::size_t i, std::size_t j) const { return values_[j * grid_.columns + i]; }
  std::uint32_t along_x(std::size_t i, std::size_t j) const {
    return static_cast<std::uint32_t>(j * grid_.columns + i);
  }
  std::uint32_t along_y(std::size_t i, std::size_t j) const {
    return static_cast<std::uint32_t>(count_ + j * grid_.columns + i);
  }

  /// Joins the crossed edges of a cell, the positive corners on the left.
  void look_at(std::size_t i, std::size_t j) {
    // edges counter-clockwise from the lower one; corner k lies before edge k
    const std::array edges{along_x(i, j), along_y(i + 1, j), along_x(i, j + 1), along_y(i, j)};
    const std::array<double, 4> v{value(i, j), value(i + 1, j), value(i + 1, j + 1), value(i, j + 1)};
    std::array<bool, 4> up{};
    std::size_t count = 0;
    for (std::size_t k = 0; k < 4; ++k) up[k] = v[k] > 0, count += up[k] ? 1U : 0U;
    if (count == 0 || count == 4) return;
    const bool saddle = count == 2 && up[0] == up[2];
    const bool middle = v[0] + v[1] + v[2] + v[3] > 0;
    for (std::size_t k = 0; k < 4; ++k) {
      // a curve comes in over an edge from positive to other, seen counter-clockwise
      if (!up[k] || up[(k + 1) % 4]) continue;
      // and goes out where the positive corners begin; across the middle, if that is positive
      std::size_t in = (k + 3) % 4;
      if (!saddle) {
        while (up[in]) in = (in + 3) % 4;
      } else if (middle) {
        in = (k + 1) % 4;
      }
      link(edges[k], edges[in]);
    }
  }
  void link(std::uint32_t from, std::uint32_t to) { next_[from] = to, before_[to] = from; }

  Turned place(std::uint32_t edge) const {
    const bool horizontal = edge < count_;
    const std::size_t node = horizontal ? edge : edge - count_, i = node % grid_.columns, j = node / grid_.columns;
    const double a = value(i, j), b = horizontal ? value(i + 1, j) : value(i, j + 1);
    const double t = a != b ? a / (a - b) : 0.5;
    return {grid_.x(i) + (horizontal ? t * grid_.step : 0), grid_.y(j) + (horizontal ? 0 : t * grid_.step)};
  }

  void follow(std::uint32_t start, bool closed, std::vector<Curve>& out) {
    stop_if_asked();
    Curve& curve = out.emplace_back();
    curve.closed = closed;
    for (std::uint32_t e = start; e != nobody;) {
      curve.points.push_back(place(e));
      e = std::exchange(next_[e], nobody);
      if (e == start) break;
    }
  }

  const LevelGrid& grid_;
  const std::vector<double>& values_;
  std::size_t count_;
  std::vector<std::uint32_t> next_, before_;  // by edge: those along x, then those along y
};

}  // namespace

std::vector<Curve> zero_curves(const LevelGrid& grid, const std::vector<double>& values) {
  return Tracer(grid, values).run();
}

}  // namespace weft::infill
