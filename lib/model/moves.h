// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/tolerances.h"
#include "model/plan.h"

#include <cmath>
#include <cstddef>
#include <span>

/// Which moves a bead is printed with: what the writer writes, and what the estimate of time counts.
namespace weft {

/// A move to junction `to`, from where the last one ended, printed as the piece that ends at junction `piece` is.
struct BeadMove {
  std::size_t piece, to;
  double volume_mm3;  ///< of all pieces since the last move
};

/// Calls `f` for each move of a path, in order: each piece, but those of no length and those that
/// tolerances::least_move tells of. Pre: at least two junctions. Post: the last ends at the path's last place, no
/// junction lies further off than `straight_um`, the volumes sum up to that of all pieces.
template <class F>
void for_each_move(std::span<const Junction> path, double height_mm, F f) {
  constexpr double straight_um = 1;
  const std::size_t last = path.size() - 1;
  const auto length = [&](std::size_t i) { return distance(path[i - 1].at, path[i].at); };
  const auto straight = [&](std::size_t from, std::size_t to) {  // past the junctions in between, at most two
    const Point a = path[from].at, b = path[to].at;
    const double x = static_cast<double>(b.x - a.x), y = static_cast<double>(b.y - a.y), length2 = x * x + y * y;
    double before = 0;
    for (std::size_t i = from + 1; i < to; ++i) {
      const double u = static_cast<double>(path[i].at.x - a.x), v = static_cast<double>(path[i].at.y - a.y);
      const double off = u * y - v * x, along = u * x + v * y;
      if (off * off >= straight_um * straight_um * length2 || along <= before || along >= length2) return false;
      before = along;
    }
    return true;
  };
  double volume = 0, here = length(1);
  for (std::size_t from = 0, i = 1; i <= last; ++i) {
    double ahead = i < last ? length(i + 1) : 0;
    volume += here / 1000.0 * mean_area_mm2(path[i - 1], path[i], height_mm);
    if (from + 1 == i && i < last && here <= tolerances::least_move && straight(from, i + 1)) {
      here = ahead;
      continue;
    }
    std::size_t to = i;
    if (i < last && ahead <= tolerances::least_move && straight(from, i + 1) &&
        (i + 1 == last || !straight(i, i + 2))) {
      to = i + 1;
      volume += ahead / 1000.0 * mean_area_mm2(path[i], path[to], height_mm);
      ahead = to < last ? length(to + 1) : 0;
    }
    if (path[from].at != path[to].at) {
      f(BeadMove{i, to, volume});
      volume = 0;
    }
    here = ahead;
    from = i = to;
  }
}

/// The same for a bead: `f` for each straight move, `on_arc(arc, volume_mm3)` for each of its arcs, in order.
template <class F, class G>
void for_each_move(const Extrude& bead, F f, G on_arc) {
  const double height_mm = to_mm(bead.height);
  const std::span<const Junction> path(bead.path);
  if (bead.arcs.empty()) return for_each_move(path, height_mm, f);
  std::size_t at = 0;
  const auto straight_to = [&](std::size_t to) {
    if (to > at)
      for_each_move(path.subspan(at, to - at + 1), height_mm, [&](BeadMove move) {
        move.piece += at, move.to += at;
        f(move);
      });
  };
  for (const Arc& arc : bead.arcs) {
    straight_to(arc.first);
    double volume = 0;
    for (std::size_t i = arc.first + std::size_t{1}; i <= arc.last; ++i)
      volume += distance(path[i - 1].at, path[i].at) / 1000.0 * mean_area_mm2(path[i - 1], path[i], height_mm);
    on_arc(arc, volume);
    at = arc.last;
  }
  straight_to(path.size() - 1);
}

}  // namespace weft
