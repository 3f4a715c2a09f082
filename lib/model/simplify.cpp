// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/simplify.h"

#include "core/stop.h"
#include "model/pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace weft {
namespace {

// A vertex so near to the straight between others tells nothing: the lattice tells no more.
constexpr double same_place_um = 0.5, same_band_um = 1;
constexpr double per_place = 1 / (same_place_um * same_place_um), per_band = 1 / (same_band_um * same_band_um);

/// The squares of how far places or bands lie off a piece, in units of what is the same.
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

/// The vertices of an open path that tell something, ascending; its ends are among them.
std::vector<std::size_t> standing_out(const VertexPath& path) {
  struct Span {
    std::size_t first, last;
  };
  std::vector<std::uint8_t> keep(path.size(), 0);
  keep.front() = keep.back() = 1;
  // A vertex that stands out from its neighbours stays in any case, and spans between those are short.
  std::vector<Span> open;
  // Long spans are cut evenly, from either end alike, so that each vertex is looked at a few times.
  const auto add = [&](std::size_t first, std::size_t end) {
    constexpr std::size_t short_enough = 16;
    const std::size_t length = end - first, parts = length / short_enough | 1;
    for (std::size_t k = 0, from = first; k < parts; ++k) {
      const std::size_t to =
          2 * k < parts - 1 ? first + (k + 1) * length / parts : end - (parts - 1 - k) * length / parts;
      keep[to] = 1;
      if (to > from + 1) open.push_back({from, to});
      from = to;
    }
  };
  std::size_t last = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (i + 1 < path.size() && !lies_off(path[i - 1], path[i], path[i + 1], 1)) continue;
    add(last, i);
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
  out.reserve(static_cast<std::size_t>(std::count(keep.begin(), keep.end(), 1)));
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
  /// `told(k, i, t)`: what is told at vertex i, a share t of the way along piece k: so many numbers.
  template <std::size_t N, class Told>
  std::array<std::vector<double>, N> of(const Tridiagonal& system, Told told) const {
    std::array<std::vector<double>, N> right;
    for (auto& r : right) r.assign(n_, 0.0);
    for (std::size_t k = 0; k < whole_.size(); ++k) {
      const double per = 1 / whole_[k];
      double s = 0, t = 0;
      std::array<double, N> a = told(k, at_[k], 0), first{}, second{};
      for (std::size_t i = at_[k]; i < at_[k + 1]; ++i) {
        s += lengths_[i];
        const double u = s * per, weight = lengths_[i] / 6;
        const double at_a = weight * (2 * t + u), at_b = weight * (t + 2 * u), both = 3 * weight;
        const std::array<double, N> b = told(k, i + 1, u);
        for (std::size_t m = 0; m < N; ++m) {
          const double more = a[m] * at_a + b[m] * at_b;
          first[m] += both * (a[m] + b[m]) - more, second[m] += more;
        }
        t = u, a = b;
      }
      for (std::size_t m = 0; m < N; ++m) right[m][k] += first[m], right[m][next_of(k)] += second[m];
    }
    for (auto& r : right) system.solve(r);
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

/// The vertex that stands out most from its neighbours: a closed path begins there, and the first one stays.
std::size_t corner_of(const VertexPath& path) {
  const std::size_t n = path.size();
  std::size_t best = 0;
  double most = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const PathVertex &a = path[i > 0 ? i - 1 : n - 1], &b = path[i + 1 < n ? i + 1 : 0];
    if (lies_off(a, path[i], b, most * (1 + 1e-6))) most = Chord(a, b).error(path[i]), best = i;
  }
  return best;
}

/// The vertices of a path, in the middle of what their pieces stand for, of bands that lay what lies there. With
/// `closed` the path's ends are one vertex, which is there twice; else they stay in place.
VertexPath projected(const VertexPath& path, const std::vector<std::size_t>& at, bool closed) {
  const Projection projection(path, at, closed);
  VertexPath out;
  out.reserve(at.size());
  for (const std::size_t i : at) out.push_back(path[i]);
  const VertexPath chords = out;
  const auto length = [&](std::size_t k) { return length_of(out[k], out[k + 1]); };
  const Tridiagonal places = projection.system(length);
  stop_if_asked();
  const auto [x, y] = projection.of<2>(places, [&](std::size_t k, std::size_t i, double t) {
    const PathVertex &p = path[i], &a = chords[k], &b = chords[k + 1];
    return std::array{p.x - a.x - t * (b.x - a.x), p.y - a.y - t * (b.y - a.y)};
  });
  stop_if_asked();
  // No piece gets too short, wherever the other end goes.
  const std::size_t pieces = at.size() - 1;
  const auto room = [&](std::size_t k) { return (length_of(chords[k], chords[k + 1]) - tolerances::least_move) / 2; };
  for (std::size_t k = closed ? 0 : 1; k < pieces; ++k) {
    const double most = std::max(0.0, std::min(room(k), room(k > 0 ? k - 1 : pieces - 1)));
    const double by = std::sqrt(x[k] * x[k] + y[k] * y[k]), share = by > most ? most / by : 1;
    out[k].x += share * x[k], out[k].y += share * y[k];
  }
  if (closed) out.back() = out.front();
  if (is_even(path)) {  // … and stays even: a polygon around a curve is longer, and as much narrower
    double whole = 0, now = 0;
    for (std::size_t i = 1; i < path.size(); ++i) whole += length_of(path[i - 1], path[i]);
    for (std::size_t k = 0; k < pieces; ++k) now += length(k);
    if (now > whole)
      for (PathVertex& v : out) v.band *= whole / now;
    return out;
  }
  const auto [band] = projection.of<1>(projection.system(length),
                                       [&](std::size_t, std::size_t i, double) { return std::array{path[i].band}; });
  // No wider nor narrower than what it stands for.
  std::vector<double> least(pieces), most(pieces);
  for (std::size_t k = 0; k < pieces; ++k) {
    least[k] = most[k] = path[at[k]].band;
    for (std::size_t i = at[k] + 1; i <= at[k + 1]; ++i)
      least[k] = std::min(least[k], path[i].band), most[k] = std::max(most[k], path[i].band);
  }
  for (std::size_t k = 0; k < out.size(); ++k) {
    const std::size_t behind = k < pieces ? k : closed ? 0 : pieces - 1;
    const std::size_t before = k > 0 ? k - 1 : closed ? pieces - 1 : 0;
    constexpr double rounded_um = 2;  // both edges, by the lattice's one
    const double narrowest = std::min(least[before], least[behind]), widest = std::max(most[before], most[behind]);
    out[k].band = std::max(1.0, std::clamp(band[k % band.size()], narrowest - rounded_um, widest + rounded_um));
  }
  return out;
}

/// A path with vertices where its pieces end.
struct Cut {
  VertexPath path;
  std::vector<std::size_t> at;      ///< the indices of those vertices
  std::vector<std::size_t> before;  ///< … and of the vertices of the path as it was that they are, or lie behind
};
/// `ends`: on the path of which only the vertices `telling` are left.
Cut cut_at(const VertexPath& path, const std::vector<std::size_t>& telling, const std::vector<Stop>& ends) {
  Cut out;
  out.path.reserve(path.size() + ends.size()), out.at.reserve(ends.size()), out.before.reserve(ends.size());
  std::size_t i = 0;
  for (const Stop& end : ends) {
    std::size_t k = telling[end.from];
    PathVertex there = path[k];
    if (end.t > 0) {  // behind what lies as far along the path itself
      const std::size_t next = telling[end.from + 1];
      there = lerp(there, path[next], end.t);
      double way = 0;
      for (std::size_t j = k; j < next; ++j) way += length_of(path[j], path[j + 1]);
      way *= end.t;
      for (double l = 0; k + 1 < next && (l = length_of(path[k], path[k + 1])) <= way; ++k) way -= l;
    }
    while (i <= k) out.path.push_back(path[i++]);
    if (end.t > 0) out.path.push_back(there);
    out.before.push_back(k);
    out.at.push_back(out.path.size() - 1);
  }
  return out;
}

}  // namespace

bool is_even(const VertexPath& path) {
  return std::all_of(path.begin(), path.end(), [&](const PathVertex& v) { return v.band == path[0].band; });
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
      out.push_back(lerp(a, b, t));
    }
  }
  path = std::move(out);
}

std::vector<std::size_t> simplify(VertexPath& path, bool closed, double worth_of_a_move) {
  std::vector<std::size_t> own(path.size());
  std::iota(own.begin(), own.end(), std::size_t{0});
  if (path.size() < (closed ? 4U : 3U)) return own;
  if (closed) {
    const std::size_t first = corner_of(path);
    std::rotate(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(first), path.end());
    std::rotate(own.begin(), own.begin() + static_cast<std::ptrdiff_t>(first), own.end());
    path.push_back(path.front());
  }
  const auto telling = standing_out(path);
  VertexPath told;
  told.reserve(telling.size());
  for (const std::size_t i : telling) told.push_back(path[i]);
  const auto ends = ends_of_pieces(told, worth_of_a_move);
  if (ends.size() < path.size() && ends.size() >= (closed ? 4U : 2U)) {
    const Cut cut = cut_at(path, telling, ends);
    path = projected(cut.path, cut.at, closed);
    std::vector<std::size_t> before;
    before.reserve(cut.before.size());
    for (const std::size_t k : cut.before) before.push_back(own[k % own.size()]);
    own = std::move(before);
  }
  if (closed) path.pop_back();
  own.resize(path.size());
  return own;
}

}  // namespace weft
