// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/columns.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/clip_lines.h"
#include "geometry/simplify.h"
#include "geometry/trimmed.h"
#include "support/branch_areas.h"
#include "support/lengths.h"
#include "support/patches.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

namespace weft::support {
namespace {

/// The squares of a grid, fixed to the object, that an area meets.
Regions squares(const Regions& area, Um cell) {
  std::set<std::pair<Um, Um>> met;
  const auto floor_div = [&](Um v) { return v >= 0 ? v / cell : -((-v + cell - 1) / cell); };
  const Box box = box_of(area);
  if (box.empty()) return {};
  std::vector<Polyline> lines;
  const Um step = std::max<Um>(cell / 4, 100);
  for (Um y = box.min.y + step / 2; y < box.max.y; y += step) lines.push_back({{box.min.x - 1, y}, {box.max.x + 1, y}});
  for (const auto& piece : geometry::clip_lines(lines, area))
    for (Um c = floor_div(std::min(piece.line.front().x, piece.line.back().x));
         c <= floor_div(std::max(piece.line.front().x, piece.line.back().x)); ++c)
      met.insert({floor_div(piece.line.front().y), c});
  std::vector<Ring> rings;
  for (const auto& [row, column] : met) {
    const Um x = column * cell, y = row * cell;
    rings.push_back({{x - 1, y - 1}, {x + cell + 1, y - 1}, {x + cell + 1, y + cell + 1}, {x - 1, y + cell + 1}});
  }
  auto out = geometry::regions_from_rings(rings);
  append(out, area);
  return geometry::unite(out);
}

/// What columns look like that hold an area.
Regions shaped(const SupportSettings& s, const Object& object, const Regions& contact) {
  if (s.support_normal_shape == SupportShape::snug) return contact;
  const double share = std::max(0.02, s.support_infill_rate / 100);
  return squares(contact, std::clamp<Um>(rounded(line_width(s, object.nozzle) / share), 1000, 10000));
}

bool on_tower(const SupportSettings& s, const Region& region) {
  const Point size = box_of(region.outer).size();
  return s.support_use_towers && std::max(size.x, size.y) <= s.support_tower_maximum_supported_diameter;
}

/// Rounds under tiny contacts, as thick as a tower as soon as the slope of its top allows.
class Towers {
 public:
  Towers(const SupportSettings& s) : s_(s) {}
  void begin(const Regions& contacts, Um z) {
    for (const Region& region : contacts)
      if (on_tower(s_, region)) growing_.push_back({box_of(region.outer), z});
  }
  /// Adds what towers are on a level with its top there. @return whether there is any
  bool add(Um z, Regions& falling) {
    const double most = s_.support_tower_diameter / 2.0;
    std::vector<Ring> rings;
    std::erase_if(growing_, [&](const Tower& tower) {
      const double least = std::max(tower.box.size().x, tower.box.size().y) / 2.0;
      const double slope = std::tan(s_.support_tower_roof_angle * std::numbers::pi / 180);
      const double radius = slope > 0 ? std::min(most, least + (tower.z - z) / slope) : most;
      if (radius > 0) rings.push_back(circle_around({tower.box.centre(), radius}));
      return radius >= most;
    });
    if (rings.empty()) return false;
    append(falling, geometry::regions_from_rings(rings));
    falling = geometry::unite(falling);
    return true;
  }

 private:
  struct Tower {
    Box box;
    Um z;
  };
  const SupportSettings& s_;
  std::vector<Tower> growing_;
};

/// A level further down columns are narrower by that much at each side (wider below 0), but keep their least width.
void lean(const SupportSettings& s, const Object& object, Um height, Regions& falling) {
  const Um rests = line_width(s, object.nozzle) / 2;  // more of a bead would hang
  const Um by =
      std::clamp(rounded(height * std::tan(s.support_conical_angle * std::numbers::pi / 180)), -8 * rests, rests);
  if (by < 0) {
    falling = grown(falling, -by);
    return;
  }
  const auto with = [](Um offset) { return geometry::OffsetOptions{.by = offset, .corner = geometry::Corner::miter}; };
  const Um least = s.support_conical_min_width / 2;
  Regions out = geometry::offset(falling, with(-by));
  append(out, geometry::subtract(falling, geometry::offset(geometry::offset(falling, with(-least)), with(least + 20))));
  falling = geometry::opening(geometry::unite(out), rests / 2);
}

}  // namespace

TowersAndOthers for_towers(const SupportSettings& settings, const std::vector<Regions>& contacts) {
  TowersAndOthers out{std::vector<Regions>(contacts.size()), std::vector<Regions>(contacts.size())};
  for (std::size_t k = 0; k < contacts.size(); ++k)
    for (const Region& region : contacts[k])
      (on_tower(settings, region) ? out.towers : out.others)[k].push_back(region);
  return out;
}

namespace {

/// The boxes of pieces, wider.
Regions boxes_around(const Regions& pieces, Um by) {
  std::vector<Ring> rings;
  for (const Region& piece : pieces) {
    const Box box = box_of(piece.outer).grown(by);
    rings.push_back({box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}});
  }
  return geometry::regions_from_rings(rings);
}

}  // namespace

