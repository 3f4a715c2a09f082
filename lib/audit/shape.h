// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "audit/path.h"
#include "core/polygon.h"

#include <array>
#include <vector>

namespace weft::audit {

/// The sides of a volume, in the order of `side_names`.
enum class Side { minus_x, plus_x, minus_y, plus_y, minus_z, plus_z, no_go, none };

/// The side that a direction points to: its greater component.
constexpr Side side_towards(Vec d) {
  if ((d.x < 0 ? -d.x : d.x) >= (d.y < 0 ? -d.y : d.y)) return d.x < 0 ? Side::minus_x : Side::plus_x;
  return d.y < 0 ? Side::minus_y : Side::plus_y;
}

/// By how much a path is where it should not be, mm; not positive when it is not.
struct Excess {
  double mm = -1;
  Vec at{};                ///< of its centreline
  Side side = Side::none;  ///< where it is worst; of equal ones, where the path as a whole is further out
  std::array<double, 4> by_side{-1, -1, -1, -1};  ///< mm beyond −x, +x, −y, +y
};

/// A disc or a simple polygon, also concave.
class Shape {
 public:
  static Shape disc(Vec centre, double radius_mm);
  /// Pre: simple, at least three corners; either way round.
  static Shape polygon(const Ring& ring);

  /// How far the path, grown by `margin_mm` (half a bead), leaves the shape. The whole path is judged: a segment
  /// between two inside points that cuts a concave corner leaves it. O(corners).
  Excess leaving(const Path& path, double margin_mm) const;

  /// How deep the path, grown by `margin_mm`, enters the shape. Pre: a polygon. `side` is Side::no_go.
  Excess entering(const Path& path, double margin_mm) const;

  /// The path without its first stretch outside of the shape: from where it first enters. Only its end when it never
  /// does. Pre: straight.
  Path from_inside(const Path& path) const;

  bool convex() const { return convex_; }
  /// Is it a rectangle along the axes?
  bool box() const;

  const Bounds& bounds() const { return bounds_; }

  /// A box that lies wholly inside, as large as a scaled bounding box can be; empty when the middle is not inside.
  Bounds inner_box() const;

 private:
  struct Edge {
    Vec a, b;
    Vec outward;    ///< unit normal
    double offset;  ///< outward · a
  };
  bool holds(Vec p) const;
  double distance_to_outline(Vec p, Vec& nearest) const;
  Excess beyond_edges(const Path& path, double margin_mm) const;
  Excess beyond_disc(const Path& path, double margin_mm) const;
  Excess worst_stretch(const Path& path, double margin_mm, bool inside) const;
  Excess worst_between_meetings(const Path& path, bool inside) const;
  Excess deepest(const Path& path, double from, double to) const;

  bool convex_ = true;
  bool disc_ = false;
  Vec centre_;
  double radius_mm_ = 0;
  std::vector<Edge> edges_;
  Bounds bounds_;
};

}  // namespace weft::audit
