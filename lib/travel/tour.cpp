#include "travel/tour.h"

#include "travel/point_grid.h"

#include <algorithm>
#include <limits>

namespace weft::travel {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

Point entry_of(const Stop& s, bool reversed) {
  return reversed ? s.b : s.a;
}
Point exit_of(const Stop& s, bool reversed) {
  return reversed ? s.a : s.b;
}

/// Endpoints of all stops: 2i is a, 2i + 1 is b.
std::vector<Point> endpoints(std::span<const Stop> stops) {
  std::vector<Point> points;
  points.reserve(2 * stops.size());
  for (const auto& s : stops) points.push_back(s.a), points.push_back(s.b);
  return points;
}

std::vector<Visit> nearest_tour(std::span<const Stop> stops, const TourEnds& ends) {
  std::vector<Visit> visits;
  visits.reserve(stops.size());
  const auto points = endpoints(stops);
  PointGrid grid(points);
  std::vector<char> open(points.size(), 1);
  for (std::size_t i = 0; i < stops.size(); ++i)
    if (!stops[i].reversible) open[2 * i + 1] = 0, grid.remove(static_cast<std::uint32_t>(2 * i + 1));
  Point at = ends.from ? *ends.from : stops.front().a;
  while (visits.size() < stops.size()) {
    const std::uint32_t e = grid.nearest(at);
    const std::uint32_t stop = e / 2;
    const bool reversed = e % 2 != 0;
    visits.push_back({stop, reversed});
    for (const std::uint32_t end : {2 * stop, 2 * stop + 1})
      if (open[end]) grid.remove(end);
    at = exit_of(stops[stop], reversed);
  }
  return visits;
}

/// Local search on the order. Edge k lies before position k; edge n leads to the end.
class Search {
 public:
  Search(std::span<const Stop> stops, std::vector<Visit> visits, const TourEnds& ends)
      : stops_(stops), visits_(std::move(visits)), ends_(ends), n_(static_cast<int>(stops.size())) {
    position_.resize(stops.size());
    look_.assign(stops.size(), 1);
    for (int i = 0; i < n_; ++i) position_[visits_[at(i)].stop] = i;
    for (const auto& s : stops) any_fixed_ = any_fixed_ || !s.reversible;
    const auto points = endpoints(stops);
    neighbours_ = nearest_neighbours(points, neighbour_count);
    longest_move_ = n_ <= 4000 ? n_ : 1000;
  }

  std::vector<Visit> run() {
    // A move shortens the way by at least a micron, and the budget bounds the worst case.
    queue_.clear();
    for (const auto& v : visits_) queue_.push_back(v.stop);
    settle(40L * n_ + 1000);
    if (n_ >= fewest_to_kick && n_ <= most_to_kick) kick_and_settle();
    return std::move(visits_);
  }

 private:
  /// Looks at the stops of the queue, and at those that moves touch, until nothing more is gained.
  void settle(long budget) {
    for (std::size_t head = 0; head < queue_.size() && budget > 0; ++head, --budget) {
      const std::uint32_t stop = queue_[head];
      look_[stop] = 0;
      while (budget > 0 && improve(stop)) --budget;
      for (const std::uint32_t touched : touched_)
        if (!look_[touched]) look_[touched] = 1, queue_.push_back(touched);
      touched_.clear();
    }
    for (const std::uint32_t stop : queue_) look_[stop] = 0;
    queue_.clear();
  }

