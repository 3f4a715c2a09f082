// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/columns.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/clip_lines.h"
#include "geometry/simplify.h"
#include "geometry/touching.h"
#include "geometry/trimmed.h"
#include "support/branch_areas.h"
#include "support/lengths.h"
#include "support/patches.h"
#include "support/steady.h"
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
  const Regions kept = geometry::subtract(solid, geometry::offset(wide, with(least_ / 2 + 20)));
  Regions out = of_lines(s_) ? shortened(solid, by, s_.support_infill_angle * std::numbers::pi / 180)
                             : geometry::offset(solid, with(-by));
  append(out, kept);
  if (!kept.empty()) out = geometry::unite(out);
  if (round_something) out = geometry::intersect(out, falling);
  return geometry::simplified(without_thin(out, line_ * 4 / 10), coarse_outline);
}

bool Lean::narrow(Um height, Regions& falling) {
  const Um most = line_ * 6 / 10;  // more would hang
  left_ += height * std::tan(s_.support_conical_angle * std::numbers::pi / 180);
  if (left_ >= 0 && left_ < most) return false;  // levels that are alike are done once
  const Um by = std::clamp(rounded(left_), -8 * most, most);
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
  // Corners are not thin: what grew around them would reach further than what they hold.
  const Regions wide = geometry::offset(geometry::offset(around, {.by = -line}), {.by = line + 20});
  const Regions thin = geometry::subtract(fresh, wide);
  if (thin.empty()) return;
  append(area, grown(thin, line));
  area = geometry::unite(area);
}

namespace {

/// Whether no corner of one, and no middle of an edge, is further from the other than offsets are rounded: a neck has
/// its corners where it begins to be one.
bool within(const Regions& inner, const geometry::SegmentIndex& outer) {
  constexpr double rounded_um = 2;
  const auto lies = [&](Point p) { return outer.nearest(p, rounded_um) || outer.region_at(p); };
  const auto all_lie = [&](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i)
      if (!lies(ring[i]) || !lies(lerp(ring[i], ring[i + 1 < ring.size() ? i + 1 : 0], 0.5))) return false;
    return true;
  };
  return std::all_of(inner.begin(), inner.end(), [&](const Region& region) {
    return all_lie(region.outer) && std::all_of(region.holes.begin(), region.holes.end(), all_lie);
  });
}

}  // namespace

Regions without_thin(const Regions& area, Um radius) {
  const Regions wide = geometry::offset(geometry::offset(area, {.by = -radius}), {.by = radius, .miter_limit = 3});
  if (wide.empty()) return wide;
  // Only where a corner was cut off, the whole one reaches further.
  return within(wide, geometry::SegmentIndex(area)) ? wide : geometry::intersect(wide, area);
}

namespace {

/// What of an area hangs, but for slivers along edges: one that was opened by 0.4 lines is none.
Regions hanging(const Region& region, const Regions& below) {
  constexpr double least_mm2 = 0.05;
  constexpr Um least_wide = 60;
  const Regions under = geometry::trimmed(below, box_of(region.outer).grown(1));
  if (std::find(under.begin(), under.end(), region) != under.end()) return {};
  Regions out;
  for (const Region& piece : under.empty() ? Regions{region} : geometry::subtract({region}, under)) {
    const double mm2 = area_mm2(piece);
    if (mm2 < least_mm2) continue;
    if (2e6 * mm2 >= least_wide * perimeter_of(piece.outer))
      out.push_back(piece);
    else
      append(out, geometry::opening({piece}, least_wide / 2));  // what is wide may hang on to a long sliver
  }
  return out;
}

}  // namespace

namespace {

/// What of the part a level comes to lie on: beads sink so far.
Regions part_below(const Room& room, const Stack::Level& level, const Box& near) {
  constexpr Um sinks = 0.6_mm;
  return room.part(level.bottom() - bottom_gap(room.settings()) - sinks, level.bottom(), near);
}

/// How far beads reach beyond what they lie on.
Um reach_of(const Room& room, const Stack::Level& level) {
  return std::max(line_width(room.settings(), room.object().nozzle) * 6 / 10, level.height);
}

}  // namespace

