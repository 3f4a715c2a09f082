// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/pieces.h"

#include "core/stop.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

constexpr double moves_saved = 2;  // no piece saves so many, but beside those that would be too short

double distance2_of(const PathVertex& a, const PathVertex& b) {
  const double x = b.x - a.x, y = b.y - a.y;
  return x * x + y * y;
}

/// In moves: of a piece beside whose line its path turns back, where none else is long enough.
constexpr double last_resort = 1'000;

/// A straight bead, as wide as changes evenly along it.
struct StraightBead {
  double x = 0, y = 0, half_band = 0;  ///< of its middle
  double ux = 1, uy = 0;               ///< its direction
  double wider = 0;                    ///< half its band, per µm of way
  double way = 0;                      ///< of its path, to its middle

  /// Half its band, so far along the path.
  double half_at(double way_there) const { return half_band + wider * (way_there - way); }
  /// How far along it a place lies.
  double along(const PathVertex& p) const { return (p.x - x) * ux + (p.y - y) * uy; }
  /// How far its edges are off a place so far along the path, on average, squared.
  double off2(const PathVertex& p, double way_to_p) const {
    const double aside = (p.x - x) * uy - (p.y - y) * ux;
    const double half = p.band / 2 - half_at(way_to_p);
    return aside * aside + half * half;
  }
};

/// Moments of the way along a path from its first vertex, about that: integrals over its length.
struct Moments {
  double way = 0;              ///< ∫ ds
  double x = 0, y = 0, w = 0;  ///< ∫ x ds, …; w is half the band
  double xx = 0, yy = 0, ww = 0;
  double xy = 0, sw = 0;  ///< s is the way

  /// On along a straight that is l µm long. Places are told from the path's first vertex.
  void go_on(const PathVertex& from, const PathVertex& to, double l, bool even) {
    const double half = l / 2, third = l / 3, sixth = l / 6, s = way, t = way + l;
    const double u = from.x, v = from.y, a = to.x, b = to.y;
    x += half * (u + a), y += half * (v + b);
    xx += third * (u * u + u * a + a * a), yy += third * (v * v + v * b + b * b);
    xy += sixth * (u * (2 * v + b) + a * (v + 2 * b));
    way = t;
    if (even) return;
    const double q = from.band / 2, c = to.band / 2;
    w += half * (q + c), ww += third * (q * q + q * c + c * c), sw += sixth * (q * (2 * s + t) + c * (s + 2 * t));
  }
};

/// The straight bead that is nearest to a stretch of a path, from the moments of the path to the ends of the stretch.
/// What many are asked for needs neither a division nor a root: moments are kept times the length.
class Nearest {
 public:
  Nearest(const Moments& from, const Moments& to, bool even)
      : length_(to.way - from.way), way_((from.way + to.way) / 2), x_(to.x - from.x), y_(to.y - from.y) {
    xx_ = length_ * (to.xx - from.xx) - x_ * x_;
    yy_ = length_ * (to.yy - from.yy) - y_ * y_;
    xy_ = length_ * (to.xy - from.xy) - x_ * y_;
    if (length_ <= 0) return;
    per_ = 1 / length_;
    if (even) return;
    w_ = to.w - from.w, turns_ = (to.sw - from.sw - w_ * way_) * per_;
    ww_ = std::max(0.0, length_ * (to.ww - from.ww) - w_ * w_ - 12 * turns_ * turns_);
  }
  double length() const { return length_; }
  /// Whether ∫ off2 ds over the stretch is more: whether the path's moments less that have no positive definite matrix.
  bool is_off_by_more(double most) const {
    const double rest = most * length_ - ww_, x = xx_ - rest, y = yy_ - rest;
    return rest < 0 || (x > 0 && y > 0 && x * y > xy_ * xy_);
  }
  /// That integral. Pre: length() > 0
  double misfit() const { return (std::max(0.0, (xx_ + yy_ - root()) / 2) + ww_) * per_; }
  /// How many moves it becomes, not rounded: no choice hangs on a micron of width.
  double moves() const { return moves_for(24 * std::abs(turns_) * per_, length_); }
  static double moves_for(double change, double length) {
    constexpr double per_step = 1.0 / tolerances::band_step, per_piece = 1.0 / tolerances::shortest_piece;
    return std::max(1.0, std::min(change * per_step, length * per_piece));
  }
  StraightBead bead() const {
    if (length_ <= 0) return {};
    const auto [x, y] = direction();
    const double l = std::sqrt(x * x + y * y);
    return {x_ * per_, y_ * per_, w_ * per_, l > 0 ? x / l : 1, l > 0 ? y / l : 0, 12 * turns_ * per_ * per_, way_};
  }
  /// Whether a stretch from a to b surely nowhere turns back on the bead by more than that: what its way is longer than
  /// its advance along the bead is twice what it goes back in all.
  bool goes_on(const PathVertex& a, const PathVertex& b, double most_back) const {
    const double least = length_ - 2 * most_back * (1 - 1e-6);
    if (least <= 0) return true;
    const auto [x, y] = direction();
    const double advance = (b.x - a.x) * x + (b.y - a.y) * y;
    return advance * advance > least * least * (x * x + y * y);
  }