  /// Exchanges two neighbouring runs somewhere, which no single move can undo, lets the order settle, and keeps what is
  /// shorter. Source: Martin, Otto & Felten 1991, "Large-step Markov chains for the TSP" (double bridge).
  void kick_and_settle() {
    double length = way(stops_, visits_, ends_);
    auto kept = visits_;
    for (int kick = 0; kick < kicks_a_stop * n_; ++kick) {
      int cut[3];
      const int window = std::min(n_, kick_window),
                base = static_cast<int>(random(static_cast<std::uint32_t>(n_ - window + 1)));
      for (int& c : cut) c = base + static_cast<int>(random(static_cast<std::uint32_t>(window + 1)));
      std::sort(std::begin(cut), std::end(cut));
      if (cut[0] == cut[1] || cut[1] == cut[2]) continue;
      std::rotate(visits_.begin() + cut[0], visits_.begin() + cut[1], visits_.begin() + cut[2]);
      for (int i = cut[0]; i < cut[2]; ++i) position_[visits_[at(i)].stop] = i;
      for (const int c :
           {cut[0] - 1, cut[0], cut[0] + cut[2] - cut[1] - 1, cut[0] + cut[2] - cut[1], cut[2] - 1, cut[2]})
        if (c >= 0 && c < n_) queue_.push_back(visits_[at(c)].stop);
      settle(1000);
      const double now = way(stops_, visits_, ends_);
      if (now < length - least_gain_um) {
        length = now, kept = visits_;
      } else {
        visits_ = kept;
        for (int i = 0; i < n_; ++i) position_[visits_[at(i)].stop] = i;
      }
    }
  }

  /// A number below `end`, from a sequence that is the same for every tour (splitmix64).
  std::uint32_t random(std::uint32_t end) {
    std::uint64_t x = seed_ += 0x9E3779B97F4A7C15ULL;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
    return static_cast<std::uint32_t>(((x ^ (x >> 31)) >> 32) * end >> 32);
  }

  static constexpr int neighbour_count = 8;
  static constexpr int fewest_to_kick = 5, most_to_kick = 400, kick_window = 50;
  static constexpr int kicks_a_stop = 3;  // ten gain another 0.3 % at thrice the time
  static constexpr double least_gain_um = 1.0;
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  Point entry(int i) const { return entry_of(stops_[visits_[at(i)].stop], visits_[at(i)].reversed); }
  Point exit(int i) const { return exit_of(stops_[visits_[at(i)].stop], visits_[at(i)].reversed); }
  /// Way from what is left at position i to what is entered at position j.
  double hop(std::optional<Point> from, std::optional<Point> to) const {
    return from && to ? distance(*from, *to) : 0.0;
  }
  std::optional<Point> left(int i) const { return i < 0 ? ends_.from : std::optional(exit(i)); }
  std::optional<Point> entered(int i) const { return i >= n_ ? ends_.to : std::optional(entry(i)); }

  bool reversible(int first, int last) const {
    if (!any_fixed_) return true;
    for (int i = first; i <= last; ++i)
      if (!stops_[visits_[at(i)].stop].reversible) return false;
    return true;
  }

  void touch(int i) {
    if (i >= 0 && i < n_) touched_.push_back(visits_[at(i)].stop);
  }

  void reverse(int first, int last) {
    std::reverse(visits_.begin() + first, visits_.begin() + last + 1);
    for (int i = first; i <= last; ++i) {
      visits_[at(i)].reversed = !visits_[at(i)].reversed;
      position_[visits_[at(i)].stop] = i;
    }
  }

  /// 2-opt: turns the positions first … last around.
  bool try_reverse(int first, int last) {
    if (first > last || last - first >= longest_move_) return false;
    const auto before = left(first - 1), after = entered(last + 1);
    const double gain =
        hop(before, entry(first)) + hop(exit(last), after) - hop(before, exit(last)) - hop(entry(first), after);
    if (gain < least_gain_um || !reversible(first, last)) return false;
    reverse(first, last);
    touch(first - 1), touch(first), touch(last), touch(last + 1);
    return true;
  }

  /// Or-opt: takes positions first … last out and puts them between positions gap − 1 and gap, turned around or not.
  bool try_move(int first, int last, int gap, bool turned) {
    if (gap >= first && gap <= last + 1) return false;
    if (std::max(last, gap) - std::min(first, gap) >= longest_move_) return false;
    const auto before = left(first - 1), after = entered(last + 1), gap_from = left(gap - 1), gap_to = entered(gap);
    const Point head = turned ? exit(last) : entry(first), tail = turned ? entry(first) : exit(last);
    const double gain = hop(before, entry(first)) + hop(exit(last), after) + hop(gap_from, gap_to) -
                        hop(before, after) - hop(gap_from, head) - hop(tail, gap_to);
    if (gain < least_gain_um || (turned && !reversible(first, last))) return false;
    touch(first - 1), touch(first), touch(last), touch(last + 1), touch(gap - 1), touch(gap);
    if (turned) reverse(first, last);
    const int low = std::min(first, gap), high = std::max(last + 1, gap);
    const int middle = gap < first ? first : last + 1;
    std::rotate(visits_.begin() + low, visits_.begin() + middle, visits_.begin() + high);
    for (int i = low; i < high; ++i) position_[visits_[at(i)].stop] = i;
    return true;
  }