namespace {

/// What of pieces of a level that hang over the one below has nothing near enough to hold it.
Regions falls_down(const Room& room, const Stack::Level& level, const Regions& below, const Regions& hangs) {
  const Um reach = reach_of(room, level);
  Regions out;
  for (const Region& piece : hangs) {
    const Box near = box_of(piece.outer).grown(2 * reach);
    Regions base = geometry::trimmed(below, near);
    if (room.settings().support_type == SupportType::everywhere) {  // what lies below it, and not walls beside
      const Regions part = part_below(room, level, near);
      if (!part.empty()) append(base, geometry::intersect({piece}, part));
    }
    if (base.empty())
      out.push_back(piece);
    else
      append(out, geometry::subtract({piece}, grown(base, reach)));
  }
  return out;
}

}  // namespace

void rest_on(const Room& room, const Stack::Level& level, const Regions& below, Regions& here) {
  const Um hair = line_width(room.settings(), room.object().nozzle) * 4 / 10;
  Regions left;
  for (Region& region : here) {
    const Regions free = falls_down(room, level, below, hanging(region, below));
    if (free.empty())
      left.push_back(std::move(region));
    else  // nothing rests on a hair that stays beside what goes
      append(left, without_thin(geometry::subtract({region}, free), hair));
  }
  here = std::move(left);
}

namespace {

constexpr Um corner_bound = 40_um;

/// Columns of one patch.
class Falling {
 public:
  /// @param height  of the highest of them
  Falling(const Room& room, const Stack& stack, const std::vector<Regions>& shadow, Um height)
      : s_(room.settings()),
        room_(room),
        stack_(stack),
        shadow_(shadow),
        line_(line_width(s_, room.object().nozzle)),
        lean_(s_, line_, height),
        towers_(s_),
        levels_(stack.levels.size()),
        less_(stack.levels.size(), 0) {
    if (!s_.support_conical_enabled && !s_.support_use_towers) steady_.emplace(line_);
  }

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
    if (s_.support_conical_enabled && !falling_.empty() && lean_.narrow(level.height, falling_))
      edge_.reset(), less_[k] = 1;
    if (steady_ && steady_->widen(level.z, falling_)) edge_.reset();
    if (steady_) steady_->begin(contacts, level.z);
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
    look_above(k, contacts);
    if (contacts.empty() && (shadow_.empty() || shadow_[k].empty()) && room_.stands_free(falling_, edge(), level))
      return;
    if (ragged_ || !contacts.empty()) falling_ = geometry::simplified(falling_, corner_bound), edge_.reset();
    ragged_ = false;
    const bool shaded = !shadow_.empty() && !shadow_[k].empty();
    Regions left;
    for (Region& region : falling_) {
      bool cut = shaded;
      Regions free = room_.free_part({region}, level, close_, cut ? nullptr : &cut, &above_);
      if (shaded) free = geometry::subtract(free, shadow_[k]);
      ragged_ = ragged_ || cut;
      if (cut)
        append(left, without_thin(free, line_ * 4 / 10));
      else
        left.push_back(std::move(region));
    }
    if (!ragged_) return void(falling_ = std::move(left));
    falling_ = std::move(left);
    edge_.reset();
    less_[k] = 1;
  }
  const geometry::SegmentIndex& edge() {
    if (!edge_) edge_.emplace(falling_);
    return *edge_;
  }
  /// What is held as near beside the part as contacts are must come from further away: it leans towards it in two
  /// steps, on the last levels and where the roof above them begins. What rests reaches about half a line further on
  /// each. Finds the contacts of those above a level, and its own.
  void look_above(std::size_t k, const Regions& contacts) {
    constexpr std::size_t last = 2;
    if (!contacts.empty()) {
      const bool has_roof = s_.support_roof_enable && s_.support_roof_height > 0;
      held_.push_back({k, has_roof ? interface_levels(stack_, k, s_.support_roof_height) + 1 : last, contacts});
    }
    std::erase_if(held_, [k](const Held& held) { return held.level >= k + held.leaning; });
    close_.clear(), above_.clear();
    for (const Held& held : held_) append(held.level < k + last ? close_ : above_, held.contacts);
  }
  /// From the bottom up: where the level below is no less than this one, all of it rests.
  void let_rest() {
    bool less_below = less_[0] != 0;
    for (std::size_t k = 1; k < levels_.size(); ++k) {
      const bool less = less_[k] != 0;
      if (less_below && !levels_[k].empty()) {
        stop_if_asked();
        Regions all = levels_[k];
        rest_on(room_, stack_.levels[k], levels_[k - 1], levels_[k]);
        const double lost_mm2 = area_mm2(all) - area_mm2(levels_[k]);
        if (lost_mm2 > least_toe_mm2) {
          std::erase_if(all, [&](const Region& r) { return any_of_it_is_left(r, levels_[k]); });
          add_toes(k, all);
        }
        less_below = less || lost_mm2 > 0;
      } else {
        less_below = less;
      }
    }
  }
  /// @param left  whole regions, or pieces of them
  static bool any_of_it_is_left(const Region& region, const Regions& left) {
    if (std::find(left.begin(), left.end(), region) != left.end()) return true;
    const Box box = box_of(region.outer);
    return std::any_of(left.begin(), left.end(), [&](const Region& piece) {
      return box.overlaps(box_of(piece.outer)) && !geometry::intersect({region}, {piece}).empty();
    });
  }
  /// Over a steep slope a column hangs: it is kept off it further sideways than it may sag. There it reaches out to
  /// where the slope is near below, no nearer to it than contacts are.
  /// @param lost  regions of that level of which nothing rests
  void add_toes(std::size_t k, const Regions& lost) {
    const auto& level = stack_.levels[k];
    if (lost.empty() || s_.support_type != SupportType::everywhere || level.bottom() <= room_.object().floor) return;
    const Regions wide = grown(lost, beside(s_, room_.object()));
    const Regions free = room_.free_part(wide, level, wide), part = part_below(room_, level, box_of(wide));
    if (free.empty() || part.empty()) return;
    const Regions toes = without_thin(
        geometry::intersect(grown(geometry::intersect(free, part), reach_of(room_, level)), free), line_ * 4 / 10);
    if (toes.empty()) return;
    append(levels_[k], toes);
    levels_[k] = geometry::unite(levels_[k]);
  }

