// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/plan.h"

#include <utility>
#include <vector>

namespace weft::motion {

/// Steps of a layer in the making, and how long each of them takes.
struct TimedSteps {
  std::vector<Step> steps{};
  std::vector<float> seconds{};

  void add(Step step, float s) {
    steps.push_back(std::move(step));
    seconds.push_back(s);
  }
  /// What takes no time.
  void add(Step step) { add(std::move(step), 0.F); }
};

/// A bead in two, at one of its junctions. Pre: it is neither of its ends, nor within an arc.
std::pair<Extrude, Extrude> split(Extrude bead, std::size_t junction);

}  // namespace weft::motion
