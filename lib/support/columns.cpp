// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/columns.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/clip_lines.h"
#include "geometry/nudge.h"
#include "geometry/simplify.h"
#include "geometry/touching.h"
#include "geometry/trimmed.h"
#include "support/branch_areas.h"
#include "support/lengths.h"
#include "support/near_edge.h"
#include "support/patches.h"
#include "support/resting.h"
#include "support/steady.h"
#include "support/thin.h"
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
  return geometry::simplified(without_thin(out, line_ * 4 / 10), coarse_outline);
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

TowersAndOthers for_towers(const SupportSettings& settings, const std::vector<Regions>& contacts) {
  TowersAndOthers out{std::vector<Regions>(contacts.size()), std::vector<Regions>(contacts.size())};
  for (std::size_t k = 0; k < contacts.size(); ++k)
    for (const Region& region : contacts[k])
      (on_tower(settings, region) ? out.towers : out.others)[k].push_back(region);
  return out;
}

namespace {

/// Corners of what the part cut from columns are none where they lie nearer to the straight line: a seventh of a bead,
/// beside which the part is ten times as far.
constexpr Um corner_bound = 60_um;

/// Columns of one patch.
class Falling {
 public:
  /// @param height  of the highest of them
  /// @param first  the same columns before: where what they lost had nothing below, seen from above, these slide down
  ///               slopes. Down to there they are the same
  Falling(const Room& room, const Stack& stack, const std::vector<Regions>& shadow, Um height,
          const Falling* first = nullptr)
      : s_(room.settings()),
        room_(room),
        stack_(stack),
        shadow_(shadow),
        line_(line_width(s_, room.object().nozzle)),
        first_(first),
        same_(first != nullptr && !s_.support_conical_enabled && !s_.support_use_towers),
        sliding_(first != nullptr ? grown(first->lost_, 2 * line_) : Regions{}),
        lean_(s_, line_, height),
        towers_(s_),
        levels_(stack.levels.size()),
        steps_(stack.levels.size()) {
    const bool wider = s_.support_conical_enabled && s_.support_conical_angle < 0;
    if (!wider && !s_.support_use_towers) steady_.emplace(line_);
  }

  /// From the highest level down, once.
  const std::vector<Regions>& under(const Patch& patch, const std::vector<Regions>* given) {
    auto next = patch.contacts.rbegin();
    static const Regions none;
    for (std::size_t k = stack_.levels.size(); k-- > 0;) {
      const bool contact = next != patch.contacts.rend() && next->first == k;
      const Regions& held = contact ? (next++)->second : none;
      if (falling_.empty() && held.empty() && (given == nullptr || (*given)[k].empty())) continue;
      stop_if_asked();
      begin(k, held, given != nullptr ? (*given)[k] : none);
      steps_[k].begun = falling_;
      clear(k, held);
      steps_[k].cleared = levels_[k] = falling_;
      steps_[k].ragged = ragged_;
    }
    let_rest();
    return levels_;
  }
  std::vector<Regions> levels() && { return std::move(levels_); }
  /// What had nothing below, seen from above.
  const Regions& lost() const { return lost_; }

