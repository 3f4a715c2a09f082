// SPDX-License-Identifier: GPL-3.0-or-later
#include "travel/tour.h"

#include "core/stop.h"
#include "travel/point_grid.h"

#include <algorithm>
#include <initializer_list>
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
  StopNowAndThen now_and_then(64);
  while (visits.size() < stops.size()) {
    now_and_then.step();
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
  Search(std::span<const Stop> stops, const std::vector<Visit>& visits, const TourEnds& ends)
      : stops_(stops), ends_(ends), n_(static_cast<int>(stops.size())) {
    places_.reserve(stops.size());
    for (const auto& v : visits)
      places_.push_back({entry_of(stops[v.stop], v.reversed), exit_of(stops[v.stop], v.reversed), v.stop, v.reversed});
    edge_.resize(stops.size() + 1);
    position_.resize(stops.size());
    look_.assign(stops.size(), 1);
    for (int i = 0; i <= n_; ++i) edge_[at(i)] = hop(i - 1, i);
    settled(0, n_, {});
    for (const auto& s : stops) any_fixed_ = any_fixed_ || !s.reversible;
    const auto points = endpoints(stops);
    neighbours_ = nearest_neighbours(points, neighbour_count);
    apart_.reserve(neighbours_.size());
    for (std::size_t k = 0; k < neighbours_.size(); ++k)
      apart_.push_back(neighbours_[k] == none ? 0.0 : distance(points[k / neighbour_count], points[neighbours_[k]]));
    longest_move_ = n_ <= 4000 ? n_ : 1000;
  }

  std::vector<Visit> run(bool with_kicks) {
    // A move shortens the way by at least a micron, and the budget bounds the worst case.
    queue_.clear();
    for (const auto& place : places_) queue_.push_back(place.stop);
    settle(40L * n_ + 1000);
    if (with_kicks && n_ >= fewest_to_kick && n_ <= most_to_kick) kick_and_settle();
    std::vector<Visit> visits;
    visits.reserve(places_.size());
    for (const auto& place : places_) visits.push_back({place.stop, place.reversed});
    return visits;
  }

 private:
  /// A stop on its position: where it is entered and left.
  struct Place {
    Point entry, exit;
    std::uint32_t stop;
    bool reversed;
  };

  /// Looks at the stops of the queue, and at those that moves touch, until nothing more is gained.
  void settle(long budget) {
    for (std::size_t head = 0; head < queue_.size() && budget > 0; ++head, --budget) {
      now_and_then_.step();
      const std::uint32_t stop = queue_[head];
      look_[stop] = 0;
      while (budget > 0 && improve(stop)) --budget, now_and_then_.step();
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
    double length = whole_way();
    auto kept = places_;
    auto kept_edge = edge_;
    const auto copy_changed = [&](const auto& from, auto& to, int more) {  // since the last kick
      std::copy(from.begin() + changed_from_, from.begin() + changed_to_ + more, to.begin() + changed_from_);
    };
    for (int kick = 0; kick < kicks_a_stop * n_; ++kick) {
      int cut[3];
      const int window = std::min(n_, kick % 2 == 0 ? kick_window : wide_kick_window),
                base = static_cast<int>(random(static_cast<std::uint32_t>(n_ - window + 1)));
      for (int& c : cut) c = base + static_cast<int>(random(static_cast<std::uint32_t>(window + 1)));
      std::sort(std::begin(cut), std::end(cut));
      if (cut[0] == cut[1] || cut[1] == cut[2]) continue;
      changed_from_ = n_, changed_to_ = 0;
      exchange(cut[0], cut[1], cut[2]);
      for (const int c :
           {cut[0] - 1, cut[0], cut[0] + cut[2] - cut[1] - 1, cut[0] + cut[2] - cut[1], cut[2] - 1, cut[2]})
        if (c >= 0 && c < n_) queue_.push_back(places_[at(c)].stop);
      settle(1000);
      const double now = whole_way();
      if (now < length - least_gain_um) {
        length = now;
        copy_changed(places_, kept, 0);
        copy_changed(edge_, kept_edge, 1);
      } else {
        copy_changed(kept, places_, 0);
        copy_changed(kept_edge, edge_, 1);
        for (int i = changed_from_; i < changed_to_; ++i) position_[places_[at(i)].stop] = i;
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
  static constexpr int fewest_to_kick = 5, most_to_kick = 400;
  static constexpr int kick_window = 12,
                       wide_kick_window = 40;  // in turn: MINI-x-carriage gains by one, a bunny by both
  static constexpr int kicks_a_stop = 2;       // a third gains 0.2 % at most
  static constexpr double least_gain_um = 1.0;
  static constexpr double rounding_um = 1e-3;  // no sum of hops is off by more, in whatever order they are added
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  /// Way from what is left at position i to what is entered at position j; none where there is no such place.
  double hop(int i, int j) const {
    if ((i < 0 && !ends_.from) || (j >= n_ && !ends_.to)) return 0.0;
    return distance(i < 0 ? *ends_.from : places_[at(i)].exit, j >= n_ ? *ends_.to : places_[at(j)].entry);
  }
  double hop(int i, Point to) const {
    if (i < 0) return ends_.from ? distance(*ends_.from, to) : 0.0;
    return distance(places_[at(i)].exit, to);
  }
  double hop(Point from, int j) const {
    if (j >= n_) return ends_.to ? distance(from, *ends_.to) : 0.0;
    return distance(from, places_[at(j)].entry);
  }
  double whole_way() const {
    double sum = 0;
    for (const double e : edge_) sum += e;
    return sum;
  }

  bool reversible(int first, int last) const {
    if (!any_fixed_) return true;
    for (int i = first; i <= last; ++i)
      if (!stops_[places_[at(i)].stop].reversible) return false;
    return true;
  }

  void touch(int i) {
    if (i >= 0 && i < n_) touched_.push_back(places_[at(i)].stop);
  }

  /// To be called when the places first … last − 1 are not what they were, with the edges that are new: others moved.
  void settled(int first, int last, std::initializer_list<int> new_edges) {
    for (int i = first; i < last; ++i) position_[places_[at(i)].stop] = i;
    for (const int k : new_edges) edge_[at(k)] = hop(k - 1, k);
    changed_from_ = std::min(changed_from_, first), changed_to_ = std::max(changed_to_, last);
  }

  /// Exchanges the places [low, middle) with [middle, high), and the edges between them.
  void exchange(int low, int middle, int high) {
    std::rotate(places_.begin() + low, places_.begin() + middle, places_.begin() + high);
    std::rotate(edge_.begin() + low, edge_.begin() + middle, edge_.begin() + high);
    settled(low, high, {low, low + high - middle, high});
  }

  /// Turns places around, and the edges between them.
  void reverse(int first, int last) {
    std::reverse(places_.begin() + first, places_.begin() + last + 1);
    std::reverse(edge_.begin() + first + 1, edge_.begin() + last + 1);
    for (int i = first; i <= last; ++i) {
      Place& place = places_[at(i)];
      place.reversed = !place.reversed;
      std::swap(place.entry, place.exit);
    }
  }

  /// 2-opt: turns the positions first … last around. Gains are summed from what is known to what is not: a sum that is
  /// too small already decides.
  bool try_reverse(int first, int last) {
    if (first > last || last - first >= longest_move_) return false;
    double gain = edge_[at(first)] + edge_[at(last + 1)];
    if (gain < least_gain_um) return false;
    gain -= hop(first - 1, places_[at(last)].exit);
    if (gain < least_gain_um) return false;
    gain -= hop(places_[at(first)].entry, last + 1);
    if (gain < least_gain_um || !reversible(first, last)) return false;
    turn(first, last);
    return true;
  }
  /// The same where one of the two new hops is known: that to the first place, or that from the last.
  bool try_reverse(int first, int last, bool to_first, double known) {
    if (first > last || last - first >= longest_move_) return false;
    double gain = edge_[at(first)] + edge_[at(last + 1)];
    if (gain - known < least_gain_um - rounding_um) return false;
    gain -= to_first ? known : hop(first - 1, places_[at(last)].exit);
    gain -= to_first ? hop(places_[at(first)].entry, last + 1) : known;
    if (gain < least_gain_um || !reversible(first, last)) return false;
    turn(first, last);
    return true;
  }
  void turn(int first, int last) {
    reverse(first, last);
    settled(first, last + 1, {first, last + 1});
    touch(first - 1), touch(first), touch(last), touch(last + 1);
  }

  /// What one endpoint of the stop at position i is to be joined to: that of another stop, so far away.
  struct Joint {
    int i;
    bool entry;  ///< of the stop at i, or its exit
    double length;
  };

  /// Or-opt: segments of up to three stops that begin (or end) with a joint are taken out and put between the positions
  /// gap − 1 and gap, turned around or not, so that the joint comes first (or last).
  bool try_moves(const Joint& joint, int gap, bool joint_first) {
    const bool turned = joint.entry != joint_first;
    const double edge_at_gap = edge_[at(gap)];
    for (int extra = 0; extra < 3; ++extra) {
      const int first = joint.entry ? joint.i : joint.i - extra, last = joint.entry ? joint.i + extra : joint.i;
      if (first < 0 || last >= n_) break;
      if (gap >= first && gap <= last + 1) continue;
      if (std::max(last, gap) - std::min(first, gap) >= longest_move_) continue;
      double gain = edge_[at(first)] + edge_[at(last + 1)] + edge_at_gap;
      if (gain - joint.length < least_gain_um - rounding_um) continue;
      gain -= hop(first - 1, last + 1);
      if (gain - joint.length < least_gain_um - rounding_um) continue;
      // The endpoint that is not the joint is where the segment is left, or entered.
      const Point far = joint.entry ? places_[at(last)].exit : places_[at(first)].entry;
      gain -= joint_first ? joint.length : hop(gap - 1, far);
      gain -= joint_first ? hop(far, gap) : joint.length;
      if (gain < least_gain_um || (turned && !reversible(first, last))) continue;
      move(first, last, gap, turned);
      return true;
    }
    return false;
  }
  void move(int first, int last, int gap, bool turned) {
    touch(first - 1), touch(first), touch(last), touch(last + 1), touch(gap - 1), touch(gap);
    if (turned) reverse(first, last);
    const int low = std::min(first, gap), high = std::max(last + 1, gap);
    exchange(low, gap < first ? first : last + 1, high);
  }

  /// The position at which the stop of an endpoint stands, if that end is its entry (or exit) there.
  std::optional<int> position_of(std::uint32_t end, bool entry) const {
    const int j = position_[end / 2];
    if (((end % 2 != 0) == places_[at(j)].reversed) != entry) return std::nullopt;
    return j;
  }
  std::uint32_t end_at(int i, bool entry) const {
    const Place& place = places_[at(i)];
    return 2 * place.stop + (entry == place.reversed ? 1U : 0U);
  }

  /// Or-3opt: two neighbouring runs of any length change places, neither turned around. Begun with the joint of the
  /// exit of position i with the entry of position j; what follows is looked for among the neighbours of what that
  /// frees, while the sum of gains is positive. Source: Lin & Kernighan 1973; Or 1976.
  bool try_exchange(int i, int j, double joint) {
    const bool onward = j > i;
    const double first_gain = edge_[at(i + 1)] - joint;
    if (first_gain < least_gain_um - rounding_um || j == i + 1 || (!onward && j == 0 && !ends_.from)) return false;
    // Onward, the runs are [i + 1, j) and [j, m): m − 1 comes before i + 1. Back, [j, m) and [m, i]: j − 1 before m.
    const bool looks_for_exit = onward;
    if (!onward && j == 0) return false;
    const std::uint32_t freed = onward ? end_at(i + 1, true) : end_at(j - 1, false);
    for (int k = 0; k < neighbour_count; ++k) {
      const std::size_t neighbour = std::size_t{freed} * neighbour_count + static_cast<std::size_t>(k);
      if (neighbours_[neighbour] == none) break;
      const double gain = first_gain + edge_[at(j)] - apart_[neighbour];
      if (gain < least_gain_um - rounding_um) break;
      const auto found = position_of(neighbours_[neighbour], !looks_for_exit);
      if (!found) continue;
      const int m = onward ? *found + 1 : *found;
      if (onward ? m <= j || m > n_ : m <= j || m > i) continue;
      const int low = onward ? i + 1 : j, middle = onward ? j : m, high = onward ? m : i + 1;
      if (high - low > longest_move_) continue;
      const double closing = onward ? hop(i + 1 < j ? j - 1 : i, m) : hop(m - 1, i + 1);
      if (gain + edge_[at(m)] - closing < least_gain_um) continue;
      exchange(low, middle, high);
      touch(low - 1), touch(low), touch(low + high - middle - 1), touch(low + high - middle), touch(high - 1),
          touch(high);
      return true;
    }
    return false;
  }

  bool improve(std::uint32_t stop) {
    const int i = position_[stop];
    if (try_reverse(i, i)) return true;
    const bool reversed = places_[at(i)].reversed;
    for (const bool from_exit : {false, true}) {
      const std::uint32_t end = 2 * stop + ((from_exit != reversed) ? 1U : 0U);
      const double now = edge_[at(from_exit ? i + 1 : i)];
      // A neighbour farther than the present one cannot begin a gain here; the last position's free end always may.
      const bool free_end = from_exit ? i + 1 >= n_ && !ends_.to : i == 0 && !ends_.from;
      for (int k = 0; k < neighbour_count; ++k) {
        const std::size_t neighbour = std::size_t{end} * neighbour_count + static_cast<std::size_t>(k);
        const std::uint32_t other_end = neighbours_[neighbour];
        if (other_end == none) break;
        const std::uint32_t other = other_end / 2;
        if (other == stop) continue;
        if (!free_end && apart_[neighbour] >= now) break;
        const int j = position_[other];
        const bool there_is_entry = (other_end % 2 != 0) == places_[at(j)].reversed;
        const Joint joint{j, there_is_entry, apart_[neighbour]};
        if (from_exit) {
          if (!there_is_entry && try_reverse(std::min(i, j) + 1, std::max(i, j), true, joint.length)) return true;
          if (try_moves(joint, i + 1, true)) return true;
          if (there_is_entry && try_exchange(i, j, joint.length)) return true;
        } else {
          if (there_is_entry && try_reverse(std::min(i, j), std::max(i, j) - 1, false, joint.length)) return true;
          if (try_moves(joint, i, false)) return true;
        }
      }
    }
    return try_ends(i);
  }

  /// The first and the last position may change when an end is free or far: turn the head or the tail of the tour.
  bool try_ends(int i) { return try_reverse(0, i) || try_reverse(i, n_ - 1); }

  std::span<const Stop> stops_;
  std::vector<Place> places_;
  std::vector<double> edge_;
  std::vector<double> apart_;  // beside neighbours_: how far they are
  TourEnds ends_;
  int n_, longest_move_ = 0;
  int changed_from_ = 0, changed_to_ = 0;  // places that settled() was told of
  bool any_fixed_ = false;
  std::vector<int> position_;
  std::vector<char> look_;
  std::vector<std::uint32_t> neighbours_, touched_, queue_;
  std::uint64_t seed_ = 1;
  StopNowAndThen now_and_then_{64};
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
  const auto visits = nearest_tour(stops, ends);
  return order == PathOrder::nearest ? visits : Search(stops, visits, ends).run(true);
}

std::vector<Visit> shortened(std::span<const Stop> stops, const std::vector<Visit>& visits, const TourEnds& ends) {
  return visits.size() < 2 ? visits : Search(stops, visits, ends).run(false);
}

}  // namespace weft::travel
