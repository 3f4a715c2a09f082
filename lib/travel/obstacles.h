// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "travel/travel.h"

#include <optional>
#include <vector>

namespace weft::travel {

/// Where the nozzle may go at all; nothing where any straight way between two places of the room stays in it.
Regions free_area(const Room& room);

/// What travels go round: other parts and support, where that is asked for. For one thread.
class Obstacles {
 public:
  /// The arguments must outlive it.
  Obstacles(const TravelSettings& settings, const LayerInput& input);

  /// A short way that keeps travel_avoid_distance from what stands between two places, as the points after p; straight
  /// where nothing does. Nothing where none was found, or nothing is to be gone round.
  std::optional<Polyline> way(Point p, Point q) const;

 private:
  bool nothing_between(Point p, Point q) const;
  bool leaves_freely(std::size_t i, Point p) const;
  const Comb& around() const;

  const TravelSettings& settings_;
  const LayerInput& input_;
  Regions what_;
  std::vector<Box> reach_;  ///< of each of them, with what is kept off
  std::vector<char> convex_;
  mutable std::optional<Comb> around_;  ///< made when something stands between: in most layers nothing does
};

}  // namespace weft::travel
