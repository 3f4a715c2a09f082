// SPDX-License-Identifier: GPL-3.0-or-later
#include "travel/open_walls.h"

#include "core/stop.h"
#include "travel/blocks.h"
#include "travel/box_tree.h"
#include "travel/wall_order.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace weft::travel {
namespace {

/// Or-opt on one kind of stop: runs of open walls are taken out and put in wherever that shortens the way.
///
/// A turn is known by its index in the list as it came; the gap before it has the same index, and the gap behind the
/// last turn is n. Turns are linked to those before and behind, with n as both ends of the list, so that moving a run
/// costs nothing; labels that rise along the list say which of two gaps comes first.
class Fitting {
 public:
  Fitting(const Beads& beads, std::span<Turn> turns, const TourEnds& ends)
      : turns_(turns.begin(), turns.end()), ends_(ends), n_(static_cast<std::uint32_t>(turns.size())) {
    for (const auto& t : turns_) {
      entry_.push_back(begin_of(beads[t.bead], t));
      exit_.push_back(end_of(beads[t.bead], t));
      open_.push_back(is_open_wall(beads[t.bead]));
    }
    next_.resize(n_ + 1), before_.resize(n_ + 1), label_.resize(n_ + 1);
    for (std::uint32_t i = 0; i <= n_; ++i) next_[i] = i < n_ ? i + 1 : 0, before_[i] = i > 0 ? i - 1 : n_;
    number();
    std::vector<Box> boxes;
    for (std::uint32_t gap = 0; gap <= n_; ++gap) boxes.push_back(box_of_gap(gap));
    tree_.emplace(boxes);
    for (std::uint32_t gap = 0; gap <= n_; ++gap) settle(gap);
  }

  void run() {
    for (int pass = 0; pass < most_passes; ++pass) {
      bool better = false;
      for (std::uint32_t first = next_[n_]; first != n_; first = next_[first]) {
        stop_if_asked();
        std::uint32_t last = first;
        for (std::uint32_t length = 1; length <= longest_run && last != n_ && open_[last]; ++length, last = next_[last])
          if (const auto place = better_place(first, last)) {
            first = move(first, last, length, *place);
            better = true;
            break;  // another bead stands there now
          }
      }
      if (!better) return;
    }
  }

  void write(std::span<Turn> turns) const {
    std::size_t k = 0;
    for (std::uint32_t i = next_[n_]; i != n_; i = next_[i]) turns[k++] = turns_[i];
  }

  static bool is_open_wall(const Bead& bead) { return !bead.closed && bead.sequence == 0 && is_wall(bead.role); }

 private:
  static constexpr int most_passes = 4;
  static constexpr std::uint32_t longest_run = 4;
  static constexpr double least_gain_um = 1.0;
  static constexpr double rounding_um = 0.01;  ///< of sums of a few distances, and more

  /// Where a run may go.
  struct Place {
    std::uint32_t gap;
    bool turned;
  };

  static double hop(std::optional<Point> a, std::optional<Point> b) { return a && b ? distance(*a, *b) : 0.0; }
  std::optional<Point> left(std::uint32_t gap) const {
    return before_[gap] == n_ ? ends_.from : std::optional(exit_[before_[gap]]);
  }
  std::optional<Point> right(std::uint32_t gap) const { return gap == n_ ? ends_.to : std::optional(entry_[gap]); }

  /// Empty where the gap has an open end: such ones, at most two, are looked at one by one.
  Box box_of_gap(std::uint32_t gap) const {
    Box box;
    if (const auto a = left(gap), b = right(gap); a && b) box.add(*a), box.add(*b);
    return box;
  }
  void settle(std::uint32_t gap) { tree_->set(gap, box_of_gap(gap), hop(left(gap), right(gap))); }