void thicken(Regions& area, const Regions& fresh, Um line) {
  if (fresh.empty()) return;
  // What a disc inside of the area covers is told by what lies as near as its diameter.
  const Regions around = &area == &fresh ? area : geometry::intersect(area, boxes_around(fresh, 2 * line));
  const Regions thin = geometry::subtract(fresh, opened(around, line, 20));
  if (thin.empty()) return;
  append(area, grown(thin, line));
  area = geometry::unite(area);
}

Regions without_thin(const Regions& area, Um radius) {
  return geometry::offset(geometry::offset(area, {.by = -radius}), {.by = radius, .miter_limit = 8});
}

namespace {

/// What of a level hangs, but for slivers along edges: an area that was opened by 0.4 lines is none.
Regions hanging(const Regions& here, const Regions& below) {
  Regions out;
  for (const Region& region : here) {
    const Regions under = geometry::trimmed(below, box_of(region.outer).grown(1));
    if (under.size() == 1 && under.front() == region) continue;
    append(out, under.empty() ? Regions{region} : geometry::subtract({region}, under));
  }
  std::erase_if(out, [](const Region& piece) {
    constexpr double least_mm2 = 0.05, least_wide_mm = 0.06;
    const double mm2 = area_mm2(piece);
    return mm2 < least_mm2 || 2000 * mm2 < least_wide_mm * perimeter_of(piece.outer);
  });
  return out;
}

}  // namespace

void rest_on(const Room& room, const Stack::Level& level, const Regions& below, Regions& here) {
  constexpr Um sinks = 0.6_mm;  // what hangs so far above the part comes to lie on it
  if (here.empty()) return;
  const auto& s = room.settings();
  const Regions hangs = hanging(here, below);
  if (hangs.empty()) return;
  const Um reach = std::max(line_width(s, room.object().nozzle) * 6 / 10, level.height);
  Regions free;
  for (const Region& piece : hangs) {
    const Box near = box_of(piece.outer).grown(2 * reach);
    Regions base = geometry::trimmed(below, near);
    if (s.support_type == SupportType::everywhere) {  // what lies below it, and not walls beside
      const Regions part = room.part(level.bottom() - bottom_gap(s) - sinks, level.bottom(), near);
      if (!part.empty()) append(base, geometry::intersect({piece}, part));
    }
    if (base.empty())
      free.push_back(piece);
    else
      append(free, geometry::subtract({piece}, grown(base, reach)));
  }
  if (!free.empty()) here = geometry::subtract(here, free);
}

namespace {

constexpr Um corner_bound = 40_um;

/// Columns of one patch.
class Falling {
 public:
  Falling(const Room& room, const Stack& stack, const std::vector<Regions>& shadow)
      : s_(room.settings()),
        room_(room),
        stack_(stack),
        shadow_(shadow),
        line_(line_width(s_, room.object().nozzle)),
        towers_(s_),
        levels_(stack.levels.size()),
        less_(stack.levels.size(), 0) {}

  /// From the highest level down.
  std::vector<Regions> under(const Patch& patch, const std::vector<Regions>* given) && {
    auto next = patch.contacts.rbegin();
    static const Regions none;
    for (std::size_t k = stack_.levels.size(); k-- > 0;) {
      const bool contact = next != patch.contacts.rend() && next->first == k;
      const Regions& held = contact ? (next++)->second : none;
      if (falling_.empty() && held.empty() && (given == nullptr || (*given)[k].empty())) continue;
      stop_if_asked();
      begin(k, held, given != nullptr ? (*given)[k] : none);
      clear(k, held);
      levels_[k] = falling_;
    }
    let_rest();
    return std::move(levels_);
  }

