// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/simplify.h"

#include "core/stop.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <queue>

namespace weft {
namespace {

constexpr double short_piece = tolerances::least_move + 2 * tolerances::path;  // both its ends may be moved yet

double length_of(const PathVertex& a, const PathVertex& b) {
  const double x = b.x - a.x, y = b.y - a.y;
  return std::sqrt(x * x + y * y);
}

bool is_even(const VertexPath& path) {
  return std::all_of(path.begin(), path.end(), [&](const PathVertex& v) { return v.band == path[0].band; });
}

// A bow may stand so far off its chord: the piece comes to lie in its middle, two thirds of that from its ends.
constexpr double most_bow = 1.25 * tolerances::path;
constexpr double per_place = 1.0 / (most_bow * most_bow),
                 per_band = 1.0 / (static_cast<double>(tolerances::band) * tolerances::band);

/// The squares of how far places or bands lie off a piece, in units of the tolerances.
class Chord {
 public:
  Chord(const PathVertex& a, const PathVertex& b) : a_(a), x_(b.x - a.x), y_(b.y - a.y), wider_(b.band - a.band) {
    const double length2 = x_ * x_ + y_ * y_;
    per_length2_ = length2 > 0 ? 1 / length2 : 0;
  }
  double error(const PathVertex& p) const {
    const double px = p.x - a_.x, py = p.y - a_.y;
    const double t = std::min(1.0, std::max(0.0, (px * x_ + py * y_) * per_length2_));  // no branches
    const double dx = px - t * x_, dy = py - t * y_, dw = a_.band + t * wider_ - p.band;
    return std::max((dx * dx + dy * dy) * per_place, dw * dw * per_band);
  }

 private:
  PathVertex a_;
  double x_, y_, wider_, per_length2_;
};

/// Whether p lies off the piece from a to b by more than that, without a division: most vertices do not.
bool lies_off(const PathVertex& a, const PathVertex& p, const PathVertex& b, double most) {
  const double x = b.x - a.x, y = b.y - a.y, px = p.x - a.x, py = p.y - a.y;
  const double length2 = x * x + y * y, along = px * x + py * y;
  if (along <= 0 || along >= length2) return Chord(a, b).error(p) > most;
  const double aside = px * y - py * x, wider = (a.band - p.band) * length2 + along * (b.band - a.band);
  return std::max(aside * aside * per_place * length2, wider * wider * per_band) > most * length2 * length2;
}

/// The vertices of an open path that pieces between them do not stand for, ascending; its ends are among them.
std::vector<std::size_t> standing_out(const VertexPath& path) {
  struct Span {
    std::size_t first, last;
  };
  std::vector<std::uint8_t> keep(path.size(), 0);
  keep.front() = keep.back() = 1;
  // A vertex that stands out from its neighbours stays in any case, and spans between those are short.
  std::vector<Span> open;
  std::size_t last = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (i + 1 < path.size() && !lies_off(path[i - 1], path[i], path[i + 1], 1)) continue;
    keep[i] = 1;
    if (i > last + 1) open.push_back({last, i});
    last = i;
  }
  constexpr double equal = 1 + 1e-6;
  StopNowAndThen stop(64);
  while (!open.empty()) {
    stop.step();
    const Span span = open.back();
    open.pop_back();
    const Chord chord(path[span.first], path[span.last]);
    // What is missed most, from either end: a path is the same whichever way it goes.
    double most = 1;  // of the squares: no root is drawn
    std::size_t worst = 0, as_bad = 0;
    for (std::size_t i = span.first + 1; i < span.last; ++i) {
      const double error = chord.error(path[i]);
      if (error * equal < most) continue;
      if (error > most * equal) most = error, worst = i;
      as_bad = i;
    }
    if (worst == 0) continue;
    keep[worst] = keep[as_bad] = 1;
    for (const auto& [from, to] : {Span{span.first, worst}, Span{worst, as_bad}, Span{as_bad, span.last}})
      if (to > from + 1) open.push_back({from, to});
  }
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < path.size(); ++i)
    if (keep[i]) out.push_back(i);
  return out;
}

