// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/few_points.h"

#include "core/stop.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace weft::infill {
namespace {

constexpr std::size_t most_dropped = 256;  // points of a chord
constexpr double corner = 0.5;             // cosine of the angle between chords from which on a point stays where it is

/// A chord of the new line: where it ends in the old one, and how far it is to be moved.
struct Chord {
  std::size_t end = 0;
  double aside = 0;
};

/// What points stand off a chord, to its left and along it, all times its length: looking at a point divides nothing.
class Off {
 public:
  explicit Off(std::span<const Point> points)
      : points_(points),
        dx_(points.back().x - points.front().x),
        dy_(points.back().y - points.front().y),
        length_(std::max(std::sqrt(dx_ * dx_ + dy_ * dy_), 1e-9)) {}

  /// Looks at every point that is a multiple of `step` behind the first.
  void look(std::size_t first, std::size_t step) {
    const Point a = points_.front();
    for (std::size_t i = first; i < points_.size(); i += step) {
      const double x = points_[i].x - a.x, y = points_[i].y - a.y, off = dx_ * y - dy_ * x, along = x * dx_ + y * dy_;
      least_ = std::min(least_, off), most_ = std::max(most_, off);
      first_ = std::min(first_, along), last_ = std::max(last_, along);
    }
  }
  /// Whether all that was looked at lies within the bound of where the chord can be moved to, and no farther than that
  /// beyond its ends.
  bool within(double bound) const {
    return first_ >= -bound * length_ && last_ <= (length_ + bound) * length_ &&
           most_ / length_ - least_ / length_ <= 2 * bound;
  }
  double middle() const { return (least_ / length_ + most_ / length_) / 2; }

 private:
  std::span<const Point> points_;
  double dx_, dy_, length_;
  double least_ = 0, most_ = 0, first_ = 0, last_ = 0;
};

/// The chord to that point, if all between lie within the bound of where it can be moved to.
bool reaches(std::span<const Point> line, std::size_t from, std::size_t to, double bound, Chord& chord) {
  constexpr std::size_t few = 8;  // of many points tell mostly that it is too long
  Off off(line.subspan(from, to - from + 1));
  if (to - from > 2 * few) {
    off.look(few / 2, few);
    if (!off.within(bound)) return false;
  }
  off.look(1, 1);
  if (!off.within(bound)) return false;
  chord = {to, off.middle()};
  return true;
}

std::vector<Chord> chords_of(std::span<const Point> line, double bound) {
  std::vector<Chord> out;
  StopNowAndThen stop(256);
  for (std::size_t from = 0; from + 1 < line.size(); from = out.back().end) {
    stop.step();
    Chord chord{from + 1, 0};
    const std::size_t last = std::min(line.size() - 1, from + most_dropped);
    std::size_t fails = last + 1;  // as far as is known
    for (std::size_t way = 2;; way *= 2) {
      const std::size_t to = std::min(from + way, last);
      if (to <= chord.end) break;
      if (!reaches(line, from, to, bound, chord)) {
        fails = to;
        break;
      }
    }
    while (chord.end + 1 < fails) {
      const std::size_t to = (chord.end + fails) / 2;
      if (!reaches(line, from, to, bound, chord)) fails = to;
    }
    out.push_back(chord);
  }
  return out;
}

}  // namespace

Polyline few_points(std::span<const Point> line, bool closed, double bound) {
  Polyline opened(line.begin(), line.end());
  if (closed && line.size() > 2) {
    std::rotate(opened.begin(), std::min_element(opened.begin(), opened.end()), opened.end());
    opened.push_back(opened.front());
  }
  if (opened.size() < 3) return opened;
  const std::vector<Chord> chords = chords_of(opened, bound);
  const std::size_t n = chords.size();
  if (closed && n < 3) return {line.begin(), line.end()};
  Polyline out;
  out.reserve(n + 1);
  if (!closed) out.push_back(opened.front());
  for (std::size_t i = 0; i < n; ++i) {
    const Point at = opened[chords[i].end];
    if (!closed && i + 1 == n) {
      out.push_back(at);
      break;
    }
    const Chord& next = chords[(i + 1) % n];
    const Point from = i == 0 ? opened.front() : opened[chords[i - 1].end], to = opened[next.end];
    const double ax = at.x - from.x, ay = at.y - from.y, bx = to.x - at.x, by = to.y - at.y;
    const double a = std::max(std::sqrt(ax * ax + ay * ay), 1e-9), b = std::max(std::sqrt(bx * bx + by * by), 1e-9);
    const double nx = -ay / a - by / b, ny = ax / a + bx / b, length = std::sqrt(nx * nx + ny * ny);
    const double by_how_much = (chords[i].aside + next.aside) / 2;
    if ((ax * bx + ay * by) / (a * b) < corner || length < 1e-9) {
      out.push_back(at);
      continue;
    }
    out.push_back(at + Point{rounded(by_how_much * nx / length), rounded(by_how_much * ny / length)});
  }
  return out;
}

}  // namespace weft::infill
