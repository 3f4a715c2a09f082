// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/level_set.h"

#include <limits>

namespace weft::infill {
namespace {

constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();

/// Edges of the grid that a curve crosses, each with the next one on the curve. Rows of cells are looked at one after
/// the other, so that only crossed edges are kept.
class Tracer {
 public:
  Tracer(const LevelGrid& grid, const std::vector<double>& values)
      : grid_(grid),
        values_(values),
        signs_{std::vector<std::uint8_t>(grid.columns), std::vector<std::uint8_t>(grid.columns)},
        along_x_{std::vector<std::uint32_t>(grid.columns), std::vector<std::uint32_t>(grid.columns)},
        along_y_(grid.columns) {}

  std::vector<Curve> run() {
    find_row(0);
    for (std::size_t j = 0; j + 1 < grid_.rows; ++j) {
      std::swap(signs_[0], signs_[1]), std::swap(along_x_[0], along_x_[1]);
      find_row(j + 1);
      find_between(j);
      const std::vector<std::uint8_t>&lower = signs_[0], &upper = signs_[1];
      for (std::size_t i = 0; i + 1 < grid_.columns; ++i)
        if (const int up = lower[i] + lower[i + 1] + upper[i] + upper[i + 1]; up != 0 && up != 4) look_at(i, j);
    }
    std::vector<Curve> out;
    for (const bool closed : {false, true})
      for (std::uint32_t axis = 0; axis < 2; ++axis)
        for (std::uint32_t k = 0; k < crossed_[axis].size(); ++k)
          if (const Crossed& e = crossed_[axis][k]; e.next != nobody && (closed || !e.entered))
            follow(2 * k + axis, closed, out);
    return out;
  }

 private:
  /// An edge; others name it by twice its number, and one more when it runs along y.
  struct Crossed {
    Turned at;
    std::uint32_t next = nobody;
    bool entered = false;  ///< by a curve that has crossed another edge before
  };
  double value(std::size_t i, std::size_t j) const { return values_[j * grid_.columns + i]; }
  Crossed& edge(std::uint32_t name) { return crossed_[name % 2][name / 2]; }

  std::uint32_t add(std::uint32_t axis, Turned at) {
    crossed_[axis].push_back({at});
    return static_cast<std::uint32_t>(2 * (crossed_[axis].size() - 1) + axis);
  }
  static double share(double a, double b) { return a != b ? a / (a - b) : 0.5; }

  /// Signs of a row of nodes, and the edges between them.
  void find_row(std::size_t j) {
    const double* row = &values_[j * grid_.columns];
    std::vector<std::uint8_t>& up = signs_[1];
    for (std::size_t i = 0; i < up.size(); ++i) up[i] = row[i] > 0;
    for (std::size_t i = 0; i + 1 < up.size(); ++i)
      if (up[i] != up[i + 1])
        along_x_[1][i] = add(0, {grid_.x(i) + share(row[i], row[i + 1]) * grid_.step, grid_.y(j)});
  }
  /// The edges from one row to the next.
  void find_between(std::size_t j) {
    const std::vector<std::uint8_t>&lower = signs_[0], &upper = signs_[1];
    for (std::size_t i = 0; i < lower.size(); ++i)
      if (lower[i] != upper[i])
        along_y_[i] = add(1, {grid_.x(i), grid_.y(j) + share(value(i, j), value(i, j + 1)) * grid_.step});
  }

  /// Joins the crossed edges of a cell, the positive corners on the left. Pre: some are positive and some not
  void look_at(std::size_t i, std::size_t j) {
    // edges counter-clockwise from the lower one; corner k lies before edge k
    const std::array edges{along_x_[0][i], along_y_[i + 1], along_x_[1][i], along_y_[i]};
    const std::array<double, 4> v{value(i, j), value(i + 1, j), value(i + 1, j + 1), value(i, j + 1)};
    std::array<bool, 4> up{};
    std::size_t count = 0;
    for (std::size_t k = 0; k < 4; ++k) up[k] = v[k] > 0, count += up[k] ? 1U : 0U;
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
      edge(edges[k]).next = edges[in], edge(edges[in]).entered = true;
    }
  }

  void follow(std::uint32_t start, bool closed, std::vector<Curve>& out) {
    stop_if_asked();
    Curve& curve = out.emplace_back();
    curve.closed = closed;
    for (std::uint32_t e = start; e != nobody;) {
      curve.points.push_back(edge(e).at);
      e = std::exchange(edge(e).next, nobody);
      if (e == start) break;
    }
  }

  const LevelGrid& grid_;
  const std::vector<double>& values_;
  std::array<std::vector<std::uint8_t>, 2> signs_;     // of the row below, and of this
  std::array<std::vector<std::uint32_t>, 2> along_x_;  // edges of both, by column; of those that are crossed
  std::vector<std::uint32_t> along_y_;                 // edges between them
  std::array<std::vector<Crossed>, 2> crossed_;        // along x, along y; by row, then by column
};

}  // namespace

std::vector<Curve> zero_curves(const LevelGrid& grid, const std::vector<double>& values) {
  return Tracer(grid, values).run();
}

}  // namespace weft::infill