/// A symmetric positive definite system, tridiagonal; or cyclic (n ≥ 3), where `corner` couples the last and the first.
/// Source: Sherman & Morrison 1950 for the corner.
class Tridiagonal {
 public:
  /// `above[i]` couples i and i + 1.
  Tridiagonal(std::vector<double> diagonal, std::vector<double> above, double corner)
      : share_(std::move(above)), per_(std::move(diagonal)) {
    const std::size_t n = per_.size();
    const double gamma = -per_[0];
    if (corner != 0) per_[0] -= gamma, per_[n - 1] -= corner * corner / gamma;
    for (std::size_t i = 0; i < n; ++i) {
      if (i > 0) per_[i] -= share_[i - 1] * share_[i - 1] * per_[i - 1];
      per_[i] = 1 / per_[i];
      if (i > 0) share_[i - 1] *= per_[i - 1];
    }
    if (corner == 0) return;
    around_.assign(n, 0.0);
    around_[0] = gamma, around_[n - 1] = corner;
    substitute(around_);
    per_corner_ = corner / gamma;
    per_around_ = 1 / (1 + around_[0] + per_corner_ * around_[n - 1]);
  }
  void solve(std::vector<double>& right) const {
    substitute(right);
    if (around_.empty()) return;
    const double f = (right.front() + per_corner_ * right.back()) * per_around_;
    for (std::size_t i = 0; i < right.size(); ++i) right[i] -= f * around_[i];
  }

 private:
  void substitute(std::vector<double>& right) const {
    const std::size_t n = right.size();
    for (std::size_t i = 1; i < n; ++i) right[i] -= share_[i - 1] * right[i - 1];
    right[n - 1] *= per_[n - 1];
    for (std::size_t i = n - 1; i-- > 0;) right[i] = right[i] * per_[i] - share_[i] * right[i + 1];
  }

  std::vector<double> share_,
      per_;                     // of the row before in each, and one over what is left in it
  std::vector<double> around_;  // what the corner brings in
  double per_corner_ = 0, per_around_ = 0;
};

/// What functions that are linear between some vertices of an open path have to be, to be nearest to what is told at
/// all of its vertices; with `closed` its ends are one.
class Projection {
 public:
  /// `at`: the indices of those vertices.
  Projection(const VertexPath& path, const std::vector<std::size_t>& at, bool closed)
      : at_(at), closed_(closed), n_(at.size() - (closed ? 1 : 0)), lengths_(path.size() - 1), whole_(at.size() - 1) {
    for (std::size_t i = 0; i < lengths_.size(); ++i) lengths_[i] = std::max(least, length_of(path[i], path[i + 1]));
    for (std::size_t k = 0; k < whole_.size(); ++k)
      for (std::size_t i = at[k]; i < at[k + 1]; ++i) whole_[k] += lengths_[i];
  }

  /// `length_of_piece(k)`: as it is now.
  template <class Length>
  Tridiagonal system(Length length_of_piece) const {
    std::vector<double> diagonal(n_, 0.0), above(n_, 0.0);
    double corner = 0;
    for (std::size_t k = 0; k < whole_.size(); ++k) {
      const std::size_t next = next_of(k);
      const double l = std::max(least, length_of_piece(k));
      diagonal[k] += l / 3, diagonal[next] += l / 3;
      (closed_ && next == 0 ? corner : above[k]) = l / 6;
    }
    return {std::move(diagonal), std::move(above), corner};
  }
  /// `told(k, i, t)`: what is told at vertex i, a share t of the way along piece k.
  template <class Told>
  std::vector<double> of(const Tridiagonal& system, Told told) const {
    std::vector<double> right(n_, 0.0);
    for (std::size_t k = 0; k < whole_.size(); ++k) {
      const double per = 1 / whole_[k];
      double s = 0, t = 0, a = told(k, at_[k], 0), first = 0, second = 0;
      for (std::size_t i = at_[k]; i < at_[k + 1]; ++i) {
        s += lengths_[i];
        const double u = s * per, b = told(k, i + 1, u), weight = lengths_[i] / 6;
        first += weight * (a * (3 - 2 * t - u) + b * (3 - t - 2 * u));
        second += weight * (a * (2 * t + u) + b * (t + 2 * u));
        t = u, a = b;
      }
      right[k] += first, right[next_of(k)] += second;
    }
    system.solve(right);
    return right;
  }

