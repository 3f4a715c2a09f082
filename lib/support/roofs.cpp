// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/roofs.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/clip_lines.h"
#include "geometry/trimmed.h"
#include "support/branch_areas.h"
#include "support/joists.h"
#include "support/lengths.h"
#include "support/thin.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace weft::support {
namespace {

constexpr Um side_by_side = 1.5_mm;  // strips of a slope that are no further up or down lie on each other

/// Contacts of levels around one, so many up and down, together, as far as they come as near to those of the level.
Regions around_level(const std::vector<Regions>& contacts, std::size_t k, std::size_t count, Um near) {
  std::vector<Box> boxes;
  for (const Region& region : contacts[k]) boxes.push_back(box_of(region.outer).grown(near));
  Regions around;
  for (std::size_t j = k >= count ? k - count + 1 : 0; j < std::min(contacts.size(), k + count); ++j)
    for (const Region& region : contacts[j]) {
      const Box box = box_of(region.outer);
      if (std::any_of(boxes.begin(), boxes.end(), [&](const Box& own) { return own.overlaps(box); }))
        around.push_back(region);
    }
  return grown(around, 20);
}

/// What of contacts together is wide enough to lie on more than one branch, and a little around it.
Regions wide_part(const Regions& together, Um least) {
  return opened(together, least / 2, 50);
}

}  // namespace

Roofs::Roofs(const Room& room, const Stack& stack, const std::vector<Regions>& contacts, Use use)
    : room_(room),
      s_(room.settings()),
      o_(room.object()),
      stack_(stack),
      contacts_(contacts),
      bare_(contacts.size()),
      begins_(contacts.size()),
      around_(contacts.size()),
      laid_(contacts.size()),
      held_from_(contacts.size()),
      wide_(contacts.size()),
      lowest_(contacts.size()),
      tips_(contacts.size()) {
  if (s_.support_roof_enable && s_.support_roof_height > 0)
    begin_roofs(use);
  else
    bare_ = contacts;
}

/// Contacts of levels, with what is beside them.
struct Roofs::Floor {
  Um top = 0;
  Regions around, wide;
};

/// Levels with contacts that go on without a gap, together: a slope, or a table's underside. By level, which of them.
std::vector<Roofs::Floor> Roofs::floors(Um least, std::vector<std::size_t>& floor_of) const {
  std::vector<Floor> out;
  floor_of.resize(contacts_.size());
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    if (contacts_[k].empty()) continue;
    if (out.empty() || stack_.levels[k].z > out.back().top + side_by_side) out.emplace_back();
    floor_of[k] = out.size() - 1;
    out.back().top = stack_.levels[k].z;
    append(out.back().around, contacts_[k]);
  }
  for (Floor& floor : out) floor.around = grown(floor.around, 20), floor.wide = wide_part(floor.around, least);
  return out;
}

/// What is beside the contacts of each level, themselves included, and what of that is wide.
std::vector<Roofs::Beside> Roofs::beside_contacts(Use use) const {
  const Um least = narrowest_roof(branch_style(s_));
  std::vector<std::size_t> floor_of;
  const auto all = use == Use::reckoned ? floors(least, floor_of) : std::vector<Floor>{};
  return tasks::parallel_map(contacts_.size(), [&](std::size_t k) {
    Beside out;
    if (contacts_[k].empty()) return out;
    stop_if_asked();
    if (use == Use::reckoned) {
      const Floor& floor = all[floor_of[k]];
      const Box box = box_of(contacts_[k]).grown(2 * least);
      out.around = geometry::trimmed(floor.around, box), out.wide = geometry::trimmed(floor.wide, box);
    } else {
      const Um height = std::max<Um>(s_.support_roof_height, side_by_side);
      out.around = around_level(contacts_, k, interface_levels(stack_, k, height), 2 * least);
      out.wide = wide_part(out.around, least);
    }
    if (!out.wide.empty()) out.wide = geometry::opening(geometry::intersect(contacts_[k], out.wide), 20);
    return out;
  });
}

void Roofs::begin_roofs(Use use) {
  auto beside = beside_contacts(use);
  const auto caps = lowest_caps(stack_);
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    if (contacts_[k].empty()) continue;
    wide_[k] = std::move(beside[k].wide);
    bare_[k] =
        wide_[k].empty() ? contacts_[k] : geometry::opening(geometry::subtract(contacts_[k], grown(wide_[k], 100)), 20);
    if (wide_[k].empty()) continue;
    // A roof of one level gets its joists below it, any other has them for its lowest.
    const std::size_t count = std::max<std::size_t>(
        caps[k] > 0 ? 1 : 2, interface_levels(stack_, k, std::max<Um>(s_.support_roof_height - caps[k], 1)));
    if (count > k) {  // it lies on the plate
      for (std::size_t j = 0; j <= k; ++j) append(laid_[j], wide_[k]);
      continue;
    }
    held_from_[k - count].push_back(k);
    append(begins_[k - count], wide_[k]);
    append(around_[k - count], beside[k].around);
  }
  for (auto* some : {&begins_, &around_})
    for (auto& regions : *some)
      if (regions.size() > 1) regions = geometry::unite(regions);
}