 private:
  struct Direction {
    double x, y;
  };
  /// Of the bead, of any length.
  Direction direction() const {
    const double d = xx_ - yy_, root_of = root();
    return d < 0 ? Direction{2 * xy_, root_of - d} : Direction{d + root_of, 2 * xy_};
  }
  double root() const {
    const double d = xx_ - yy_;
    return std::sqrt(d * d + 4 * xy_ * xy_);
  }
  double length_, per_ = 0, way_;     // one over the length; way of its middle
  double x_, y_, w_ = 0, turns_ = 0;  // integrals; of half the band, too, times the way from the middle, per length
  double xx_, yy_, xy_, ww_ = 0;      // moments about the means, times the length
};

/// A path by the way along it, told from its first vertex.
class Course {
 public:
  /// A place on it, behind vertex `from` or there.
  struct Place {
    std::size_t from;
    double way;
  };

  explicit Course(const VertexPath& path)
      : path_(path),
        moments_(path.size()),
        even_(std::all_of(path.begin(), path.end(), [&](const PathVertex& v) { return v.band == path[0].band; })) {
    const PathVertex first = path.front();
    for (PathVertex& v : path_) v.x -= first.x, v.y -= first.y;
    for (std::size_t i = 1; i < path.size(); ++i) {
      moments_[i] = moments_[i - 1];
      moments_[i].go_on(path_[i - 1], path_[i], std::sqrt(distance2_of(path_[i - 1], path_[i])), even_);
    }
  }
  std::size_t size() const { return path_.size(); }
  bool even() const { return even_; }
  double way(std::size_t i) const { return moments_[i].way; }
  double distance2(std::size_t i, std::size_t j) const { return distance2_of(path_[i], path_[j]); }
  Nearest nearest(std::size_t i, std::size_t j) const { return {moments_[i], moments_[j], even_}; }
  /// Whether a stretch turns back on its nearest bead: a vertex lies behind one before by more than tolerances::path.
  bool turns_back(const Nearest& nearest, std::size_t i, std::size_t j) const {
    if (nearest.goes_on(path_[i], path_[j], tolerances::path)) return false;
    const StraightBead bead = nearest.bead();
    const double on = bead.along(path_[j]) < bead.along(path_[i]) ? -1 : 1;
    double ahead = on * bead.along(path_[i]);
    for (std::size_t k = i + 1; k <= j; ++k) {
      const double here = on * bead.along(path_[k]);
      if (here < ahead - tolerances::path) return true;
      ahead = std::max(ahead, here);
    }
    return false;
  }
  /// How many moves one of its own pieces becomes.
  double moves(std::size_t i) const {
    return even_ ? 1 : Nearest::moves_for(std::abs(path_[i + 1].band - path_[i].band), way(i + 1) - way(i));
  }
  Place place(double way) const {
    const auto behind =
        std::upper_bound(moments_.begin(), moments_.end(), way, [](double w, const Moments& m) { return w < m.way; });
    return {static_cast<std::size_t>(behind - moments_.begin()) - 1, way};
  }
  Stop stop(Place p) const {
    const double length = p.from + 1 < size() ? way(p.from + 1) - way(p.from) : 0;
    return {p.from, length > 0 ? (p.way - way(p.from)) / length : 0};
  }
  const PathVertex& vertex(std::size_t i) const { return path_[i]; }
  PathVertex vertex(Place p) const {
    const Stop at = stop(p);
    const PathVertex& a = path_[at.from];
    return at.t > 0 ? lerp(a, path_[at.from + 1], at.t) : a;
  }
  /// As far as a place, at which that vertex is.
  Moments moments(Place p, const PathVertex& there) const {
    Moments out = moments_[p.from];
    if (p.way > out.way) out.go_on(path_[p.from], there, p.way - out.way, even_);
    return out;
  }

 private:
  VertexPath path_;
  std::vector<Moments> moments_;
  bool even_;
};

