// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "walls/trace.h"

#include <cstdint>
#include <vector>

/// Private to walls: what a bead on the axis has to fill, and the bead that does.
namespace weft::walls {

/// The area between the walls on both sides of a stretch of the axis, tips included. Parts that branch off end at their
/// mouths, which are sides of it too.
class Strip {
 public:
  /// Adds a point of the axis; `free` is half the width that is there.
  void add_axis(Place at, double free);
  /// … where all of the strip bends at once.
  void add_bend(Place at, double free);
  /// Adds a point of the outline right (left) of the axis, beside the axis' last point.
  void add_right(Place at) { right_.push_back({at, tag()}); }
  void add_left(Place at) { left_.push_back({at, tag()}); }
  /// Outline beyond the first (last) point of the axis, from left to right (right to left).
  std::vector<Place> first_tip, last_tip;
  bool first_pointed = false, last_pointed = false;  ///< the sides meet there
  double skip_first = 0, skip_last = 0;              ///< the bead begins (ends) so far inside the axis' ends, µm
  /// What is skipped is not the strip's own: a wall turns back there.
  bool turn_first = false, turn_last = false;
  bool closed = false;   ///< the axis ends where it begins
  bool outline = false;  ///< its sides are the part's outline: no end may reach beyond

  /// Centreline and widths of the bead that fills it: chords across the strip, at right angles to the axis.
  std::vector<Line::Vertex> bead();

 private:
  struct Point {
    Place at;
    std::uint32_t tag;  ///< the point of the axis it lies beside
  };
  struct Side {
    Place a, b;
    std::uint32_t tag;
  };
  struct Chord {
    Place left, right;
    bool found = false;
  };
  /// What bounds the strip straight on from a place near an end of the axis: how far it is, and which way it runs; 0 if
  /// nothing does.
  struct Ahead {
    double reach = 0;
    Place edge{};
  };
  std::uint32_t tag() const { return axis_.empty() ? 0 : static_cast<std::uint32_t>(axis_.size() - 1); }
  bool stubby() const;
  std::vector<Place> ring() const;
  void collect_sides();
  void lean();
  double area() const;
  Place at(double s, std::size_t& edge) const;
  Place direction(double s, double over) const;
  double free_at(double s) const;
  Chord across(Place p, Place way, double s, double free) const;
  Ahead ahead(Place p, Place way, bool first) const;
  double end_straight(bool first, std::vector<Line::Vertex>& out) const;
  void sample(double from, double to, std::vector<double>& out) const;
  void add(std::vector<Line::Vertex>& path, const Chord& chord, Place on_axis, Place way, double free);

  std::vector<Place> axis_;
  std::vector<double> free_, along_, bends_;  ///< bends: where along the axis
  std::vector<Point> right_, left_;
  std::vector<Side> sides_;           ///< by tag
  std::vector<std::uint32_t> first_;  ///< of each tag in sides_
  Chord last_;
  bool first_leans_ = false, last_leans_ = false;
};

}  // namespace weft::walls
