// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/gyroid.h"

#include "core/stop.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace weft::infill {
namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr double mean_length = 15.4468;  // of the curves in a cell of 2π × 2π, over all heights; integrated numerically
constexpr int steps = 96;                // a period: chords stand off by 0.1 % of it at most

/// One height of the surface with period 2π.
struct Slice {
  double sin_z, cos_z;
  bool over_x;  ///< curves are graphs y(x); else x(y)

  explicit Slice(double z) : sin_z(std::sin(z)), cos_z(std::cos(z)), over_x(std::abs(cos_z) >= std::abs(sin_z)) {}

  /// The branches (0 and 1) at t; each repeats every 2π in t and in value.
  double at(double t, int branch) const {
    double q = 0, phase = 0;
    if (over_x) {
      q = -sin_z * std::cos(t) / std::hypot(cos_z, std::sin(t));
      // the angle whose jump lies where cos z never is, so that the curve is in one piece
      phase = cos_z > 0 ? std::atan2(std::sin(t), cos_z) : std::numbers::pi + std::atan2(-std::sin(t), -cos_z);
    } else {
      q = -std::sin(t) * cos_z / std::hypot(std::cos(t), sin_z);
      phase = std::atan2(sin_z, std::cos(t));
    }
    const double angle = std::asin(std::clamp(q, -1.0, 1.0));
    return (branch == 0 ? angle : std::numbers::pi - angle) - phase;
  }
};

}  // namespace

std::vector<std::vector<Turned>> gyroid_curves(const Span2& area, double period, double z_um) {
  const Slice slice(z_um / period * turn);
  const double unit = period / turn;
  const auto along = [&](Turned t) { return (slice.over_x ? t.x : t.y) / unit; };
  const auto across = [&](Turned t) { return (slice.over_x ? t.y : t.x) / unit; };
  const auto first = static_cast<long>(std::floor(along(area.min) / turn * steps)) - 1;
  const auto last = static_cast<long>(std::ceil(along(area.max) / turn * steps)) + 1;
  std::vector<std::vector<Turned>> curves;
  for (int branch = 0; branch < 2; ++branch) {
    std::array<double, steps> values{};
    for (std::size_t i = 0; i < steps; ++i) values[i] = slice.at(turn * static_cast<double>(i) / steps, branch);
    const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
    const auto from = static_cast<long>(std::floor((across(area.min) - *greatest) / turn));
    const auto to = static_cast<long>(std::ceil((across(area.max) - *least) / turn));
    for (long k = from; k <= to; ++k) {
      stop_if_asked();
      std::vector<Turned>& curve = curves.emplace_back();
      curve.reserve(static_cast<std::size_t>(last - first + 1));
      for (long i = first; i <= last; ++i) {
        const double t = turn * static_cast<double>(i) / steps * unit;
        const double v =
            (values[static_cast<std::size_t>(((i % steps) + steps) % steps)] + turn * static_cast<double>(k)) * unit;
        curve.push_back(slice.over_x ? Turned{t, v} : Turned{v, t});
      }
    }
  }
  return curves;
}

double gyroid_period(double band_um, double density) {
  return band_um * mean_length / (turn * density);
}

}  // namespace weft::infill