/// The vertices between which pieces are worth most, none of which is off by more than `most`; none at all if pieces
/// would be too short.
std::vector<std::size_t> worth_most(const Course& course, double worth_of_a_move, double most) {
  constexpr double never = 1e18;
  const double per_worth = 1 / worth_of_a_move;
  const std::size_t last = course.size() - 1;
  std::vector<double> cost(course.size(), never);
  std::vector<std::size_t> from(course.size(), 0);
  cost[0] = 0;
  StopNowAndThen stop(64);
  for (std::size_t i = 0; i < last; ++i) {
    stop.step();
    if (cost[i] >= never) continue;
    const auto take = [&](std::size_t j, double sum) {
      if (sum < cost[j]) cost[j] = sum, from[j] = i;
    };
    if (course.distance2(i, i + 1) >= least_piece * least_piece) take(i + 1, cost[i] + course.moves(i));
    double least = 0;  // what any longer piece is off
    for (std::size_t j = i + 2; j <= last; ++j) {
      const double worth = (cost[j] - cost[i] - 1) * worth_of_a_move;
      if (worth <= least || course.distance2(i, j) < least_piece * least_piece) continue;
      const Nearest nearest = course.nearest(i, j);
      const double bound = std::min(most, worth);
      if (nearest.is_off_by_more(bound)) {
        if (bound == most || nearest.is_off_by_more(most)) break;  // the longer the more
        least = bound;
        continue;
      }
      least = nearest.misfit();
      double sum = cost[i] + nearest.moves() + least * per_worth;
      if (sum >= cost[j]) continue;
      if (course.turns_back(nearest, i, j)) sum += last_resort;
      take(j, sum);
    }
  }
  if (cost[last] >= never) return {};
  std::vector<std::size_t> out{last};
  while (out.back() > 0) out.push_back(from[out.back()]);
  std::reverse(out.begin(), out.end());
  return out;
}

std::vector<std::size_t> worth_most(const Course& course, double worth_of_a_move) {
  for (double most = moves_saved * worth_of_a_move; most < 1e15; most *= 2)
    if (auto out = worth_most(course, worth_of_a_move, most); !out.empty()) return out;
  return {0, course.size() - 1};
}

/// Whether no piece of two of the path's is worth a move less: then none of more is.
bool none_is_saved(const VertexPath& path, double worth_of_a_move) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double length2 = distance2_of(path[i - 1], path[i]);
    if (length2 < least_piece * least_piece) return false;
    if (i == 1) continue;
    Moments both;
    const PathVertex &a = path[i - 2], from{0, 0, a.band};
    const auto seen = [&](const PathVertex& v) { return PathVertex{v.x - a.x, v.y - a.y, v.band}; };
    both.go_on(from, seen(path[i - 1]), std::sqrt(distance2_of(a, path[i - 1])), false);
    both.go_on(seen(path[i - 1]), seen(path[i]), std::sqrt(length2), false);
    if (!Nearest({}, both, false).is_off_by_more(moves_saved * worth_of_a_move)) return false;
  }
  return true;
}

/// Where ends of pieces are best.
class Ends {
 public:
  Ends(const Course& course, const std::vector<std::size_t>& at) : course_(course) {
    ends_.reserve(at.size());
    for (const std::size_t i : at) ends_.push_back(end_at({i, course.way(i)}));
    beads_.resize(at.size() - 1), rooms_.resize(at.size() - 1);
    free_.assign(at.size(), 0);
    for (std::size_t k = 0; k + 1 < at.size(); ++k)
      if (at[k + 1] > at[k] + 1) free_[k] = free_[k + 1] = 1;
    free_.front() = free_.back() = 0;
    moves_ = free_;
  }
  /// Each is moved to where the beads before and behind it are off alike: there less of both is. Again, as that changes
  /// the beads.
  std::vector<Course::Place> moved() && {
    constexpr int rounds = 4;  // each halves what is left
    for (int round = 0; round < rounds; ++round) {
      for (std::size_t k = 0; k < beads_.size(); ++k)
        if (moves_[k] || moves_[k + 1]) fit(k);
      next_.clear();
      for (std::size_t k = 1; k + 1 < ends_.size(); ++k)
        if (free_[k] && (moves_[k - 1] || moves_[k] || moves_[k + 1]))
          if (const Course::Place to = best(k); to.way != ends_[k].at.way) next_.push_back({k, ends_[k]}), move(k, to);
      stay_where_too_short();
      std::fill(moves_.begin(), moves_.end(), std::uint8_t{0});
      bool any = false;
      for (const auto& [k, before] : next_) {
        constexpr double least_um = 2;
        moves_[k] = std::abs(before.at.way - ends_[k].at.way) > least_um;
        any = any || moves_[k];
      }
      if (!any) break;
    }
    return places();
  }

 private:
  struct End {
    Course::Place at;
    PathVertex vertex;
    Moments moments;  ///< of the path as far as there
  };
  struct Moved {
    std::size_t k;
    End before;
  };