 private:
  static constexpr double least = 1e-6;  // pieces of no length have no weight, but not none at all
  std::size_t next_of(std::size_t k) const { return k + 1 == n_ && closed_ ? 0 : k + 1; }

  const std::vector<std::size_t>& at_;
  bool closed_;
  std::size_t n_;
  std::vector<double> lengths_,
      whole_;  // of the path's pieces, and of those between the vertices
};

/// How far from each vertex the path's width bends, that is changes otherwise than before, µm: back and on. A path that
/// is not closed is short and bends everywhere. Empty where nothing bends.
struct Bends {
  std::vector<double> back, on;
};
Bends bends_of_width(const VertexPath& path, bool closed, double reach) {
  constexpr double even_um = 1;  // over the reach: half of that is what smoothing would change
  constexpr double least = 1e-3;
  constexpr double far = 1e18;
  const std::size_t n = path.size();
  const auto next = [&](std::size_t i) { return i + 1 < n ? i + 1 : 0; };
  const auto length = [&](std::size_t i) { return std::max(least, length_of(path[i], path[next(i)])); };
  const auto slope = [&](std::size_t i) {
    const double wider = path[next(i)].band - path[i].band;
    return std::abs(wider) < least ? 0 : wider / length(i);
  };
  Bends out;
  double before = closed ? slope(n - 1) : 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double after = i + 1 < n || closed ? slope(i) : 0;
    if (!closed || std::abs(after - before) * reach > even_um) {
      if (out.back.empty()) out.back.assign(n, far), out.on = out.back;
      out.back[i] = out.on[i] = 0;
    }
    before = after;
  }
  if (out.back.empty()) return out;
  std::vector<double> lengths(n);
  for (std::size_t i = 0; i < n; ++i) lengths[i] = length(i);
  for (int round = 0; round < (closed ? 2 : 1); ++round) {
    for (std::size_t i = closed ? 0 : 1; i < n; ++i) {
      const std::size_t k = i > 0 ? i - 1 : n - 1;
      out.back[i] = std::min(out.back[i], out.back[k] + lengths[k]);
    }
    for (std::size_t i = closed ? n : n - 1; i-- > 0;) out.on[i] = std::min(out.on[i], out.on[next(i)] + lengths[i]);
  }
  return out;
}

/// More vertices near those where the width bends: what changes there changes there only.
VertexPath finer(const VertexPath& path, const Bends& bends, bool closed, double reach) {
  constexpr std::array graded{0.5, 1.5, 3.5};  // of the reach
  VertexPath out;
  out.reserve(2 * path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    out.push_back(path[i]);
    if (i + 1 == path.size() && !closed) break;
    const std::size_t j = (i + 1) % path.size();
    const double back = bends.back[i], on = bends.on[j];
    if (std::min(back, on) > graded.back() * reach) continue;
    const PathVertex &a = path[i], &b = path[j];
    const double length = length_of(a, b), halfway = (length + on - back) / 2;
    const auto add = [&](double s) {
      const double t = s / length;
      out.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.band + t * (b.band - a.band)});
    };
    for (const double r : graded)
      if (const double s = r * reach - back; s > 0 && s < std::min(length, halfway)) add(s);
    for (auto r = graded.rbegin(); r != graded.rend(); ++r)
      if (const double s = length + on - *r * reach; s > std::max(0.0, halfway) && s < length) add(s);
  }
  return out;
}

/// Puts first the vertex that stands out most: which one is first is chance, and it stays.
void begin_at_corner(VertexPath& path) {
  const std::size_t n = path.size();
  std::size_t best = 0;
  double most = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const PathVertex &a = path[i > 0 ? i - 1 : n - 1], &b = path[i + 1 < n ? i + 1 : 0];
    if (lies_off(a, path[i], b, most * (1 + 1e-6))) most = Chord(a, b).error(path[i]), best = i;
  }
  std::rotate(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(best), path.end());
}