 private:
  /// What begins on that level, and what comes down from above.
  void begin(std::size_t k, const Regions& contacts, const Regions& given) {
    const auto& level = stack_.levels[k];
    if (s_.support_conical_enabled && !falling_.empty()) {
      lean(s_, room_.object(), level.height, falling_);
      edge_.reset(), less_[k] = 1;
    }
    towers_.begin(contacts, level.z);
    if (towers_.add(level.z, falling_) || !contacts.empty() || !given.empty()) edge_.reset();
    if (!contacts.empty()) {
      const Regions fresh = shaped(s_, room_.object(), contacts);
      append(falling_, fresh);
      if (falling_.size() > 1) falling_ = joined(falling_);
      thicken(falling_, fresh, line_);
    }
    if (given.empty()) return;
    append(falling_, given);
    falling_ = geometry::unite(falling_);
  }
  /// Strips of a slope, one above the other, would leave holes and gaps that are no wider than what is to be one
  /// column.
  Regions joined(const Regions& falling) const {
    if (s_.support_join_distance <= 0) return geometry::unite(falling);
    return closed(falling, s_.support_join_distance / 2);
  }
  void clear(std::size_t k, const Regions& contacts) {
    const auto& level = stack_.levels[k];
    const Regions& close = beside_contacts(k, contacts);
    if (contacts.empty() && (shadow_.empty() || shadow_[k].empty()) && room_.stands_free(falling_, edge(), level))
      return;
    if (ragged_ || !contacts.empty()) falling_ = geometry::simplified(falling_, corner_bound), edge_.reset();
    ragged_ = false;
    bool cut = false;
    Regions left = room_.free_part(falling_, level, close, &cut);
    if (!shadow_.empty() && !shadow_[k].empty()) left = geometry::subtract(left, shadow_[k]), cut = true;
    if (!cut && contacts.empty()) return;
    falling_ = without_thin(left, line_ * 4 / 10);
    edge_.reset();
    ragged_ = true, less_[k] = 1;
  }
  const geometry::SegmentIndex& edge() {
    if (!edge_) edge_.emplace(falling_);
    return *edge_;
  }
  /// What is held as near beside the part as contacts are must come from further away, and leans towards it on the
  /// last levels: the contacts of those above this one.
  const Regions& beside_contacts(std::size_t k, const Regions& contacts) {
    constexpr std::size_t leaning = 2;  // levels; what rests reaches about half a line further on each
    if (!contacts.empty()) held_.push_back({k, contacts});
    std::erase_if(held_, [k](const auto& held) { return held.first >= k + leaning; });
    close_.clear();
    for (const auto& held : held_) append(close_, held.second);
    return close_;
  }
  /// From the bottom up: where the level below is no less than this one, all of it rests.
  void let_rest() {
    bool less_below = less_[0] != 0;
    for (std::size_t k = 1; k < levels_.size(); ++k) {
      const bool less = less_[k] != 0;
      if (less_below && !levels_[k].empty()) {
        stop_if_asked();
        const double before = area_mm2(levels_[k]);
        rest_on(room_, stack_.levels[k], levels_[k - 1], levels_[k]);
        less_below = less || area_mm2(levels_[k]) < before;
      } else {
        less_below = less;
      }
    }
  }

  const SupportSettings& s_;
  const Room& room_;
  const Stack& stack_;
  const std::vector<Regions>& shadow_;
  Um line_;
  Towers towers_;
  Regions falling_, close_;
  std::vector<std::pair<std::size_t, Regions>> held_;  ///< the last contacts, by level
  std::optional<geometry::SegmentIndex> edge_;         ///< of what falls, once asked for
  bool ragged_ = false;                                ///< it has corners of what was cut from it
  std::vector<Regions> levels_;
  std::vector<char> less_;  ///< of each level, whether it is not all of what lies above it
};

}  // namespace

Um apart(const SupportSettings& s, Um nozzle) {
  return std::max<Um>(s.support_join_distance, 4 * line_width(s, nozzle)) + 0.1_mm;
}

std::vector<Regions> columns(const Room& room, const Stack& stack, const std::vector<Regions>& contacts,
                             const std::vector<Regions>& given) {
  const auto& s = room.settings();
  std::vector<Regions> shadow;
  if (s.support_type == SupportType::buildplate) shadow = shadows(room, stack);
  const bool drawn = std::any_of(given.begin(), given.end(), [](const Regions& r) { return !r.empty(); });
  // What gets wider on the way down meets others.
  const bool wider = drawn || s.support_normal_shape == SupportShape::grid || s.support_use_towers ||
                     (s.support_conical_enabled && s.support_conical_angle < 0);
  if (wider) {
    Patch all;
    for (std::size_t k = 0; k < contacts.size(); ++k)
      if (!contacts[k].empty()) all.contacts.push_back({k, contacts[k]});
    return Falling(room, stack, shadow).under(all, drawn ? &given : nullptr);
  }
  const Patches patches(contacts, apart(s, room.object().nozzle));
  auto of_patch = tasks::parallel_map(patches.all().size(), [&](std::size_t i) {
    return Falling(room, stack, shadow).under(patches.all()[i], nullptr);
  });
  std::vector<Regions> out(stack.levels.size());
  for (auto& levels : of_patch)
    for (std::size_t k = 0; k < levels.size(); ++k)
      out[k].insert(out[k].end(), std::make_move_iterator(levels[k].begin()), std::make_move_iterator(levels[k].end()));
  return out;
}

}  // namespace weft::support
