// SPDX-License-Identifier: GPL-3.0-or-later
// Curves that visit every cell of a square once: one root square an object, of which only blocks near the area are
// walked, so that all areas and layers have pieces of one and the same curve.
#include "infill/pattern.h"

#include <algorithm>
#include <cmath>

namespace weft::infill {
namespace {

/// Cells along a curve, in runs that are not interrupted.
class Walk {
 public:
  Walk(const PatternPlace& p, long side) : cell_(p.spacing()), half_(static_cast<double>(side) / 2), area_(p.area) {}

  bool meets(double x, double y, double size) const {
    const double left = (x - half_) * cell_, low = (y - half_) * cell_, wide = size * cell_;
    return left <= area_.max.x + cell_ && left + wide >= area_.min.x - cell_ && low <= area_.max.y + cell_ &&
           low + wide >= area_.min.y - cell_;
  }
  /// The cell whose corner has these coordinates.
  void visit(double x, double y) {
    if (interrupted_) out_.curves.emplace_back();
    interrupted_ = false;
    std::vector<Turned>& points = out_.curves.back().points;
    const Turned at{(x + 0.5 - half_) * cell_, (y + 0.5 - half_) * cell_};
    if (points.size() >= 2) {  // straight on
      const Turned a = points[points.size() - 2], b = points.back();
      if (std::abs((b.x - a.x) * (at.y - b.y) - (b.y - a.y) * (at.x - b.x)) < 1e-6 * cell_ * cell_) points.pop_back();
    }
    points.push_back(at);
  }
  void interrupt() { interrupted_ = true; }
  Drawing drawing() && {
    out_.pitch = cell_;
    return std::move(out_);
  }

 private:
  double cell_, half_;
  Span2 area_;
  Drawing out_;
  bool interrupted_ = true;
};

/// A block of a Hilbert curve: from its corner it goes along `u`, over to `v` and back. u and v are its sides.
void hilbert(double x, double y, double ux, double uy, double vx, double vy, int order, Walk& walk) {
  const double left = std::min({x, x + ux + vx, x + ux, x + vx}), low = std::min({y, y + uy + vy, y + uy, y + vy});
  if (!walk.meets(left, low, std::max(std::abs(ux + vx), std::abs(uy + vy)))) return walk.interrupt();
  if (order == 0) return walk.visit(left, low);
  const double hux = ux / 2, huy = uy / 2, hvx = vx / 2, hvy = vy / 2;
  hilbert(x, y, hvx, hvy, hux, huy, order - 1, walk);
  hilbert(x + hux, y + huy, hux, huy, hvx, hvy, order - 1, walk);
  hilbert(x + hux + hvx, y + huy + hvy, hux, huy, hvx, hvy, order - 1, walk);
  hilbert(x + hux + vx, y + huy + vy, -hvx, -hvy, -hux, -huy, order - 1, walk);
}

/// A block of a Peano curve, from one corner to the one opposite. Turned along its diagonal it begins and ends at the
/// same places: a checkerboard of such blocks runs as much one way as the other.
/// @param flip_x, flip_y  where it begins
void peano(double x, double y, double size, bool flip_x, bool flip_y, bool transposed, Walk& walk) {
  if (!walk.meets(x, y, size)) return walk.interrupt();
  if (size < 1.5) return walk.visit(x, y);
  const double third = size / 3;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      const int back = a % 2 == 0 ? b : 2 - b;
      int i = transposed ? back : a, j = transposed ? a : back;
      // where a column is walked backwards, blocks are mirrored along it; every second along a column across it
      const bool mirror_x = j % 2 == 1, mirror_y = i % 2 == 1;
      const bool other = (i + j) % 2 == 1;
      if (flip_x) i = 2 - i;
      if (flip_y) j = 2 - j;
      peano(x + i * third, y + j * third, third, flip_x != mirror_x, flip_y != mirror_y, transposed != other, walk);
    }
}

/// The least power of `base` that is as many cells as the object is wide.
std::pair<int, long> root(const PatternPlace& p, long base) {
  const double wanted = 2 * std::max(p.reach, p.spacing()) / p.spacing() + 2;
  int order = 0;
  long side = 1;
  for (; static_cast<double>(side) < wanted; ++order) side *= base;
  return {order, side};
}

}  // namespace

Drawing draw_hilbert(const PatternPlace& p) {
  const auto [order, side] = root(p, 2);
  const auto whole = static_cast<double>(side);
  Walk walk(p, side);
  hilbert(0, 0, whole, 0, 0, whole, order, walk);
  return std::move(walk).drawing();
}

Drawing draw_peano(const PatternPlace& p) {
  const auto [order, side] = root(p, 3);
  Walk walk(p, side);
  peano(0, 0, static_cast<double>(side), false, false, false, walk);
  return std::move(walk).drawing();
}

}  // namespace weft::infill
