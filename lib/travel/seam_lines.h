// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "travel/travel.h"

#include <cstdint>
#include <deque>
#include <span>
#include <utility>
#include <vector>

namespace weft::travel {

/// The seams of all layers. A wall stands on the wall below whose box is most like its own, and the seams of walls that
/// stand on each other are a line. It costs what hides it, layer by layer, and how far it steps aside: of lines that
/// are to be aligned the cheapest is found by dynamic programming, so that a corner that lasts wins over one that is
/// sharper for a while. Sequential; layers can be prepared meanwhile.
class SeamLines {
 public:
  explicit SeamLines(const TravelSettings& settings) : settings_(settings) {}

  /// The next layer. It stays where it is until all are chosen. Cost: a look along each wall for each place where a
  /// line may well pass it, which are a few.
  void add(const Prepared& layer);
  /// Of each layer, beside Prepared::seams. Post: there are no layers.
  std::vector<std::vector<Start>> chosen();

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFF;

  /// Where a line may pass a wall.
  struct Place {
    Start start;
    float own_um = 0;   ///< what it costs itself
    float cost_um = 0;  ///< of the best line up to it; at last of all lines from it upwards
  };
  struct Wall {
    const Bead* bead = nullptr;
    const Comb* bearing = nullptr;     ///< what it can lie on; null: no matter
    std::uint32_t begin = 0, end = 0;  ///< of its places
    std::uint32_t below = none;        ///< the wall it stands on
  };
  /// What was last printed of a stack.
  struct Top {
    const Prepared* layer = nullptr;
    std::vector<std::uint32_t> walls;  ///< of the last layer that had some
    std::vector<Box> boxes;            ///< beside them
  };
  struct Question {
    const TravelSettings& settings;
    std::span<const Corner> corners;
    Um height;
  };

  /// Anywhere on the wall where it hangs no more than it may, if there is such a place.
  static Start random_place(const Wall& wall, std::uint64_t seed);
  std::pair<std::uint32_t, float> onward(const Wall& wall, Point from) const;
  void add_places(const Wall& wall, const Question& ask);

  const TravelSettings& settings_;
  std::deque<Wall> walls_;    // of all layers; there are many, and a vector would have room for twice as many
  std::deque<Place> places_;  // of all walls
  std::vector<const Prepared*> layers_;
  std::vector<Top> tops_;  // by stack
};

}  // namespace weft::travel
