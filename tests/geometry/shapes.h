// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "rectangle.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

/// Shapes for laws, the same for one seed on every machine.
namespace shapes {
using namespace weft;
using weft::test::rectangle;

class Dice {
 public:
  explicit Dice(std::uint32_t seed) : engine_(seed) {}
  double share() { return static_cast<double>(engine_()) / 4294967296.0; }
  Um between(Um low, Um high) { return low + static_cast<Um>(engine_() % static_cast<std::uint32_t>(high - low + 1)); }

 private:
  std::mt19937 engine_;
};

/// A simple polygon, star-shaped about the centre, with spikes and dents.
inline Ring star(Dice& dice, Point centre, Um radius, int corners) {
  Ring ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.8 * dice.share()) / corners,
                 r = radius * (0.2 + 0.8 * dice.share());
    ring.push_back(centre + Point{rounded(r * std::cos(angle)), rounded(r * std::sin(angle))});
  }
  return ring;
}

/// A convex polygon: points on a circle.
inline Ring convex(Dice& dice, Point centre, Um radius, int corners) {
  Ring ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.8 * dice.share()) / corners;
    ring.push_back(centre + Point{rounded(radius * std::cos(angle)), rounded(radius * std::sin(angle))});
  }
  return ring;
}

inline Ring reversed(Ring ring) {
  return {ring.rbegin(), ring.rend()};
}

}  // namespace shapes
