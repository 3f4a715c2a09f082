// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "geometry/clipper_door.h"
#include "geometry/offset.h"

#include <cmath>
#include <cstdint>
#include <vector>

/// What offsets are made of; private to geometry/.
namespace weft::geometry {

/// Draws the raw offset curve of rings: it may cross itself; what it winds around positively is the offset region.
///
/// How it works: each edge moves sideways. Where two that follow each other part, a corner is put between them, whose
/// chords are moved edges as well; where they fold over each other, they end where they cross. One of which its
/// neighbours leave nothing goes, as long as they cross beyond it: what lies nearest to it lies between it and there.
/// Where one is too short and cannot go the curve runs by way of the corners themselves, in loops that wind negatively.
/// Each of those crosses whatever is near, so that finding crossings takes longer than all else.
class OffsetCurve {
 public:
  OffsetCurve(const OffsetOptions& options, Point origin);

  /// Pre: three points at least, none as the one before it.
  clipper::FineRing of(const Ring& ring);

 private:
  struct Vector {
    double x = 0, y = 0;
    friend Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y}; }
    friend Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y}; }
    friend Vector operator*(double s, Vector v) { return {s * v.x, s * v.y}; }
  };
  /// An edge that has moved, or a chord of a corner; µm from the origin.
  struct Side {
    Vector corner;  ///< of the ring, where the edge began
    Vector from;    ///< where it is now
    Vector along;   ///< of length 1
    double length = 0;
    bool folds = false;  ///< over the next; else they join
    Vector joint{};
    double begin = 0, end = 0;            ///< what is left of it, along it
    std::uint32_t before = 0, after = 0;  ///< of those that are left
    bool gone = false;
    bool mixed = false;   ///< there are corners between it and the next
    bool takes = false;   ///< what another swept over that is gone
    bool looped = false;  ///< by way of the corners to the next that is left
    Vector at(double along_by) const { return from + along_by * along; }
  };
  static double dot_of(Vector a, Vector b) { return a.x * b.x + a.y * b.y; }
  static double cross_of(Vector a, Vector b) { return a.x * b.y - a.y * b.x; }
  static double length_of(Vector v) { return std::sqrt(dot_of(v, v)); }
  Vector moved(Vector along) const { return {by_ * along.y, -by_ * along.x}; }

  std::uint32_t next(std::uint32_t side) const { return side + 1 < sides_.size() ? side + 1 : 0; }
  bool folds(Vector before, Vector after) const { return cross_of(before, after) * by_ < 0; }
  void read(const Ring& ring);
  void link();
  void add_chords();
  void fan(Vector corner, Vector before, Vector after);
  struct Meeting {
    double on_first, on_second;
  };
  Meeting meeting(std::uint32_t first, std::uint32_t second) const;
  void meet(std::uint32_t first, std::uint32_t second);
  bool cross(std::uint32_t first) const;
  static bool lies_beside(Vector at, const Side& side);
  static bool beside(const Side& side, const Side& other);
  bool stays(const Side& s) const;
  bool goes(std::uint32_t side);
  void let_go();
  void part(std::uint32_t first);
  void put_from(std::uint32_t first);
  void put(Vector at);

  OffsetOptions options_;
  Point origin_;
  double by_;
  double arc_step_rad_ = 0;
  std::vector<Side> sides_;
  std::vector<Vector> fan_;           ///< the corners of a corner
  std::vector<std::uint32_t> asked_;  ///< sides that may go
  clipper::FineRing curve_;
};

}  // namespace weft::geometry
