// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/brackets.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/trimmed.h"
#include "support/lengths.h"
#include "support/thin.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace weft::support {
namespace {

/// A bracket for one place, from the level that it grows out of a branch on up to the one that it holds.
struct Bracket {
  std::size_t first = 0;
  std::vector<Regions> areas;  ///< empty: there is none
};

class Brackets {
 public:
  Brackets(const Room& room, const Stack& stack, const std::vector<Regions>& contacts,
           const std::vector<Regions>& branches)
      : room_(room),
        stack_(stack),
        contacts_(contacts),
        branches_(branches),
        line_(line_width(room.settings(), room.object().nozzle)),
        lean_(std::tan(room.settings().support_tree_angle * std::numbers::pi / 180)) {}

  /// Whether a column under it would tip over.
  bool is_slender(std::size_t k, const Region& place) const {
    constexpr double steady = 8;  // height by width
    const Point size = box_of(place.outer).size();
    const Um wide = std::max(std::min(size.x, size.y), 2 * line_);
    return stack_.levels[k].z - room_.object().floor > steady * wide;
  }

  Bracket under(std::size_t k, const Region& place) const {
    const Regions held{place};
    const Box near = box_of(place.outer).grown(farthest + line_);
    if (geometry::trimmed(branches_[k], near).empty()) return {};
    const auto room = room_below(k, held);
    if (room.empty()) return {};
    std::vector<Regions> grown_up(room.size());
    for (std::size_t i = room.size(); i-- > 0;) {  // upwards, from what is a branch there
      if (k == i) continue;
      Regions base = geometry::trimmed(branches_[k - i - 1], near);
      if (i + 1 < room.size()) append(base, grown_up[i + 1]);
      if (!base.empty()) grown_up[i] = geometry::intersect(room[i], grown(geometry::unite(base), reach(k - i)));
    }
    if (!geometry::opening(geometry::subtract(held, grown(grown_up.front(), reached)), sliver).empty()) return {};
    return needed(k, near, std::move(grown_up));
  }

 private:
  static constexpr Um farthest = 3_mm;  // from what it holds: it is as high as that, and a branch further off holds it
  static constexpr Um sliver = 50_um;

  Um reach(std::size_t k) const { return rounded(stack_.levels[k].height * lean_); }

  /// Where it may be, from the level that holds it downwards.
  std::vector<Regions> room_below(std::size_t k, const Regions& held) const {
    std::vector<Regions> out;
    Regions wide = held;
    thicken(wide, held, line_);
    const Box most = box_of(held).grown(farthest);
    const Um lowest = stack_.levels[k].z - 2 * farthest;
    for (std::size_t j = k + 1; j-- > 0 && stack_.levels[j].z > lowest;) {
      stop_if_asked();
      Regions free =
          without_thin(room_.free_part(wide, stack_.levels[j], j + 2 > k ? contacts_[k] : Regions{}), line_ * 4 / 10);
      if (free.empty()) break;
      wide = geometry::trimmed(grown(free, reach(j)), most);
      out.push_back(std::move(free));
    }
    return out;
  }

  /// What of it carries what it holds, down to where that is a branch.
  Bracket needed(std::size_t k, const Box& near, std::vector<Regions> areas) const {
    std::size_t depth = 0;
    for (; depth < areas.size(); ++depth) {
      if (depth > 0) areas[depth] = geometry::intersect(areas[depth], grown(areas[depth - 1], reach(k + 1 - depth)));
      if (geometry::subtract(areas[depth], geometry::trimmed(branches_[k - depth], near)).empty()) break;
    }
    areas.resize(depth);
    std::reverse(areas.begin(), areas.end());
    return {k + 1 - depth, std::move(areas)};
  }

  const Room& room_;
  const Stack& stack_;
  const std::vector<Regions>&contacts_, &branches_;
  Um line_;
  double lean_;
};

}  // namespace

void hang_on(const Room& room, const Stack& stack, const std::vector<Regions>& contacts, std::vector<Regions>& branches,
             std::vector<Regions>& left) {
  const Brackets brackets(room, stack, contacts, branches);
  const auto of_level = tasks::parallel_map(left.size(), [&](std::size_t k) {
    std::vector<Bracket> out;
    for (const Region& place : left[k])
      out.push_back(brackets.is_slender(k, place) ? brackets.under(k, place) : Bracket{});
    return out;
  });
  std::vector<char> more(branches.size(), 0);
  for (std::size_t k = 0; k < left.size(); ++k) {
    Regions kept;
    for (std::size_t i = 0; i < left[k].size(); ++i) {
      const Bracket& bracket = of_level[k][i];
      if (bracket.areas.empty()) kept.push_back(std::move(left[k][i]));
      for (std::size_t j = 0; j < bracket.areas.size(); ++j)
        append(branches[bracket.first + j], bracket.areas[j]), more[bracket.first + j] = 1;
    }
    left[k] = std::move(kept);
  }
  for (std::size_t k = 0; k < branches.size(); ++k)
    if (more[k] != 0) branches[k] = geometry::unite(branches[k]);
}

}  // namespace weft::support
