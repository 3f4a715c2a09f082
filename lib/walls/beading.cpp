// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/beading.h"

#include "model/flow.h"

#include <algorithm>

namespace weft::walls {
namespace {

constexpr double lattice_um = 1;  // a rib's sides are rounded to the lattice, half a micron each

double nominal(const Widths& w, int pair) {
  return pair == 0 ? w.outer : w.inner;
}

/// Nominal thickness of that many pairs.
double nominal_pairs(const Widths& w, int pairs) {
  return pairs <= 0 ? 0 : 2 * (w.outer + (pairs - 1) * w.inner);
}

constexpr double least_volume_um3 = 1e7;  // 0.01 mm³: a nozzle that travels oozes more

}  // namespace

Widths widths_of(const WallSettings& s, Um nozzle, Um height, std::size_t layer) {
  Widths w;
  const Um outermost = length_or(s.wall_line_width_0, nozzle, flow::automatic_outer_width(nozzle));
  w.outer = flow::spacing(outermost, height, s.overlap_factor);
  if (s.wall_outline == WallOutline::widest) w.bulge = rounded(flow::bulge_um(outermost, height, s.overlap_factor));
  w.inner = flow::spacing(length_or(s.wall_line_width_x, nozzle, flow::automatic_width(nozzle, height)), height,
                          s.overlap_factor);
  const auto band_of = [&](const LengthOrShare& width) {
    return flow::spacing(width.of(nozzle), height, s.overlap_factor);
  };
  const double most = std::max<double>(band_of(s.max_wall_line_width), std::max(w.outer, w.inner));
  w.least_even = std::min<double>(band_of(s.min_even_wall_line_width.value_or(s.min_wall_line_width)), most / 2);
  w.least_odd = std::min<double>(band_of(s.min_odd_wall_line_width.value_or(s.min_wall_line_width)), 2 * w.least_even);
  // A bead is not split in two that each were too thin to lie steadily, or to be laid at all.
  const double stable = s.flow_compensation ? std::max<double>(s.min_output_width, w.outer / 4) : s.min_feature_size;
  w.least_even = std::min(std::max(w.least_even, stable), most / 2);
  w.least_odd = std::min(std::max(w.least_odd, stable), 2 * w.least_even);
  w.most = most;
  w.open = std::min(0.8 * w.inner, 2 * (most - w.inner) + w.inner / 2);
  w.least_area = least_volume_um3 / height;
  w.least_feature = s.min_feature_size - 2.0 * w.bulge - lattice_um;
  w.walls = s.wall_line_count + (s.alternate_extra_wall && layer % 2 == 1 ? 1 : 0);
  w.shared = std::max(1, s.wall_distribution_count);
  return w;
}

double threshold(const Widths& w, int less) {
  if (less == 0) return w.least_feature;
  const int pairs = less / 2;
  const double around = nominal_pairs(w, pairs);
  if (less % 2 == 1) return around + std::min(2 * w.least_even, w.most);
  const double added = pairs == w.walls ? w.open : w.least_odd;
  return std::min(around + added, nominal_pairs(w, pairs - 1) + 2 * w.most);
}

Count count_for(const Widths& w, double thickness, bool even) {
  const int most = 2 * w.walls;
  int n = 0;
  // Skip what is certainly there, then walk up the thresholds.
  const double pair = 2 * std::max(w.outer, w.inner);
  n = std::clamp(2 * static_cast<int>(thickness / pair - 2), 0, most);
  if (n == 0 && thickness >= threshold(w, 0)) n = 1;
  while (n > 0 && n <= most && thickness >= threshold(w, n)) ++n;
  if (n == 0) return {0, false};
  if (n > most) return {w.walls, true};
  if (even && n > 1 && n % 2 == 1) --n;
  return {n / 2, n % 2 == 1};
}

double reach_of(const Widths& w) {
  return threshold(w, 2 * w.walls) / 2;
}

void bounds_for(const Widths& w, Count count, double half, double* bounds) {
  const int pairs = count.pairs;
  bounds[0] = 0;
  if (pairs == 0) return;
  // Only the innermost pairs share the difference; the outer wall is among them when it is alone.
  int sharing = is_open(w, count) ? 0 : std::min(w.shared - (count.middle ? 1 : 0), pairs - 1);
  if (pairs == 1 && !count.middle) sharing = 1;
  double taken = 0;
  for (int i = 0; i < pairs; ++i) taken += nominal(w, i);
  double share = 0, middle = 0, scale = 1;
  if (count.middle && !is_open(w, count)) {
    const double least = 0.5 * w.least_odd;
    share = std::max((2 * (half - taken) - w.inner) / (1 + 2 * sharing), least - w.inner);
    middle = w.inner + share;
  } else if (!count.middle) {
    const double least = 0.5 * w.least_even - (pairs == 1 ? w.outer : w.inner);
    share = std::max((half - taken) / sharing, least);
  }
  taken += sharing * share;
  if (2 * taken + middle > 2 * half) scale = half / (taken + middle / 2);  // too thin: all shrink alike
  double at = 0;
  for (int i = 0; i < pairs; ++i) {
    at += scale * (nominal(w, i) + (i >= pairs - sharing ? share : 0));
    bounds[i + 1] = at;
  }
  if (!count.middle) bounds[pairs] = half;
}

}  // namespace weft::walls
