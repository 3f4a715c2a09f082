// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/column_steps.h"

#include "support/lengths.h"

#include <algorithm>

namespace weft::support {
namespace {

/// Directions of a pattern's lines; 0: they do not lie across those of the same pattern at half its share. Rings run
/// along each other, and waves of a gyroid cross others where it happens.
int directions(SupportPattern pattern) {
  switch (pattern) {
    case SupportPattern::lines:
    case SupportPattern::zigzag:
      return 1;
    case SupportPattern::grid:
      return 2;
    case SupportPattern::triangles:
      return 3;
    case SupportPattern::concentric:
    case SupportPattern::gyroid:
      break;
  }
  return 0;
}

}  // namespace

Um line_distance(SupportPattern pattern, Um band, double share) {
  return rounded(std::max(directions(pattern), 1) * band / share);
}

Um least_half(SupportPattern pattern, Um band, const std::vector<double>& shares, std::size_t step) {
  return step == 0 ? hollow_column(band, shares.front()) : line_distance(pattern, band, shares[step]) * 3 / 4;
}

std::vector<double> column_shares(const SupportSettings& settings, Um nozzle, Um band) {
  std::vector<double> out{settings.support_infill_rate / 100};
  const int ways = directions(settings.support_pattern);
  // Conical columns lose the ends of their lines on the way down: those across would be lost as a whole.
  if (ways == 0 || out.front() <= 0 || settings.support_conical_enabled) return out;
  const double least = static_cast<double>(ways) * band / (between_feet(nozzle) + line_width(settings, nozzle));
  constexpr double worth = 0.75;  // a step that leaves more of the lines is none
  for (int i = 0; i < settings.gradual_support_infill_steps; ++i) {
    const double next = std::max(out.back() / 2, least);
    if (next > worth * out.back()) break;
    out.push_back(next);
  }
  return out;
}

Um first_step(const SupportSettings& settings) {
  return settings.gradual_support_infill_step_height +
         (settings.support_roof_enable ? settings.support_roof_height : 0);
}

}  // namespace weft::support
