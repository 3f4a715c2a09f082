// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/timed_steps.h"

#include <algorithm>
#include <cstddef>

namespace weft::motion {

std::pair<Extrude, Extrude> split(Extrude bead, std::size_t junction) {
  if (bead.loop_length == 0 && bead.path.front().at == bead.path.back().at) {
    double um = 0;
    for (std::size_t i = 1; i < bead.path.size(); ++i) um += distance(bead.path[i - 1].at, bead.path[i].at);
    bead.loop_length = rounded(um);
  }
  Extrude after = bead;
  const auto at = static_cast<std::ptrdiff_t>(junction);
  bead.path.resize(junction + 1);
  after.path.erase(after.path.begin(), after.path.begin() + at);
  if (!bead.segment_speed_mm_s.empty()) {
    bead.segment_speed_mm_s.resize(junction);
    after.segment_speed_mm_s.erase(after.segment_speed_mm_s.begin(), after.segment_speed_mm_s.begin() + at);
  }
  if (!bead.below.empty()) {
    bead.below.resize(junction + 1);
    after.below.erase(after.below.begin(), after.below.begin() + at);
  }
  std::erase_if(bead.arcs, [&](const Arc& arc) { return arc.first >= junction; });
  std::erase_if(after.arcs, [&](const Arc& arc) { return arc.first < junction; });
  for (Arc& arc : after.arcs)
    arc.first -= static_cast<std::uint32_t>(junction), arc.last -= static_cast<std::uint32_t>(junction);
  return {std::move(bead), std::move(after)};
}

}  // namespace weft::motion