  /// Where the run from first to last, its own place left out, makes the way shorter than anywhere else.
  std::optional<Place> better_place(std::uint32_t first, std::uint32_t last) const {
    const std::uint32_t behind = next_[last];
    const Point head = entry_[first], tail = exit_[last];
    double best = hop(left(first), head) + hop(tail, right(behind)) - hop(left(first), right(behind)) - least_gain_um;
    std::optional<Place> place;
    const auto try_one = [&](double way, Place there) {  // of equals the first in the list, ahead before turned around
      if (way > best || (way == best && (!place || label_[there.gap] > label_[place->gap] || place->gap == there.gap)))
        return;
      best = way, place = there;
    };
    const auto look = [&](std::uint32_t gap) {
      if (gap == behind || (gap != first && label_[gap] > label_[first] && label_[gap] <= label_[last])) return best;
      const auto from = left(gap), to = right(gap == first ? behind : gap);
      const double whole = hop(from, to);
      try_one(hop(from, head) + hop(tail, to) - whole, {gap, false});
      try_one(hop(from, tail) + hop(head, to) - whole, {gap, true});
      return best;
    };
    if (!ends_.from) look(next_[n_]);
    if (!ends_.to) look(n_);
    look(first);
    tree_->search(
        best,
        [&](const Box& box, double length_um) {
          return std::sqrt(distance2_to(box, head)) + std::sqrt(distance2_to(box, tail)) - length_um - rounding_um;
        },
        look);
    return place;
  }

  /// @returns the turn that stands where `first` stood
  std::uint32_t move(std::uint32_t first, std::uint32_t last, std::uint32_t length, Place place) {
    const std::uint32_t behind = next_[last], gap = place.gap == first ? behind : place.gap;
    const bool forwards = label_[place.gap] > label_[last];
    std::vector<std::uint32_t> run;
    for (std::uint32_t i = first; i != behind; i = next_[i]) run.push_back(i);
    if (place.turned) {
      std::reverse(run.begin(), run.end());
      for (const std::uint32_t i : run) turns_[i].reversed = !turns_[i].reversed, std::swap(entry_[i], exit_[i]);
    }
    link(before_[first], behind);
    if (room_before(gap) <= static_cast<std::int64_t>(length)) number();
    const std::int64_t step = room_before(gap) / static_cast<std::int64_t>(length + 1);
    std::int64_t label = label_[gap] - room_before(gap);
    std::uint32_t at = before_[gap];
    for (const std::uint32_t i : run) link(at, i), at = i, label_[i] = label += step;
    link(at, gap);
    for (const std::uint32_t i : run) settle(i);
    settle(behind), settle(gap);
    if (place.gap == first) return run.front();
    if (forwards) return behind;
    std::uint32_t there = behind;
    for (std::uint32_t k = 0; k < length; ++k) there = before_[there];
    return there;
  }

  void link(std::uint32_t a, std::uint32_t b) { next_[a] = b, before_[b] = a; }

  std::int64_t room_before(std::uint32_t gap) const {
    return label_[gap] - (before_[gap] == n_ ? 0 : label_[before_[gap]]);
  }
  /// New labels along the list.
  void number() {
    std::int64_t label = 0;
    for (std::uint32_t i = next_[n_];; i = next_[i]) {
      label_[i] = label += std::int64_t{1} << 30;
      if (i == n_) return;
    }
  }

  std::vector<Turn> turns_;
  const TourEnds& ends_;
  std::uint32_t n_;
  std::vector<Point> entry_, exit_;
  std::vector<char> open_;
  std::vector<std::uint32_t> next_, before_;
  std::vector<std::int64_t> label_;
  std::optional<BoxTree> tree_;
};

}  // namespace

void fit_open_walls(const Beads& beads, std::span<Turn> turns, const TourEnds& ends) {
  const auto open = [&](const Turn& t) { return Fitting::is_open_wall(beads[t.bead]); };
  if (std::none_of(turns.begin(), turns.end(), open)) return;
  Fitting fitting(beads, turns, ends);
  fitting.run();
  fitting.write(turns);
}

}  // namespace weft::travel