/// The vertices that are left of a path, as a list.
class Remaining {
 public:
  Remaining(const VertexPath& path, const std::vector<std::size_t>& chosen)
      : path_(path), chosen_(chosen), out_(chosen.size(), 0), before_(chosen.size()), after_(chosen.size()) {
    std::iota(before_.begin() + 1, before_.end(), std::size_t{0});
    std::iota(after_.begin(), after_.end(), std::size_t{1});
  }
  bool is_end(std::size_t i) const { return i == 0 || i + 1 == chosen_.size(); }
  bool is_piece(std::size_t from, std::size_t to) const { return !out_[from] && !out_[to] && after_[from] == to; }
  std::size_t before(std::size_t i) const { return before_[i]; }
  std::size_t after(std::size_t i) const { return after_[i]; }
  double length(std::size_t from, std::size_t to) const { return length_of(at(from), at(to)); }
  /// How far it lies off the chord past it.
  double missed(std::size_t i) const { return is_end(i) ? 1e18 : Chord(at(before_[i]), at(after_[i])).error(at(i)); }
  /// Whether the path turns there by more than 60°.
  bool turns(std::size_t i) const {
    if (is_end(i)) return false;
    const PathVertex &a = at(before_[i]), &b = at(i), &c = at(after_[i]);
    return (b.x - a.x) * (c.x - b.x) + (b.y - a.y) * (c.y - b.y) < 0.5 * length_of(a, b) * length_of(b, c);
  }
  void leave_out(std::size_t i) {
    out_[i] = 1;
    after_[before_[i]] = after_[i];
    before_[after_[i]] = before_[i];
  }
  std::vector<std::size_t> chosen() const {
    std::vector<std::size_t> left;
    for (std::size_t i = 0; i < chosen_.size(); ++i)
      if (!out_[i]) left.push_back(chosen_[i]);
    return left;
  }

 private:
  const PathVertex& at(std::size_t i) const { return path_[chosen_[i]]; }

  const VertexPath& path_;
  const std::vector<std::size_t>& chosen_;
  std::vector<std::uint8_t> out_;
  std::vector<std::size_t> before_, after_;
};

/// Of both ends of a piece that is too short the one goes that is missed less; where it is the path's end, the other. A
/// step of width that goes on stays. The shortest pieces go first, so that a path is the same from either end.
std::vector<std::size_t> without_short_pieces(const VertexPath& path, const std::vector<std::size_t>& chosen) {
  struct Piece {
    double length;
    std::size_t from, to;
    bool operator<(const Piece& other) const { return length > other.length; }
  };
  Remaining left(path, chosen);
  std::priority_queue<Piece> shortest;
  const auto add = [&](std::size_t from, std::size_t to) {
    if (const double length = left.length(from, to); length < short_piece) shortest.push({length, from, to});
  };
  for (std::size_t i = 0; i + 1 < chosen.size(); ++i) add(i, i + 1);
  if (shortest.empty()) return chosen;
  StopNowAndThen stop(64);
  while (!shortest.empty()) {
    stop.step();
    const auto [length, from, to] = shortest.top();
    shortest.pop();
    if (!left.is_piece(from, to) || (left.is_end(from) && left.is_end(to))) continue;
    const double first = left.missed(from), last = left.missed(to);
    // Where the path turns back both are missed alike.
    const bool leave_first =
        first != last ? first < last : left.length(left.before(from), from) < left.length(to, left.after(to));
    if (std::min(first, last) > 1 && !left.turns(from) && !left.turns(to)) continue;
    const std::size_t i = leave_first ? from : to, before = left.before(i), after = left.after(i);
    left.leave_out(i);
    add(before, after);
    if (before > 0) add(left.before(before), before);
    if (!left.is_end(after)) add(after, left.after(after));
  }
  return left.chosen();
}

}  // namespace

