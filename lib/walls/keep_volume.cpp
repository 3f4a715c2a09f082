// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/keep_volume.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace weft::walls {
namespace {

constexpr double most = 0.05;  // of a width is changed: beyond, something was left out on purpose
// So much of the volume may lack or be too much. Walls side by side are worth more when even; a bead alone has none
// beside it.
constexpr double tolerated = 0.003, tolerated_alone = 0.002;
constexpr int most_rounds = 4;
constexpr Um single_gain = 4;  // so much a single bead may gain: it has the outline on both sides

bool is_single(const Bead& bead) {
  return bead.inset == 0 && !bead.closed;
}

/// As wide as each junction may get, bead by bead.
std::vector<Um> widest_of(const Beads& beads, Um widest, bool dab) {
  std::vector<Um> out;
  for (const Bead& bead : beads)
    for (const Junction& j : bead.path)
      out.push_back(is_single(bead) && !dab ? std::min(widest, j.width + single_gain) : widest);
  return out;
}

/// What beads cover: their volume at a height of 1 mm.
double laid_mm2(const Beads& beads) {
  double sum = 0;
  for (const Bead& bead : beads) sum += volume_mm3(bead, 1_mm);
  return sum;
}

void scale(double by, const std::vector<Um>& widest, Beads& beads) {
  std::size_t i = 0;
  for (Bead& bead : beads)
    for (Junction& j : bead.path) {
      const Um widest_here = widest[i++];
      if (j.flow < 1.F)
        j.flow = std::min(1.F, static_cast<float>(j.flow * by));
      else
        j.width = std::min(widest_here, rounded(j.width * by));
    }
}

}  // namespace

void keep_volume(double wanted, Um widest, bool dab, Beads& beads) {
  const double tolerance = std::all_of(beads.begin(), beads.end(), is_single) ? tolerated_alone : tolerated;
  const auto right = [&](double laid) { return laid <= 0 || std::abs(wanted / laid - 1) <= tolerance; };
  double laid = laid_mm2(beads);
  if (right(laid)) return;
  const auto limits = widest_of(beads, widest, dab);
  // Again, for beads that are as wide as they may be do not take their share.
  for (int round = 0; round < most_rounds && !right(laid); ++round, laid = laid_mm2(beads)) {
    const double ratio = wanted / laid;
    const double by = std::clamp(ratio > 1 ? ratio - tolerance : ratio + tolerance, 1 - most, 1 + most);
    scale(by, limits, beads);
  }
}

}  // namespace weft::walls
