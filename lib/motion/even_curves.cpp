// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/even_curves.h"

#include "motion/kinematics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace weft::motion {
namespace {

constexpr std::size_t least_moves = 3;
constexpr double longest_mm = 10;
/// Cosines of 0.1° and of 30°: what turns by less is straight, what turns by more is a corner.
constexpr double straight = 0.9999985, corner = 0.8660254;

bool curves(const Move& in, const Move& out) {
  if (in.length_mm > longest_mm || out.length_mm > longest_mm) return false;
  const double cosine = in.ux * out.ux + in.uy * out.uy + in.uz * out.uz;
  return cosine < straight && cosine > corner;
}

}  // namespace

void even_curves(const Rules& rules, Extrude& bead) {
  const BeadMoves printed = moves_of(rules, bead);
  const auto& moves = printed.moves;
  const auto& ends = printed.ends;
  std::vector<float> speeds = bead.segment_speed_mm_s;
  bool changed = false;
  const auto slow_down = [&](std::size_t first, std::size_t last) {  // moves
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t m = first; m <= last; ++m) least = std::min(least, moves[m].speed_mm_s);
    for (std::size_t m = first + 1; m <= last; ++m)
      least = std::min(least, corner_speed_mm_s(rules.machine, moves[m - 1], moves[m]));
    if (speeds.empty()) speeds.assign(bead.path.size() - 1, static_cast<float>(bead.speed_mm_s));
    for (std::size_t piece = first > 0 ? ends[first - 1] : 0; piece < ends[last]; ++piece) {
      const auto v = static_cast<double>(speeds[piece]),
                 wanted = v - rules.speeds.speed_curvature_even / 100 * (v - least);
      if (wanted >= v) continue;
      speeds[piece] = static_cast<float>(std::max(wanted, std::min(v, rules.cooling.cool_min_speed)));
      changed = true;
    }
  };
  for (std::size_t first = 0; first < moves.size();) {
    std::size_t last = first;
    while (last + 1 < moves.size() && curves(moves[last], moves[last + 1])) ++last;
    if (last - first + 1 >= least_moves) slow_down(first, last);
    first = last + 1;
  }
  if (!changed) return;
  bead.speed_mm_s = static_cast<double>(*std::min_element(speeds.begin(), speeds.end()));
  bead.segment_speed_mm_s = std::move(speeds);
}

}  // namespace weft::motion
