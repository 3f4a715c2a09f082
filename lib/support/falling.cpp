// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/falling.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/clip_lines.h"
#include "geometry/simplify.h"
#include "support/columns.h"
#include "support/lengths.h"
#include "support/resting.h"
#include "support/steady.h"
#include "support/thin.h"
#include "support/towers.h"

#include <algorithm>
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

/// Corners of what the part cut from columns are none where they lie nearer to the straight line: a seventh of a bead,
/// beside which the part is ten times as far.
constexpr Um corner_bound = 60_um;

class Falling {
 public:
  Falling(const Air& air, Um height)
      : s_(air.room.settings()), air_(air), line_(air.line()), lean_(s_, line_, height), towers_(s_), held_(air) {
    out_.steps.resize(air.stack.levels.size()), out_.levels.resize(air.stack.levels.size());
    if (may_get_steadier(s_)) steady_.emplace(line_);
  }

  /// From the highest level down, once.
  Fallen under(const Patch& patch, const std::vector<Regions>* given) && {
    auto next = patch.contacts.rbegin();
    static const Regions none;
    for (std::size_t k = air_.stack.levels.size(); k-- > 0;) {
      const bool contact = next != patch.contacts.rend() && next->first == k;
      const Regions& held = contact ? (next++)->second : none;
      if (falling_.empty() && held.empty() && (given == nullptr || (*given)[k].empty())) continue;
      stop_if_asked();
      begin(k, held, given != nullptr ? (*given)[k] : none);
      clear(k, held);
      out_.steps[k].cleared = out_.levels[k] = falling_;
    }
    let_rest();
    return std::move(out_);
  }

 private:
  /// What begins on that level, and what comes down from above.
  void begin(std::size_t k, const Regions& contacts, const Regions& given) {
    const auto& level = air_.stack.levels[k];
    if (s_.support_conical_enabled && !falling_.empty() && lean_.narrow(level.height, falling_))
      edge_.reset(), out_.steps[k].less = true;
    if (steady_ && steady_->widen(level.z, falling_)) edge_.reset();
    if (steady_) steady_->begin(contacts, level.z);
    towers_.begin(contacts, level.z);
    if (towers_.add(level.z, falling_) || !contacts.empty() || !given.empty()) edge_.reset();
    if (!contacts.empty()) {
      const Regions fresh = shaped(s_, air_.room.object(), contacts);
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
    held_.go_to(k, contacts);
    if (contacts.empty() && !air_.shaded(k) && stands_free(k)) return;
    if (ragged_ || !contacts.empty()) falling_ = geometry::simplified(falling_, corner_bound), edge_.reset();
    ragged_ = false;
    Fallen::Step& step = out_.steps[k];
    Regions left;
    for (const Region& region : falling_) {
      bool cut = false;
      const Regions free = air_.free_part({region}, k, held_, cut);
      ragged_ = ragged_ || cut;
      append(step.left, free);
      append(left, cut ? without_thin(free, thin_column(line_)) : free);
    }
    if (ragged_) {
      step.whole = std::move(falling_), step.less = true;
      edge_.reset();
    }
    falling_ = std::move(left);
  }
  bool stands_free(std::size_t k) {
    const auto* levels = air_.stack.levels.data();
    const bool as_above = edge_ && free_at_ == k + 1;  // nothing changed since
    if (!air_.room.stands_free(falling_, edge(), levels[k], as_above ? &levels[k + 1] : nullptr)) return false;
    free_at_ = k;
    return true;
  }
  const geometry::SegmentIndex& edge() {
    if (!edge_) edge_.emplace(falling_);
    return *edge_;
  }
  /// From the bottom up: where the level below is no less than this one, all of it rests.
  void let_rest() {
    bool less_below = out_.steps[0].less;
    for (std::size_t k = 1; k < out_.levels.size(); ++k) {
      bool less = out_.steps[k].less;
      if (less_below && !out_.levels[k].empty()) {
        stop_if_asked();
        less |= rest_or_reach(air_.room, air_.stack.levels[k], out_.levels[k - 1], out_.levels[k], out_.lost);
      }
      less_below = less;
    }
  }

  const SupportSettings& s_;
  const Air& air_;
  Um line_;
  Lean lean_;
  std::optional<Steady> steady_;
  Towers towers_;
  ContactsAbove held_;
  Regions falling_;
  std::optional<geometry::SegmentIndex> edge_;  ///< of what falls, once asked for
  std::optional<std::size_t> free_at_;          ///< the last level on which it stood free
  bool ragged_ = false;                         ///< it has corners of what was cut from it
  Fallen out_;
};

}  // namespace

void ContactsAbove::go_to(std::size_t level, const Regions& contacts) {
  constexpr std::size_t last = 2;
  if (!contacts.empty()) {
    const auto& s = air_.room.settings();
    const bool has_roof = s.support_roof_enable && s.support_roof_height > 0;
    held_.push_back(
        {level, has_roof ? interface_levels(air_.stack, level, s.support_roof_height) + 1 : last, contacts});
  }
  std::erase_if(held_, [level](const Held& held) { return held.level >= level + held.leaning; });
  close_.clear(), above_.clear();
  for (const Held& held : held_) append(held.level < level + last ? close_ : above_, held.contacts);
}

Regions Air::free_part(const Regions& area, std::size_t level, const ContactsAbove& held, bool& cut) const {
  const Regions out = room.free_part(area, stack.levels[level], held.close(), &cut, &held.above());
  if (!shaded(level)) return out;
  cut = true;
  return geometry::subtract(out, shadow[level]);
}

bool may_get_steadier(const SupportSettings& s) {
  const bool wider = s.support_conical_enabled && s.support_conical_angle < 0;
  return !wider && !s.support_use_towers;
}

Fallen fall(const Air& air, const Patch& patch, const std::vector<Regions>* given, Um height) {
  return Falling(air, height).under(patch, given);
}

}  // namespace weft::support
