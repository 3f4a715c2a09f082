// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/groups/retraction.h"

#include <deque>

namespace weft::travel {

/// Counts retractions within a length of filament, so that the feeder does not grind one piece down.
class RetractionWindow {
 public:
  explicit RetractionWindow(const RetractionSettings& settings) : settings_(settings) {}

  void feed(double filament_mm) { fed_mm_ += filament_mm; }

  /// Whether one more is within the limit. Counts it when it is.
  bool take() {
    if (!settings_.retraction_count_max) return true;
    while (!taken_.empty() && fed_mm_ - taken_.front() > to_mm(settings_.retraction_extrusion_window))
      taken_.pop_front();
    if (taken_.size() >= static_cast<std::size_t>(*settings_.retraction_count_max)) return false;
    taken_.push_back(fed_mm_);
    return true;
  }

 private:
  const RetractionSettings& settings_;
  double fed_mm_ = 0;
  std::deque<double> taken_;  ///< where the filament was at each retraction that still counts
};

}  // namespace weft::travel
