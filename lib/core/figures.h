// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cmath>
#include <string>

/// Figures as people read them.
namespace weft {

/// A thousandth is beyond what any figure of a report means.
inline double rounded3(double v) {
  return std::round(v * 1000) / 1000;
}

/// The two greatest units: "42 s", "5m 03s", "1h 05m". Half a second counts as one.
std::string short_duration(double seconds);

}  // namespace weft
