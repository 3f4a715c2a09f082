// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/touching.h"
#include "geometry/trimmed.h"
#include "support/falling.h"
#include "support/resting.h"
#include "support/steady.h"
#include "support/thin.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace weft::support {
namespace {

/// Regions of one that are none of the others.
Regions other_than(const Regions& regions, const Regions& others) {
  Regions out;
  for (const Region& region : regions)
    if (std::find(others.begin(), others.end(), region) == others.end()) out.push_back(region);
  return out;
}

/// With more beside them: those that it meets become one with it, the others stay as they are.
Regions joined_to(const Regions& regions, const Regions& more) {
  if (more.empty()) return regions;
  Regions all = regions, out;
  append(all, more);
  for (const auto& set : geometry::overlapping(all)) {
    Regions some;
    for (const std::size_t i : set) some.push_back(std::move(all[i]));
    const bool met = set.size() > 1 && set.back() >= regions.size();
    append(out, met ? geometry::unite(some) : some);
  }
  return out;
}

class Sliding {
 public:
  Sliding(const Air& air, const Fallen& first)
      : air_(air),
        first_(first),
        line_(air.line()),
        where_(grown(first.lost, 2 * line_)),
        held_(air),
        slid_(first.steps.size()),
        levels_(first.steps.size()) {
    if (may_get_steadier(air.room.settings())) steady_.emplace(line_);
  }

  std::vector<Regions> beside(const Patch& patch) && {
    auto next = patch.contacts.rbegin();
    static const Regions none;
    for (std::size_t k = levels_.size(); k-- > 0;) {
      const bool contact = next != patch.contacts.rend() && next->first == k;
      const Regions& contacts = contact ? (next++)->second : none;
      const Fallen::Step& step = first_.steps[k];
      held_.go_to(k, contacts);
      const Regions above = come_down(k, contacts);
      if (contacts.empty() && (cut_ || step.less)) slide(k, step, above);
      if (cut_) falling_ = without_thin(falling_, thin_column(line_));
      slid_[k] = falling_;
      levels_[k] = joined_to(step.cleared, falling_);
    }
    let_rest();
    return std::move(levels_);
  }

 private:
  static Regions with(Regions some, const Regions& more) {
    append(some, more);
    return some;
  }
  /// @return what comes down to that level; what of it has room there goes on
  Regions come_down(std::size_t k, const Regions& contacts) {
    cut_ = false;
    const Um z = air_.stack.levels[k].z;
    bool alone = false;
    if (!falling_.empty()) {
      Regions all = other_than(levels_[k + 1], first_.steps[k + 1].cleared);
      alone = all == falling_;
      if (steady_ && steady_->widen(z, all)) falling_ = std::move(all);
    }
    if (steady_) steady_->begin(contacts, z);
    if (falling_.empty()) return {};
    stop_if_asked();
    if (alone && !contacts.empty()) join(first_.steps[k].cleared);
    Regions free = air_.free_part(falling_, k, held_, cut_);
    std::swap(free, falling_);
    return free;
  }
  /// Gaps to others below that begin beside what slides alone, where they are no wider than what is to be one column.
  void join(const Regions& others) {
    const Um by = std::max(air_.room.settings().support_join_distance / 2, 0);
    const Box there = box_of(falling_).grown(2 * by);
    const Regions all = geometry::joined(with(geometry::trimmed(others, there.grown(2 * by)), falling_));
    Regions gaps = geometry::subtract(closed(all, by), all);
    std::erase_if(gaps, [&](const Region& gap) { return !there.overlaps(box_of(gap.outer)); });
    if (!gaps.empty()) falling_ = geometry::unite(falling_, grown(gaps, beside_by));
  }
  /// Beside a slope too steep to stand on a column gets thinner level by level, until nothing is left to stand on:
  /// what is thinner than two lines there gets as much wider on its other side as lets what is above rest on it, and so
  /// slides down along the slope.
  /// @param above  what slid before, before that level cut it
  void slide(std::size_t k, const Fallen::Step& step, const Regions& above) {
    const Box there = box_of(where_).grown(4 * line_);  // discs of a line's radius tell what is thin
    const bool whole = step.left.empty();
    const auto near_with = [&](const Regions& all, const Regions& more) {
      return geometry::joined(with(geometry::trimmed(all, there), more));
    };
    const Regions near = near_with(whole ? step.cleared : step.left, falling_);
    if (near.empty()) return;
    const Regions wide = geometry::offset(geometry::offset(near, {.by = -line_}), {.by = line_ + 20});
    const Regions thin = geometry::intersect(geometry::subtract(near, wide), where_);
    if (thin.empty()) return;
    const Regions cut = geometry::subtract(near_with(whole ? step.cleared : step.whole, above), near);
    const Regions squeezed = geometry::intersect(thin, grown(geometry::opening(cut, 10), 2 * line_));
    if (squeezed.empty()) return;
    bool any = false;
    const Regions more = air_.free_part(grown(squeezed, line_ / 2), k, held_, any);
    falling_ = geometry::unite(falling_, more), where_ = geometry::unite(where_, more);
    cut_ = true;
  }
  /// From the bottom up: what rested rests again, as there is no less below it.
  void let_rest() {
    Regions lost;  // does not slide again
    for (std::size_t k = 1; k < levels_.size(); ++k) {
      const Fallen::Step& step = first_.steps[k];
      const Regions& rested = first_.levels[k];
      if (slid_[k].empty() && (levels_[k - 1] == first_.levels[k - 1] || rested == step.cleared)) {
        levels_[k] = rested;
        continue;
      }
      stop_if_asked();
      Regions asked = with(other_than(step.cleared, rested), slid_[k]);
      rest_or_reach(air_.room, air_.stack.levels[k], levels_[k - 1], asked, lost);
      levels_[k] = joined_to(rested, asked);
    }
  }

  const Air& air_;
  const Fallen& first_;
  Um line_;
  Regions where_;  ///< seen from above
  std::optional<Steady> steady_;
  ContactsAbove held_;
  Regions falling_;                     ///< what slides
  bool cut_ = false;                    ///< something was taken from it or added
  std::vector<Regions> slid_, levels_;  ///< by level: what slides, and with all others
};

}  // namespace

std::vector<Regions> slid(const Air& air, const Patch& patch, const Fallen& first) {
  return Sliding(air, first).beside(patch);
}

}  // namespace weft::support