void Roofs::rest(std::size_t level, const Branches& branches, Spans spans) {
  const Box box = box_of(begins_[level]).grown(spans.of_tips);
  std::vector<Ring> rings;
  const auto take = [&](const std::vector<Point>& points, Um span) {
    for (const Point p : points) {
      if (!box.contains(p)) continue;
      rings.push_back(circle_around({p, static_cast<double>(span)}));
      tips_[level + 1].push_back(p);
    }
  };
  take(branches.tips, spans.of_tips), take(branches.passing, spans.of_passing);
  if (rings.empty()) return;
  const Regions held = geometry::regions_from_rings(rings);
  for (const std::size_t k : held_from_[level]) resting_.push_back({level, k, geometry::intersect(wide_[k], held)});
}

void Roofs::lay(const std::vector<Regions>& branches) {
  const Um span = roof_span(o_.nozzle) / 2 + o_.nozzle;
  for (std::size_t from = 0; from < resting_.size();) {
    const std::size_t level = resting_[from].level;
    const Regions near = grown(branches[level], span);
    for (; from < resting_.size() && resting_[from].level == level; ++from) {
      const Regions part = geometry::intersect(resting_[from].area, near);
      append(lowest_[level + 1], part);
      for (std::size_t j = level + 2; j <= resting_[from].contact; ++j) append(laid_[j], part);
    }
  }
}

Regions Roofs::shaped(const Regions& area, std::size_t level) const {
  const Um line = line_width(s_, o_.nozzle);
  const Regions all = geometry::unite(area);
  Regions out = s_.support_join_distance > 0 ? closed(all, s_.support_join_distance / 2) : all;
  thicken(out, out, line);
  return opened(room_.free_part(out, stack_.levels[level], all), line * 4 / 10);
}

JoistPlace Roofs::place_on(std::size_t level, const std::vector<Regions>& branches, const Regions& dense) const {
  const Um line = line_width(s_, o_.nozzle);
  JoistPlace out{tips_[level], branches[level - 1], grown(dense, line), {}};
  append(out.below, laid_[level - 1]), append(out.below, lowest_[level - 1]);
  out.below = grown(out.below, line / 2);
  out.free = [this, level, line, kept = geometry::SegmentIndex(grown(dense, line / 2))](Point a, Point b) {
    const Polyline way{a, b};
    if (!geometry::clip_lines({&way, 1}, kept).empty()) return false;
    const double length = std::max(1.0, distance(a, b));
    const Point side{rounded(line / 2 * (a.y - b.y) / length), rounded(line / 2 * (b.x - a.x) / length)};
    bool cut = false;
    room_.free_part({{{a - side, b - side, b + side, a + side}, {}}}, stack_.levels[level], {}, &cut);
    return !cut;
  };
  return out;
}

Roofs::OfLevel Roofs::of_level(std::size_t level, const std::vector<Regions>& branches) const {
  const Um line = line_width(s_, o_.nozzle);
  OfLevel out;
  if (!laid_[level].empty()) out.area = shaped(laid_[level], level);
  if (lowest_[level].empty()) return out;
  Regions open = shaped(lowest_[level], level);
  if (!out.area.empty()) open = opened(geometry::subtract(open, grown(out.area, 20)), line * 4 / 10);
  const bool along = out.area.empty() && opened(open, narrow_roof / 2).empty();
  const bool one_way =
      !along && (s_.support_interface_pattern == SupportPattern::zigzag ||
                 s_.support_interface_pattern == SupportPattern::lines || s_.support_interface_density >= 99.5);
  const JoistStyle style{.strands_rad = s_.support_infill_angle * std::numbers::pi / 180,
                         .one_way = one_way,
                         .longest = 2 * roof_covers(branch_style(s_), o_.nozzle) + o_.nozzle,
                         .line = line};
  const JoistPlace place = place_on(level, branches, out.area);
  out.joists = joists_between(std::move(open), place, style);
  return out;
}

Roofs::Laid Roofs::laid(const std::vector<Regions>& branches) && {
  lay(branches);
  auto levels = tasks::parallel_map(laid_.size(), [&](std::size_t k) {
    stop_if_asked();
    return laid_[k].empty() && lowest_[k].empty() ? OfLevel{} : of_level(k, branches);
  });
  Laid out;
  for (auto& level : levels) out.areas.push_back(std::move(level.area)), out.joists.push_back(std::move(level.joists));
  return out;
}

}  // namespace weft::support