  /// Segments of up to three stops that begin (or end) at position i, put before `gap` so that position i comes first
  /// (or last).
  bool try_moves(int i, int gap, bool head_is_entry, bool to_gap_head) {
    for (int extra = 0; extra < 3; ++extra) {
      // The endpoint at i becomes the one next to the gap: the segment grows away from it.
      const int first = head_is_entry ? i : i - extra, last = head_is_entry ? i + extra : i;
      if (first < 0 || last >= n_) break;
      const bool turned = head_is_entry != to_gap_head;
      if (try_move(first, last, gap, turned)) return true;
    }
    return false;
  }

  bool improve(std::uint32_t stop) {
    const int i = position_[stop];
    if (try_reverse(i, i)) return true;
    const bool reversed = visits_[at(i)].reversed;
    for (const bool from_exit : {false, true}) {
      const std::uint32_t end = 2 * stop + ((from_exit != reversed) ? 1U : 0U);
      const Point here = from_exit ? exit(i) : entry(i);
      const double now = from_exit ? hop(here, entered(i + 1)) : hop(left(i - 1), here);
      for (int k = 0; k < neighbour_count; ++k) {
        const std::uint32_t other_end = neighbours_[std::size_t{end} * neighbour_count + static_cast<std::size_t>(k)];
        if (other_end == none) break;
        const std::uint32_t other = other_end / 2;
        if (other == stop) continue;
        const Point there = other_end % 2 != 0 ? stops_[other].b : stops_[other].a;
        const int j = position_[other];
        const bool there_is_entry = (other_end % 2 != 0) == visits_[at(j)].reversed;
        // A neighbour farther than the present one cannot begin a gain here; the last position's free end always may.
        const bool free_end = from_exit ? !entered(i + 1) : !left(i - 1);
        if (!free_end && distance(here, there) >= now) break;
        if (from_exit) {
          if (!there_is_entry && try_reverse(std::min(i, j) + 1, std::max(i, j))) return true;
          if (try_moves(j, i + 1, there_is_entry, true)) return true;
        } else {
          if (there_is_entry && try_reverse(std::min(i, j), std::max(i, j) - 1)) return true;
          if (try_moves(j, i, there_is_entry, false)) return true;
        }
      }
    }
    return try_ends(i);
  }

  /// The first and the last position may change when an end is free or far: turn the head or the tail of the tour.
  bool try_ends(int i) { return try_reverse(0, i) || try_reverse(i, n_ - 1); }

  std::span<const Stop> stops_;
  std::vector<Visit> visits_;
  TourEnds ends_;
  int n_, longest_move_ = 0;
  bool any_fixed_ = false;
  std::vector<int> position_;
  std::vector<char> look_;
  std::vector<std::uint32_t> neighbours_, touched_, queue_;
  std::uint64_t seed_ = 1;
};

}  // namespace

double way(std::span<const Stop> stops, std::span<const Visit> visits, const TourEnds& ends) {
  double sum = 0;
  std::optional<Point> at = ends.from;
  for (const auto& v : visits) {
    if (at) sum += distance(*at, entry_of(stops[v.stop], v.reversed));
    at = exit_of(stops[v.stop], v.reversed);
  }
  if (at && ends.to) sum += distance(*at, *ends.to);
  return sum;
}

std::vector<Visit> tour(PathOrder order, std::span<const Stop> stops, const TourEnds& ends) {
  if (stops.empty()) return {};
  auto visits = nearest_tour(stops, ends);
  if (order == PathOrder::nearest) return visits;
  return Search(stops, std::move(visits), ends).run();
}

}  // namespace weft::travel
