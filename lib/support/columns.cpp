// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/columns.h"

#include "geometry/boolean.h"
#include "geometry/nudge.h"
#include "geometry/simplify.h"
#include "geometry/touching.h"
#include "geometry/trimmed.h"
#include "support/falling.h"
#include "support/lengths.h"
#include "support/near_edge.h"
#include "support/patches.h"
#include "support/thin.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <utility>

namespace weft::support {
namespace {

/// What of regions is no nearer than that to their edge, gone along a direction.
Regions shortened(const Regions& regions, Um by, double direction_rad) {
  const Point to{rounded(by * std::cos(direction_rad)), rounded(by * std::sin(direction_rad))};
  return geometry::intersect(geometry::intersect(regions, moved(regions, to)), moved(regions, -to));
}

/// Lines that do not carry each other: a column may lose the ends of its lines, but none from its side.
bool of_lines(const SupportSettings& s) {
  return (s.support_pattern == SupportPattern::zigzag || s.support_pattern == SupportPattern::lines) &&
         s.support_wall_count.value_or(0) == 0;
}

}  // namespace

Lean::Lean(const SupportSettings& settings, Um line, Um height)
    : s_(settings), line_(line), least_(std::max(settings.support_conical_min_width, height / 8)) {}

Regions Lean::narrower(const Regions& falling, Um by) const {
  if (by < 0) return grown(falling, -by);
  const auto with = [](Um offset) { return geometry::OffsetOptions{.by = offset, .corner = geometry::Corner::miter}; };
  // What stands close round something goes on round it: lines would only be cut in pieces.
  Regions solid = falling;
  bool round_something = false;
  for (Region& region : solid)
    round_something |= std::erase_if(region.holes, [&](const Ring& hole) {
                         const Point size = box_of(hole).size();
                         return std::max(size.x, size.y) < least_;
                       }) > 0;
  const Regions wide = geometry::offset(solid, with(-least_ / 2));
  if (wide.empty()) return falling;
  const Regions opened_wide = geometry::offset(wide, with(least_ / 2 + 20));
  Regions kept = geometry::subtract(solid, opened_wide);
  // A tooth of an edge draws back with it, or it would be left alone as a needle.
  const Regions beside = grown(opened_wide, 2 * line_);
  std::erase_if(kept, [&](const Region& piece) { return geometry::subtract({piece}, beside).empty(); });
  Regions out = of_lines(s_) ? shortened(solid, by, s_.support_infill_angle * std::numbers::pi / 180)
                             : geometry::offset(solid, with(-by));
  append(out, kept);
  if (!kept.empty()) out = geometry::unite(out);
  if (round_something) out = geometry::intersect(out, falling);
  return geometry::simplified(without_thin(out, thin_column(line_)), coarse_outline);
}

bool Lean::narrow(Um height, Regions& falling, int levels) {
  const Um most = line_ * 6 / 10;  // more would hang
  left_ += height * std::tan(s_.support_conical_angle * std::numbers::pi / 180);
  if (left_ >= 0 && left_ < most) return false;  // levels that are alike are done once
  const Um by = std::clamp(rounded(left_), -8 * most * levels, most * levels);
  left_ -= by;
  if (by > 0 && std::all_of(falling.begin(), falling.end(), [&](const Region& region) {
        const Point size = box_of(region.outer).size();
        return std::min(size.x, size.y) <= least_;
      }))
    return false;
  Regions narrow = narrower(falling, by);
  if (narrow == falling) return false;
  falling = std::move(narrow);
  return true;
}

Um apart(const SupportSettings& s, Um nozzle) {
  return std::max<Um>(s.support_join_distance, 4 * line_width(s, nozzle)) + 0.1_mm;
}

std::vector<Regions> columns(const Room& room, const Stack& stack, const std::vector<Regions>& contacts,
                             const std::vector<Regions>& given, tasks::Spare& spare, const Patches* known) {
  if (stack.levels.empty()) return {};  // what is so near to the plate has no room for any
  const auto& s = room.settings();
  std::vector<Regions> shadow;
  if (s.support_type == SupportType::buildplate) shadow = shadows(room, stack);
  const Air air{room, stack, shadow};
  const bool drawn = std::any_of(given.begin(), given.end(), [](const Regions& r) { return !r.empty(); });
  // What slides takes more than what stands on the slope with toes, so only where that leaves something.
  const auto leaves_some = [&](const Patch& patch, const std::vector<Regions>& levels) {
    double left_mm2 = 0;
    for (const auto& [k, held] : patch.contacts) {
      Regions bare;
      for (const Region& region : held) {
        const Regions under = near_to(region, levels[k]);
        if (under.empty() || !are_reached(region, geometry::beyond(region, under, beside_by), reached))
          bare.push_back(region);
      }
      if (bare.empty()) continue;
      const Regions beside = geometry::trimmed(levels[k], box_of(bare).grown(2 * reached));
      left_mm2 += area_mm2(geometry::subtract(bare, grown(beside, reached)));
      if (left_mm2 > s.minimum_support_area) return true;
    }
    return false;
  };
  const auto under = [&](const Patch& patch, const std::vector<Regions>* drawn_there) {
    Fallen first = fall(air, patch, drawn_there, height_of(patch, stack, room.object()));
    if (first.lost.empty() || !leaves_some(patch, first.levels)) return std::move(first.levels);
    return slid(air, patch, first);
  };
  // What gets wider on the way down meets others.
  const bool wider = drawn || s.support_normal_shape == SupportShape::grid || s.support_use_towers ||
                     (s.support_conical_enabled && s.support_conical_angle < 0);
  if (wider) {
    Patch all;
    for (std::size_t k = 0; k < contacts.size(); ++k)
      if (!contacts[k].empty()) all.contacts.push_back({k, contacts[k]});
    std::vector<Regions> out;
    spare.beside([&] { out = under(all, drawn ? &given : nullptr); });
    return out;
  }
  std::optional<Patches> found;
  if (known == nullptr) known = &found.emplace(contacts, apart(s, room.object().nozzle));
  const auto& patches = known->all();
  std::vector<std::vector<Regions>> of_patch(patches.size());
  spare.for_each_index(of_patch.size(), [&](std::size_t i) { of_patch[i] = under(patches[i], nullptr); });
  std::vector<Regions> out(stack.levels.size());
  for (auto& levels : of_patch)
    for (std::size_t k = 0; k < levels.size(); ++k)
      out[k].insert(out[k].end(), std::make_move_iterator(levels[k].begin()), std::make_move_iterator(levels[k].end()));
  // What got wider may meet others.
  tasks::for_each_index(out.size(), [&](std::size_t k) { out[k] = geometry::joined(out[k]); });
  return out;
}

}  // namespace weft::support