 private:
  /// What begins on that level, and what comes down from above.
  void begin(std::size_t k, const Regions& contacts, const Regions& given) {
    const auto& level = stack_.levels[k];
    if (same_) {
      if (steady_) steady_->begin(contacts, level.z);
      falling_ = first_->steps_[k].begun;
      return edge_.reset();
    }
    if (s_.support_conical_enabled && !falling_.empty() && lean_.narrow(level.height, falling_))
      edge_.reset(), steps_[k].less = true;
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
    if (same_) return clear_as_before(k, contacts.empty());
    if (contacts.empty() && (shadow_.empty() || shadow_[k].empty()) && room_.stands_free(falling_, edge(), level))
      return;
    if (ragged_ || !contacts.empty()) falling_ = geometry::simplified(falling_, corner_bound), edge_.reset();
    ragged_ = false;
    const bool shaded = !shadow_.empty() && !shadow_[k].empty(), slides = !sliding_.empty() && contacts.empty();
    Step& step = steps_[k];
    step.whole = falling_;
    const Um least = thin();
    Regions left;
    for (Region& region : falling_) {
      auto [free, cut] = free_of(region, k, shaded);
      ragged_ = ragged_ || cut;
      step.freed.push_back({step.left.size(), free.size(), cut});
      append(step.left, free);
      if (!cut)
        left.push_back(std::move(region));
      else
        append(left, slides ? std::move(free) : without_thin(free, least));
    }
    if (!ragged_) return void(falling_ = std::move(left));
    if (slides) slide(k, step.whole, left), left = without_thin(left, least);
    falling_ = std::move(left);
    edge_.reset();
    step.less = true;
  }
  struct Free {
    Regions area;
    bool cut = false;
  };
  /// What of a region has room on a level: what the first of two falls found of the same one, or else asked for.
  Free free_of(const Region& region, std::size_t k, bool shaded) const {
    if (first_ != nullptr) {
      const Step& before = first_->steps_[k];
      const auto same = std::find(before.whole.begin(), before.whole.end(), region);
      if (same != before.whole.end()) {
        const Freed& freed = before.freed[static_cast<std::size_t>(same - before.whole.begin())];
        const auto from = before.left.begin() + static_cast<std::ptrdiff_t>(freed.first);
        return {{from, from + static_cast<std::ptrdiff_t>(freed.count)}, freed.cut};
      }
    }
    Free out{{}, shaded};
    out.area = room_.free_part({region}, stack_.levels[k], close_, shaded ? nullptr : &out.cut, &above_);
    if (shaded) out.area = geometry::subtract(out.area, shadow_[k]);
    return out;
  }
  /// What the same columns did before, unless they slide.
  void clear_as_before(std::size_t k, bool may_slide) {
    const Step& before = first_->steps_[k];
    Step& step = steps_[k];
    step = before;
    falling_ = before.cleared, ragged_ = before.ragged;
    edge_.reset();
    if (!may_slide || !before.less) return;
    Regions left = before.left;
    if (!slide(k, before.whole, left)) return;
    falling_ = without_thin(left, thin()), ragged_ = true, same_ = false;
  }
  Um thin() const { return line_ * 4 / 10; }
  /// Beside a slope too steep to stand on a column gets thinner level by level, until nothing is left to stand on:
  /// what is thinner than two lines there gets as much wider on its other side as lets what is above rest on it, and so
  /// slides down along the slope. @return whether any does
  bool slide(std::size_t k, const Regions& above, Regions& left) {
    const Box there = box_of(sliding_).grown(4 * line_);  // discs of a line's radius tell what is thin
    const Regions near = geometry::trimmed(left, there);
    if (near.empty()) return false;
    const Regions wide = geometry::offset(geometry::offset(near, {.by = -line_}), {.by = line_ + 20});
    const Regions thin = geometry::intersect(geometry::subtract(near, wide), sliding_);
    if (thin.empty()) return false;
    const Regions cut_beside =
        grown(geometry::opening(geometry::subtract(geometry::trimmed(above, there), near), 10), 2 * line_);
    const Regions squeezed = geometry::intersect(thin, cut_beside);
    if (squeezed.empty()) return false;
    Regions more = room_.free_part(grown(squeezed, line_ / 2), stack_.levels[k], close_, nullptr, &above_);
    if (!shadow_.empty() && !shadow_[k].empty()) more = geometry::subtract(more, shadow_[k]);
    append(left, more);
    left = geometry::unite(left);
    append(sliding_, more);
    sliding_ = geometry::unite(sliding_);
    return true;
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
    bool less_below = steps_[0].less;
    for (std::size_t k = 1; k < levels_.size(); ++k) {
      const bool less = steps_[k].less;
      if (first_ != nullptr && levels_[k - 1] == first_->levels_[k - 1] && levels_[k] == first_->steps_[k].cleared) {
        levels_[k] = first_->levels_[k];
        less_below = less || steps_[k].cleared != levels_[k];
      } else if (less_below && !levels_[k].empty()) {
        stop_if_asked();
        const double all_mm2 = area_mm2(levels_[k]);
        const Regions lost = rest_on(room_, stack_.levels[k], levels_[k - 1], levels_[k]);
        const double lost_mm2 = all_mm2 - area_mm2(levels_[k]);
        if (lost_mm2 > least_toe_mm2) {
          lost_ = geometry::unite(lost_, lost);
          add_toes(k, lost);
        }
        less_below = less || lost_mm2 > 0;
      } else {
        less_below = less;
      }
    }
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
  const Falling* first_;
  bool same_;               ///< so far as those
  Regions lost_, sliding_;  ///< seen from above: what had nothing below, and where columns slide
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
  /// What is left of a region.
  struct Freed {
    std::size_t first = 0, count = 0;  ///< of what is left of all
    bool cut = false;
  };
  struct Step {
    Regions begun, whole,
        left;                  ///< after what begins there; of that, what was cut, and what is left with its thin ends
    std::vector<Freed> freed;  ///< of each region of the whole
    Regions cleared;           ///< what is left, whether it rests or not
    bool ragged = false;
    bool less = false;  ///< it is not all of what lies above it
  };
  std::vector<Step> steps_;  ///< by level
};

}  // namespace

Um apart(const SupportSettings& s, Um nozzle) {
  return std::max<Um>(s.support_join_distance, 4 * line_width(s, nozzle)) + 0.1_mm;
}

std::vector<Regions> columns(const Room& room, const Stack& stack, const std::vector<Regions>& contacts,
                             const std::vector<Regions>& given, tasks::Spare& spare, const Patches* known) {
  if (stack.levels.empty()) return {};  // what is so near to the plate has no room for any
  const auto& s = room.settings();
  std::vector<Regions> shadow;
  if (s.support_type == SupportType::buildplate) shadow = shadows(room, stack);
  const bool drawn = std::any_of(given.begin(), given.end(), [](const Regions& r) { return !r.empty(); });
  const auto height_of = [&](const Patch& patch) {
    const std::size_t top = patch.contacts.empty() ? stack.levels.size() - 1 : patch.contacts.back().first;
    return stack.levels[top].z - room.object().floor;
  };
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
      if (!bare.empty()) left_mm2 += area_mm2(geometry::subtract(bare, grown(levels[k], reached)));
    }
    return left_mm2 > s.minimum_support_area;
  };
  const auto under = [&](const Patch& patch, const std::vector<Regions>* drawn_there) {
    Falling falling(room, stack, shadow, height_of(patch));
    const auto& levels = falling.under(patch, drawn_there);
    if (falling.lost().empty() || !leaves_some(patch, levels)) return std::move(falling).levels();
    Falling sliding(room, stack, shadow, height_of(patch), &falling);
    sliding.under(patch, drawn_there);
    return std::move(sliding).levels();
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
