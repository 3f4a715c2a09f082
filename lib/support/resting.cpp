// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/resting.h"

#include "geometry/boolean.h"
#include "geometry/nudge.h"
#include "geometry/trimmed.h"
#include "support/lengths.h"
#include "support/thin.h"

#include <algorithm>
#include <utility>

namespace weft::support {
namespace {

/// What of an area hangs, but for slivers along edges: one that was opened by 0.4 lines is none.
Regions hanging(const Region& region, const Regions& below) {
  constexpr Um least_wide = 60;
  const Regions under = near_to(region, below, outline_bound);
  if (std::find(under.begin(), under.end(), region) != under.end()) return {};
  Regions out;
  const Regions over = under.empty() ? Regions{region} : geometry::beyond(region, under, outline_bound);
  for (const Region& piece : over) {
    const double mm2 = area_mm2(piece);
    if (mm2 < least_to_rest_mm2) continue;
    if (2e6 * mm2 >= least_wide * perimeter_of(piece.outer))
      out.push_back(piece);
    else
      append(out, geometry::opening({piece}, least_wide / 2));  // what is wide may hang on to a long sliver
  }
  return out;
}

}  // namespace

Regions part_below(const Room& room, const Stack::Level& level, const Box& near) {
  constexpr Um sinks = 0.6_mm;
  return room.part(level.bottom() - bottom_gap(room.settings()) - sinks, level.bottom(), near);
}

Um reach_of(const Room& room, const Stack::Level& level) {
  return std::max(line_width(room.settings(), room.object().nozzle) * 6 / 10, level.height);
}

namespace {

/// What of pieces of a level that hang over the one below has nothing near enough to hold it.
Regions falls_down(const Room& room, const Stack::Level& level, const Regions& below, const Regions& hangs) {
  const Um reach = reach_of(room, level);
  Regions out;
  for (const Region& piece : hangs) {
    const Box near = box_of(piece.outer).grown(2 * reach);
    const auto beyond = [&](const Regions& base) {
      return base.empty() ? Regions{piece} : geometry::subtract({piece}, grown(base, reach));
    };
    Regions base = geometry::trimmed(below, near), free = beyond(base);
    if (!free.empty() && room.settings().support_type == SupportType::everywhere) {
      const Regions on_part = geometry::covered(piece, part_below(room, level, near), beside_by);
      if (!on_part.empty()) append(base, on_part), free = beyond(base);  // it stands on that, not on walls beside
    }
    append(out, free);
  }
  return out;
}

}  // namespace

Regions rest_on(const Room& room, const Stack::Level& level, const Regions& below, Regions& here) {
  const Um thin = thin_column(line_width(room.settings(), room.object().nozzle));
  Regions left, lost;
  for (Region& region : here) {
    const Regions free = falls_down(room, level, below, hanging(region, below));
    if (free.empty()) {
      left.push_back(std::move(region));
      continue;
    }
    // Nothing rests on a hair that stays beside what goes.
    const Regions rests = without_thin(geometry::beyond(region, free, beside_by), thin);
    append(left, rests);
    if (rests.empty()) lost.push_back(std::move(region));
  }
  here = std::move(left);
  return lost;
}

namespace {

/// Over a steep slope a column hangs: it is kept off it further sideways than it may sag. There it reaches out to
/// where the slope is near below, no nearer to it than contacts are.
/// @param lost  regions of that level of which nothing rests
Regions toes(const Room& room, const Stack::Level& level, const Regions& lost) {
  const auto& s = room.settings();
  if (lost.empty() || s.support_type != SupportType::everywhere || level.bottom() <= room.object().floor) return {};
  const Regions wide = grown(lost, beside(s, room.object()));
  const Regions free = room.free_part(wide, level, wide), part = part_below(room, level, box_of(wide));
  if (free.empty() || part.empty()) return {};
  return without_thin(geometry::intersect(grown(geometry::intersect(free, part), reach_of(room, level)), free),
                      thin_column(line_width(s, room.object().nozzle)));
}

}  // namespace

bool rest_or_reach(const Room& room, const Stack::Level& level, const Regions& below, Regions& here, Regions& lost) {
  constexpr double least_mm2 = 0.2;  // about a bead's square
  const double all_mm2 = area_mm2(here);
  const Regions fallen = rest_on(room, level, below, here);
  const double lost_mm2 = all_mm2 - area_mm2(here);
  if (lost_mm2 > least_mm2) {
    lost = geometry::unite(lost, fallen);
    if (const Regions more = toes(room, level, fallen); !more.empty()) here = geometry::unite(here, more);
  }
  return lost_mm2 > 0;
}

}  // namespace weft::support
