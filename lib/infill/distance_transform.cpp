// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/distance_transform.h"

#include <cstddef>
#include <limits>

namespace weft::infill {

void lower_envelope(const std::vector<double>& f, std::vector<double>& out) {
  const std::size_t n = f.size();
  std::vector<std::size_t> foot(n);
  std::vector<double> from(n + 1);
  std::size_t k = 0;
  constexpr double far = std::numeric_limits<double>::infinity();
  const auto meet = [&](std::size_t p, std::size_t q) {
    const auto a = static_cast<double>(p), b = static_cast<double>(q);
    return ((f[q] + b * b) - (f[p] + a * a)) / (2 * (b - a));
  };
  from[0] = -far, from[1] = far;
  for (std::size_t q = 1; q < n; ++q) {
    double s = meet(foot[k], q);
    while (k > 0 && s <= from[k]) s = meet(foot[--k], q);
    if (s <= from[k]) s = from[k];
    foot[++k] = q, from[k] = s, from[k + 1] = far;
  }
  k = 0;
  for (std::size_t q = 0; q < n; ++q) {
    while (from[k + 1] < static_cast<double>(q)) ++k;
    const double d = static_cast<double>(q) - static_cast<double>(foot[k]);
    out[q] = d * d + f[foot[k]];
  }
}

}  // namespace weft::infill
