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

/// The squares of how far places or bands lie off a piece, in units of the tolerances.
class Chord {
 public:
  Chord(const PathVertex& a, const PathVertex& b) : a_(a), x_(b.x - a.x), y_(b.y - a.y), wider_(b.band - a.band) {
    const double length2 = x_ * x_ + y_ * y_;
    per_length2_ = length2 > 0 ? 1 / length2 : 0;
  }
  double error(const PathVertex& p) const {
    constexpr double per_place = 1.0 / (static_cast<double>(tolerances::path) * tolerances::path),
                     per_band = 1.0 / (static_cast<double>(tolerances::band) * tolerances::band);
    const double px = p.x - a_.x, py = p.y - a_.y;
    const double t = std::clamp((px * x_ + py * y_) * per_length2_, 0.0, 1.0);
    const double dx = px - t * x_, dy = py - t * y_, dw = a_.band + t * wider_ - p.band;
    return std::max((dx * dx + dy * dy) * per_place, dw * dw * per_band);
  }

 private:
  PathVertex a_;
  double x_, y_, wider_, per_length2_;
};

/// Solves a symmetric positive definite tridiagonal system; `above[i]` couples i and i + 1.
void solve(std::vector<double> diagonal, const std::vector<double>& above, std::vector<double>& right) {
  const std::size_t n = diagonal.size();
  for (std::size_t i = 1; i < n; ++i) {
    const double f = above[i - 1] / diagonal[i - 1];
    diagonal[i] -= f * above[i - 1];
    right[i] -= f * right[i - 1];
  }
  for (std::size_t i = n; i-- > 0;) right[i] = (right[i] - (i + 1 < n ? above[i] * right[i + 1] : 0)) / diagonal[i];
}

/// … with `corner` coupling the last and the first, too (n ≥ 3). Source: Sherman & Morrison 1950.
void solve_cyclic(std::vector<double> diagonal, const std::vector<double>& above, double corner,
                  std::vector<double>& right) {
  const std::size_t last = diagonal.size() - 1;
  const double gamma = -diagonal[0];
  std::vector<double> u(diagonal.size(), 0.0);
  u[0] = gamma, u[last] = corner;
  diagonal[0] -= gamma;
  diagonal[last] -= corner * corner / gamma;
  solve(diagonal, above, right);
  solve(diagonal, above, u);
  const double per = corner / gamma, f = (right[0] + per * right[last]) / (1 + u[0] + per * u[last]);
  for (std::size_t i = 0; i <= last; ++i) right[i] -= f * u[i];
}

/// What functions that are linear between some vertices of an open path have to be, to be nearest to what is told at
/// all of its vertices; with `closed` its ends are one.
class Projection {
 public:
  /// `at`: the indices of those vertices.
  Projection(const VertexPath& path, const std::vector<std::size_t>& at, bool closed)
      : path_(path), at_(at), closed_(closed), n_(at.size() - (closed ? 1 : 0)), whole_(at.size() - 1, 0.0) {
    for (std::size_t k = 0; k < whole_.size(); ++k)
      for (std::size_t i = at[k]; i < at[k + 1]; ++i) whole_[k] += length(i);
  }

  /// `told(k, i, t)`: what is told at vertex i, a share t of the way along piece k. `length_of_piece(k)`: as it is now.
  template <class Told, class Length>
  std::vector<double> of(Told told, Length length_of_piece) const {
    std::vector<double> diagonal(n_, 0.0), above(n_, 0.0), right(n_, 0.0);
    double corner = 0;
    for (std::size_t k = 0; k < whole_.size(); ++k) {
      const std::size_t next = (k + 1) % n_;
      const double l = std::max(least, length_of_piece(k)), per = 1 / whole_[k];
      diagonal[k] += l / 3, diagonal[next] += l / 3;
      (closed_ && next == 0 ? corner : above[k]) = l / 6;
      double s = 0;
      for (std::size_t i = at_[k]; i < at_[k + 1]; ++i) {
        const double piece = length(i), t = s * per, u = (s + piece) * per;
        const double a = told(k, i, t), b = told(k, i + 1, u);
        right[k] += piece / 6 * (a * (3 - 2 * t - u) + b * (3 - t - 2 * u));
        right[next] += piece / 6 * (a * (2 * t + u) + b * (t + 2 * u));
        s += piece;
      }
    }
    if (closed_)
      solve_cyclic(std::move(diagonal), above, corner, right);
    else
      solve(std::move(diagonal), above, right);
    return right;
  }

 private:
  static constexpr double least = 1e-6;  // pieces of no length have no weight, but not none at all
  double length(std::size_t i) const { return std::max(least, length_of(path_[i], path_[i + 1])); }

  const VertexPath& path_;
  const std::vector<std::size_t>& at_;
  bool closed_;
  std::size_t n_;
  std::vector<double> whole_;
};

/// More vertices near the ends of pieces that are longer than the reach: what changes there changes there only.
VertexPath finer_at_ends(const VertexPath& path, bool closed, double reach) {
  VertexPath out;
  out.reserve(3 * path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    out.push_back(path[i]);
    if (i + 1 == path.size() && !closed) break;
    const PathVertex &a = path[i], &b = path[(i + 1) % path.size()];
    const double length = length_of(a, b);
    const auto add = [&](double s) {
      const double t = s / length;
      out.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.band + t * (b.band - a.band)});
    };
    constexpr std::array graded{0.5, 1.5, 3.5};  // of the reach
    for (const double r : graded)
      if (r * reach < length / 2) add(r * reach);
    for (auto r = graded.rbegin(); r != graded.rend(); ++r)
      if (*r * reach < length / 2) add(length - *r * reach);
  }
  return out;
}

/// Puts first the vertex that stands out most: which one is first is chance, and it stays.
void begin_at_corner(VertexPath& path) {
  const std::size_t n = path.size();
  std::size_t best = 0;
  double most = -1;
  for (std::size_t i = 0; i < n; ++i) {
    const double error = Chord(path[(i + n - 1) % n], path[(i + 1) % n]).error(path[i]);
    if (error > most * (1 + 1e-6)) most = error, best = i;
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

/// Of both ends of a piece that is too short the one goes that is missed less; where it is the path's end, the other.
/// A step of width that goes on stays. The shortest pieces go first, so that a path is the same from either end.
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
  path = finer_at_ends(path, closed, reach);
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
  if (closed)
    solve_cyclic(std::move(diagonal), above, corner, right);
  else
    solve(diagonal, above, right);
  for (std::size_t i = 0; i < n; ++i) path[i].band = right[i];
}

std::vector<std::size_t> chosen_vertices(const VertexPath& path) {
  struct Span {
    std::size_t first, last;
  };
  std::vector<std::uint8_t> keep(path.size(), 0);
  keep.front() = keep.back() = 1;
  // A vertex that stands out from its neighbours stays in any case, and spans between those are short.
  std::vector<Span> open;
  std::size_t last = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (i + 1 < path.size() && Chord(path[i - 1], path[i + 1]).error(path[i]) <= 1) continue;
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
  return without_short_pieces(path, out);
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
  const auto off = [&](double PathVertex::*axis) {
    return projection.of(
        [&](std::size_t k, std::size_t i, double t) {
          return path[i].*axis - chords[k].*axis - t * (chords[k + 1].*axis - chords[k].*axis);
        },
        length);
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
  const auto band = projection.of([&](std::size_t, std::size_t i, double) { return path[i].band; }, length);
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
