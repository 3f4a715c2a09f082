// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <vector>

namespace weft::support {

/// How wide a column is where it bends most easily, µm: the lesser side of a rectangle that is as stiff (√12 times the
/// least radius of gyration). Bent walls are stiffer than straight ones. Pre: it has an area.
/// Source: C. Steger 1996, "On the calculation of arbitrary moments of polygons", eqs. 29–36.
double stiff_width_um(const Region& region);

/// Lets columns get wider downwards that would be too slender to stand while a nozzle strokes over them.
class Steady {
 public:
  /// @param line  width of a bead
  explicit Steady(Um line) : line_(line) {}

  /// What columns hold at that height.
  void begin(const Regions& contacts, Um z);
  /// At that height, at or below all that they hold. Steps are coarse, so that most levels are alike.
  /// @return whether any got wider
  bool widen(Um z, Regions& columns) const;

 private:
  struct Top {
    Box box;
    Um z;
  };
  Um line_;
  std::vector<Top> tops_;
};

}  // namespace weft::support