  End end_at(Course::Place at) const {
    const PathVertex v = course_.vertex(at);
    return {at, v, course_.moments(at, v)};
  }
  void move(std::size_t k, Course::Place to) { ends_[k] = end_at(to); }
  double apart2(std::size_t k) const { return distance2_of(ends_[k].vertex, ends_[k + 1].vertex); }

  /// Where beads meet whose bands differ by more than a step, a short piece leads from one to the other: else their
  /// whole length would.
  std::vector<Course::Place> places() const {
    std::vector<Course::Place> out;
    out.reserve(ends_.size());
    constexpr double least2 = least_piece * least_piece, slack = 1 - 1e-6;
    for (std::size_t k = 0; k < ends_.size(); ++k) {
      const Course::Place here = ends_[k].at;
      if (free_[k] && !course_.even()) {
        const double change = 2 * std::abs(beads_[k - 1].half_at(here.way) - beads_[k].half_at(here.way));
        const bool room = std::min(apart2(k - 1), apart2(k)) > 4 * least2;  // for their ramps, too
        if (change > tolerances::band_step && room) {
          const auto from = course_.place(here.way - least_piece / 2), to = course_.place(here.way + least_piece / 2);
          if (distance2_of(course_.vertex(from), course_.vertex(to)) > least2 * slack) {
            out.push_back(from), out.push_back(to);
            continue;
          }
        }
      }
      out.push_back(here);
    }
    return out;
  }
  /// Where a path turns back, an end that moves on may come nearer to the one before.
  void stay_where_too_short() {
    const auto too_short = [&](std::size_t k) {
      return (k > 0 && apart2(k - 1) < least_piece * least_piece) ||
             (k + 1 < ends_.size() && apart2(k) < least_piece * least_piece);
    };
    for (bool any = true; any;) {
      const auto stay =
          std::stable_partition(next_.begin(), next_.end(), [&](const Moved& m) { return !too_short(m.k); });
      any = stay != next_.end();
      for (auto m = stay; m != next_.end(); ++m) ends_[m->k] = m->before;
      next_.erase(stay, next_.end());
    }
  }
  void fit(std::size_t k) {
    beads_[k] = Nearest(ends_[k].moments, ends_[k + 1].moments, course_.even()).bead();
    rooms_[k] = std::max(0.0, (std::sqrt(apart2(k)) - least_piece) / 2);
  }
  Course::Place best(std::size_t k) const {
    const StraightBead &before = beads_[k - 1], &behind = beads_[k];
    const auto more_off_before = [&](const PathVertex& p, double way) {
      return before.off2(p, way) - behind.off2(p, way);
    };
    Course::Place at = ends_[k].at;
    double here = more_off_before(ends_[k].vertex, at.way);
    const bool back = here > 0;
    const double end = back ? at.way - rooms_[k - 1] : at.way + rooms_[k];
    while (at.way != end) {
      if (back && course_.way(at.from) == at.way) --at.from;
      const std::size_t to = back ? at.from : at.from + 1;
      const double way = back ? std::max(end, course_.way(to)) : std::min(end, course_.way(to));
      const bool whole = way == course_.way(to);
      const double there = more_off_before(whole ? course_.vertex(to) : course_.vertex({at.from, way}), way);
      if ((there > 0) != back) return {at.from, at.way + (way - at.way) * here / (here - there)};
      if (!back && whole) ++at.from;
      at.way = way, here = there;
    }
    return at;
  }

  const Course& course_;
  std::vector<End> ends_;
  std::vector<Moved> next_;  // what was moved last, as it was
  std::vector<StraightBead> beads_;
  std::vector<double> rooms_;       // by how much each end of a piece may be moved that it is not too short
  std::vector<std::uint8_t> free_;  // whether a piece beside the end is of several of the path: others are exact
  std::vector<std::uint8_t> moves_;
};

}  // namespace

std::vector<Stop> ends_of_pieces(const VertexPath& path, double worth_of_a_move) {
  if (path.size() == 2) return {{0, 0}, {1, 0}};
  if (none_is_saved(path, worth_of_a_move)) {
    std::vector<Stop> own;
    for (std::size_t i = 0; i < path.size(); ++i) own.push_back({i, 0});
    return own;
  }
  const Course course(path);
  const auto at = worth_most(course, worth_of_a_move);
  std::vector<Stop> out;
  out.reserve(at.size());
  if (at.size() == path.size())
    for (const std::size_t i : at) out.push_back({i, 0});
  else
    for (const auto& end : Ends(course, at).moved()) out.push_back(course.stop(end));
  return out;
}

}  // namespace weft