  static constexpr double least_toe_mm2 = 0.2;  // about a bead's square
  const SupportSettings& s_;
  const Room& room_;
  const Stack& stack_;
  const std::vector<Regions>& shadow_;
  Um line_;
  Lean lean_;
  std::optional<Steady> steady_;  ///< where nothing else is set of how wide columns are
  Towers towers_;
  struct Held {
    std::size_t level = 0, leaning = 0;  ///< from theirs down, so many lean towards them
    Regions contacts;
  };
  Regions falling_, close_, above_;
  std::vector<Held> held_;                      ///< the last contacts
  std::optional<geometry::SegmentIndex> edge_;  ///< of what falls, once asked for
  bool ragged_ = false;                         ///< it has corners of what was cut from it
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
  const auto height_of = [&](const Patch& patch) {
    const std::size_t top = patch.contacts.empty() ? stack.levels.size() - 1 : patch.contacts.back().first;
    return stack.levels[top].z - room.object().floor;
  };
  // What gets wider on the way down meets others.
  const bool wider = drawn || s.support_normal_shape == SupportShape::grid || s.support_use_towers ||
                     (s.support_conical_enabled && s.support_conical_angle < 0);
  if (wider) {
    Patch all;
    for (std::size_t k = 0; k < contacts.size(); ++k)
      if (!contacts[k].empty()) all.contacts.push_back({k, contacts[k]});
    return Falling(room, stack, shadow, height_of(all)).under(all, drawn ? &given : nullptr);
  }
  const Patches patches(contacts, apart(s, room.object().nozzle));
  auto of_patch = tasks::parallel_map(patches.all().size(), [&](std::size_t i) {
    const Patch& patch = patches.all()[i];
    return Falling(room, stack, shadow, height_of(patch)).under(patch, nullptr);
  });
  std::vector<Regions> out(stack.levels.size());
  for (auto& levels : of_patch)
    for (std::size_t k = 0; k < levels.size(); ++k)
      out[k].insert(out[k].end(), std::make_move_iterator(levels[k].begin()), std::make_move_iterator(levels[k].end()));
  // What got wider may meet others.
  tasks::for_each_index(out.size(), [&](std::size_t k) { out[k] = geometry::joined(out[k]); });
  return out;
}

}  // namespace weft::support
