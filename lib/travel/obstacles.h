// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "travel/travel.h"

#include <cstdint>
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
  /// Cost: what stands between the two, and what stands beside that.
  std::optional<Polyline> way(Point p, Point q) const;

 private:
  /// What stands so near to each other that no way leads between.
  struct Cluster {
    std::vector<std::size_t> of;  ///< what_
    Box reach;                    ///< with what is kept off
    mutable Regions kept_off{};   ///< made when a way asks for it
  };
  const Regions& kept_off(const Cluster& cluster) const;
  bool leaves_freely(const Cluster& cluster, Point p) const;
  bool is_open() const;
  std::vector<std::uint32_t> between(Point p, Point q) const;
  std::optional<Polyline> way_round(Point p, Point q, const std::vector<std::uint32_t>& between) const;
  Comb round_clusters(const Box& box) const;
  const Comb& around() const;

  const TravelSettings& settings_;
  const LayerInput& input_;
  Regions what_;
  std::vector<char> convex_;            ///< beside what_
  std::vector<Cluster> clusters_;       ///< they do not meet
  bool open_;                           ///< all of them stand free in a convex room
  mutable std::size_t gathered_ = 0;    ///< so many clusters were looked at for single ways
  mutable std::optional<Comb> around_;  ///< all of a layer: made when ways ask for much of it, or the room is not open
};

}  // namespace weft::travel