void smooth_widths(VertexPath& path, bool closed, double reach) {
  if (path.size() < 3 || reach <= 0 || is_even(path)) return;
  const Bends bends = bends_of_width(path, closed, reach);
  if (bends.back.empty()) return;
  path = finer(path, bends, closed, reach);
  const std::size_t n = path.size();
  constexpr double least = 1e-3;  // a step is stiff, but not endlessly so
  std::vector<double> diagonal(n, 0.0), above(n, 0.0), right(n, 0.0);
  double corner = 0;
  for (std::size_t i = 0; i + (closed ? 0 : 1) < n; ++i) {
    const std::size_t j = (i + 1) % n;
    const double length = std::max(least, length_of(path[i], path[j])), stiff = reach * reach / length;
    diagonal[i] += length / 2 + stiff, diagonal[j] += length / 2 + stiff;
    (j == 0 ? corner : above[i]) = -stiff;
    right[i] += length / 2 * path[i].band, right[j] += length / 2 * path[j].band;
  }
  Tridiagonal(std::move(diagonal), std::move(above), corner).solve(right);
  for (std::size_t i = 0; i < n; ++i) path[i].band = right[i];
}

std::vector<std::size_t> chosen_vertices(const VertexPath& path) {
  return without_short_pieces(path, standing_out(path));
}

int ramp_pieces(double change_um, double length_um) {
  if (change_um <= tolerances::band_step) return 1;
  const double most =
      std::max(length_um / tolerances::shortest_piece,
               std::min(std::ceil(change_um / tolerances::band_leap), 2 * length_um / tolerances::shortest_piece));
  return std::max(1, static_cast<int>(std::min(std::ceil(change_um / tolerances::band_step), most)));
}

void cut_ramps(VertexPath& path, bool closed) {
  VertexPath out;
  out.reserve(2 * path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    const PathVertex &a = path[i], &b = path[(i + 1) % path.size()];
    out.push_back(a);
    if (i + 1 == path.size() && !closed) break;
    const int pieces = ramp_pieces(std::abs(a.band - b.band), length_of(a, b));
    for (int k = 1; k < pieces; ++k) {
      const double t = static_cast<double>(k) / pieces;
      out.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.band + t * (b.band - a.band)});
    }
  }
  path = std::move(out);
}

VertexPath projected(const VertexPath& path, const std::vector<std::size_t>& at, bool closed) {
  const Projection projection(path, at, closed);
  VertexPath out;
  for (const std::size_t i : at) out.push_back(path[i]);
  const VertexPath chords = out;
  const auto length = [&](std::size_t k) { return length_of(out[k], out[k + 1]); };
  const Tridiagonal places = projection.system(length);
  const auto off = [&](double PathVertex::*axis) {
    return projection.of(places, [&](std::size_t k, std::size_t i, double t) {
      return path[i].*axis - chords[k].*axis - t * (chords[k + 1].*axis - chords[k].*axis);
    });
  };
  stop_if_asked();
  const auto x = off(&PathVertex::x), y = off(&PathVertex::y);
  stop_if_asked();
  const std::size_t n = x.size();
  std::vector<std::uint8_t> still(out.size(), 0);  // ends, and steps of width: they would turn
  if (!closed && !still.empty()) still.front() = still.back() = 1;
  for (std::size_t k = 0; k + 1 < out.size(); ++k)
    if (length(k) < short_piece) still[k] = still[k + 1] = 1;
  for (std::size_t k = 0; k < n; ++k)
    if (!still[k] && !(closed && k == 0 && still.back())) out[k].x += x[k], out[k].y += y[k];
  if (closed) out.back() = out.front();
  if (is_even(path)) return out;
  const auto band =
      projection.of(projection.system(length), [&](std::size_t, std::size_t i, double) { return path[i].band; });
  for (std::size_t k = 0; k < out.size(); ++k) out[k].band = std::max(1.0, band[k % n]);
  return out;
}

void simplify(VertexPath& path, bool closed) {
  if (path.size() < (closed ? 4U : 3U)) return;
  if (closed) {
    begin_at_corner(path);
    path.push_back(path.front());
  }
  const auto chosen = chosen_vertices(path);
  if (closed && chosen.size() < 4) {
    path.pop_back();
    return;
  }
  if (chosen.size() < path.size()) path = projected(path, chosen, closed);
  if (closed) path.pop_back();
}

}  // namespace weft
