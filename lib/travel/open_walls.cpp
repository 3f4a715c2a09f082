#include "travel/open_walls.h"

#include "travel/blocks.h"
#include "travel/wall_order.h"

#include <algorithm>

namespace weft::travel {
namespace {

/// Or-opt on one kind of stop: runs of open walls are taken out and put in wherever that shortens the way.
class Fitting {
 public:
  Fitting(const Beads& beads, std::span<Turn> turns, const TourEnds& ends) : beads_(beads), turns_(turns), ends_(ends) {
    entry_.reserve(turns.size()), exit_.reserve(turns.size());
    for (const auto& t : turns) {
      entry_.push_back(begin_of(beads[t.bead], t));
      exit_.push_back(end_of(beads[t.bead], t));
    }
  }

  void run() {
    // Every run is tried in every gap. With thousands of each, as between the holes of a sieve, that was most of the
    // time: a plate of 5,000 holes takes 5.2 s, and without the limit 17.3 s.
    std::size_t open_walls = 0;
    for (std::size_t i = 0; i < turns_.size(); ++i) open_walls += open(i) ? 1U : 0U;
    if (open_walls * turns_.size() > most_pairs) return;
    for (int pass = 0; pass < most_passes; ++pass) {
      bool better = false;
      for (std::size_t i = 0; i < turns_.size(); ++i)
        for (std::size_t length = 1; length <= longest_run && i + length <= turns_.size() && open(i + length - 1);
             ++length)
          if (improve(i, length)) {
            better = true;
            break;  // another bead stands at i now
          }
      if (!better) return;
    }
  }

 private:
  static constexpr std::size_t most_pairs = 20'000'000;  ///< chosen, not measured
  static constexpr int most_passes = 4;
  static constexpr std::size_t longest_run = 4;
  static constexpr double least_gain_um = 1.0;

  bool open(std::size_t i) const {
    const Bead& bead = beads_[turns_[i].bead];
    return !bead.closed && bead.sequence == 0 && is_wall(bead.role);
  }
  static double hop(std::optional<Point> a, std::optional<Point> b) { return a && b ? distance(*a, *b) : 0.0; }
  std::optional<Point> left(std::size_t gap) const { return gap == 0 ? ends_.from : std::optional(exit_[gap - 1]); }
  std::optional<Point> next(std::size_t gap) const {
    return gap == turns_.size() ? ends_.to : std::optional(entry_[gap]);
  }

  bool improve(std::size_t first, std::size_t length) {
    const std::size_t end = first + length;
    const Point head = entry_[first], tail = exit_[end - 1];
    const double gain = hop(left(first), head) + hop(tail, next(end)) - hop(left(first), next(end));
    double best = gain - least_gain_um;
    std::size_t where = first;
    bool turned = false;
    const auto consider = [&](std::size_t gap, std::optional<Point> from, std::optional<Point> to) {
      const double whole = hop(from, to);
      const double ahead = hop(from, head) + hop(tail, to) - whole, back = hop(from, tail) + hop(head, to) - whole;
      if (ahead < best) best = ahead, where = gap, turned = false;
      if (back < best) best = back, where = gap, turned = true;
    };
    for (std::size_t gap = 0; gap < first; ++gap) consider(gap, left(gap), next(gap));
    consider(first, left(first), next(end));
    for (std::size_t gap = end + 1; gap <= turns_.size(); ++gap) consider(gap, left(gap), next(gap));
    if (where == first && !turned) return false;
    if (turned) turn_around(first, end);
    move(first, end, where);
    return true;
  }

  void turn_around(std::size_t first, std::size_t end) {
    std::reverse(turns_.begin() + at(first), turns_.begin() + at(end));
    for (std::size_t i = first; i < end; ++i) turns_[i].reversed = !turns_[i].reversed;
    std::reverse(entry_.begin() + at(first), entry_.begin() + at(end));
    std::reverse(exit_.begin() + at(first), exit_.begin() + at(end));
    for (std::size_t i = first; i < end; ++i) std::swap(entry_[i], exit_[i]);
  }

  void move(std::size_t first, std::size_t end, std::size_t gap) {
    if (gap == first) return;
    const std::size_t low = std::min(first, gap), high = std::max(end, gap), middle = gap < first ? first : end;
    const auto rotate = [&](auto& list) {
      std::rotate(list.begin() + at(low), list.begin() + at(middle), list.begin() + at(high));
    };
    rotate(turns_), rotate(entry_), rotate(exit_);
  }
  static std::ptrdiff_t at(std::size_t i) { return static_cast<std::ptrdiff_t>(i); }

  const Beads& beads_;
  std::span<Turn> turns_;
  const TourEnds& ends_;
  std::vector<Point> entry_, exit_;
};

}  // namespace

void fit_open_walls(const Beads& beads, std::span<Turn> turns, const TourEnds& ends) {
  Fitting(beads, turns, ends).run();
}

}  // namespace weft::travel
