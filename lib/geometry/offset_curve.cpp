// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/offset_curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::geometry {

OffsetCurve::OffsetCurve(const OffsetOptions& options, Point origin)
    : options_(options), origin_(origin), by_(options.by) {
  const double radius = std::max(1.0, std::abs(by_));
  const double sag = std::min<double>(std::max(1, options.arc_tolerance), radius);
  arc_step_rad_ = 2 * std::acos(1 - sag / radius);
}

clipper::FineRing OffsetCurve::of(const Ring& ring) {
  curve_.clear();
  read(ring);
  let_go();
  auto first = static_cast<std::uint32_t>(sides_.size() - 1);  // the last before the ring's first corner
  while (sides_[first].gone) --first;
  std::uint32_t side = first;
  do {
    put_from(side);
    side = sides_[side].after;
  } while (side != first);
  return curve_;
}

/// All that moves, from the ring's first corner on.
void OffsetCurve::read(const Ring& ring) {
  const std::size_t n = ring.size();
  const auto edge = [&](std::size_t i) {
    const Point a = ring[i], d = ring[i + 1 == n ? 0 : i + 1] - a;
    Side out;
    out.length = length_of({static_cast<double>(d.x), static_cast<double>(d.y)});
    out.along = {d.x / out.length, d.y / out.length};
    out.corner = {static_cast<double>(a.x) - origin_.x, static_cast<double>(a.y) - origin_.y};
    out.from = out.corner + moved(out.along);
    out.end = out.length;
    return out;
  };
  sides_.clear();
  Side last = edge(n - 1);
  Side* before = &last;
  for (std::size_t i = 0; i < n; ++i) {
    Side now = edge(i);
    before->folds = folds(before->along, now.along);
    if (!before->folds) {
      fan(now.corner, before->along, now.along);
      before->joint = fan_.front();
      before->end = dot_of(before->joint - before->from, before->along);
      now.begin = dot_of(fan_.back() - now.from, now.along);
      add_chords();
    }
    sides_.push_back(now);
    before = &sides_.back();
  }
  sides_.back().folds = last.folds, sides_.back().joint = last.joint;
  if (!last.folds) sides_.back().end = last.end;
  link();
}

void OffsetCurve::link() {
  for (std::uint32_t i = 0; i < sides_.size(); ++i) {
    sides_[i].after = next(i);
    sides_[next(i)].before = i;
  }
}

void OffsetCurve::add_chords() {
  for (std::size_t i = 1; i < fan_.size(); ++i) {
    const Vector d = fan_[i] - fan_[i - 1];
    Side chord;
    chord.length = chord.end = length_of(d);
    if (chord.length == 0) continue;
    chord.from = fan_[i - 1];
    chord.along = 1 / chord.length * d;
    chord.joint = fan_[i];
    sides_.push_back(chord);
  }
}

/// What fills the gap where two moved edges part.
void OffsetCurve::fan(Vector corner, Vector before, Vector after) {
  constexpr double straight = 0.1;  // µm: a miter that stands out no further is no corner
  fan_.clear();
  const double cosine = dot_of(before, after), sine = cross_of(before, after);
  const double reach = cosine > -1 ? std::sqrt(2 / (1 + cosine)) : HUGE_VAL;  // of the miter, as a multiple of by
  const double beyond = std::abs(by_) * (reach - 1);
  const double allowed = options_.corner == Corner::round ? std::max<double>(1, options_.arc_tolerance) : straight;
  if (beyond <= allowed || (options_.corner == Corner::miter && reach <= std::max(1.0, options_.miter_limit))) {
    fan_.push_back(corner + 1 / (1 + cosine) * (moved(before) + moved(after)));
    return;
  }
  const double angle_rad = cosine <= -1 ? std::numbers::pi : std::acos(std::min(1.0, cosine));
  switch (options_.corner) {
    case Corner::bevel:
      fan_.push_back(corner + moved(before));
      fan_.push_back(corner + moved(after));
      break;
    case Corner::miter: {
      const double prolonged = std::abs(by_) * std::tan(angle_rad / 4);
      fan_.push_back(corner + moved(before) + prolonged * before);
      fan_.push_back(corner + moved(after) - prolonged * after);
      break;
    }
    case Corner::round: {
      const int chords = std::max(1, static_cast<int>(std::ceil(angle_rad / arc_step_rad_)));
      const double turn_rad = (sine > 0 || (sine == 0 && by_ > 0) ? angle_rad : -angle_rad) / chords;
      const double c = std::cos(turn_rad), s = std::sin(turn_rad);
      Vector to = moved(before);
      for (int i = 0; i <= chords; ++i) {
        fan_.push_back(corner + to);
        to = {c * to.x - s * to.y, s * to.x + c * to.y};
      }
    }
  }
}

/// Where the lines of two sides cross. Pre: they fold.
OffsetCurve::Meeting OffsetCurve::meeting(std::uint32_t first, std::uint32_t second) const {
  const Side &a = sides_[first], &b = sides_[second];
  const double sine = cross_of(a.along, b.along);
  if (next(first) == second) {
    const double trimmed = std::abs(by_ * sine) / (1 + dot_of(a.along, b.along));
    return {a.length - trimmed, trimmed};
  }
  const Vector between = b.from - a.from;
  return {cross_of(between, b.along) / sine, cross_of(between, a.along) / sine};
}

/// Ends them there.
void OffsetCurve::meet(std::uint32_t first, std::uint32_t second) {
  const Meeting at = meeting(first, second);
  sides_[first].end = at.on_first, sides_[second].begin = at.on_second;
}

/// Whether two sides that follow each other cross, and do not join.
bool OffsetCurve::cross(std::uint32_t first) const {
  return sides_[first].folds || sides_[first].after != next(first);
}

/// Whether a place lies beside an edge.
bool OffsetCurve::lies_beside(Vector at, const Side& side) {
  const double along = dot_of(at - side.from, side.along);
  return along >= 0 && along <= side.length;
}
/// Whether all that an edge swept over does.
bool OffsetCurve::beside(const Side& side, const Side& other) {
  return lies_beside(side.from, other) && lies_beside(side.at(side.length), other);
}

/// Whether something is left of a side between its neighbours.
bool OffsetCurve::stays(const Side& s) const {
  return s.begin <= s.end && (s.begin <= s.length || beside(s, sides_[s.before])) &&
         (s.end >= 0 || beside(s, sides_[s.after]));
}

/// Whether nothing of a side is left between its neighbours, which cross beyond it: then it is gone.
bool OffsetCurve::goes(std::uint32_t side) {
  constexpr double parallel = 1e-6;  // nobody can tell where they cross
  Side& s = sides_[side];
  if (s.gone || stays(s) || s.before == s.after) return false;
  Side &before = sides_[s.before], &after = sides_[s.after];
  const double sine = cross_of(before.along, after.along);
  if (sine * by_ >= 0 || std::abs(sine) < parallel) return false;
  const Meeting at = meeting(s.before, s.after);
  if (at.on_first > before.length || at.on_second < 0) return false;
  const bool crosses = cross(s.before), crossed = cross(side);
  if (!crosses || !crossed) {
    if (s.takes || !beside(s, crosses ? before : after)) return false;
    (crosses ? before : after).takes = true;
  } else {
    if ((before.mixed || s.mixed) && (!lies_beside(s.from, before) || !lies_beside(s.at(s.length), after)))
      return false;
    before.takes = after.takes = true;
  }
  before.mixed |= s.mixed;
  before.after = s.after, after.before = s.before;
  s.gone = true;
  meet(s.before, s.after);
  return true;
}

void OffsetCurve::let_go() {
  const auto n = static_cast<std::uint32_t>(sides_.size());
  for (std::uint32_t i = 0; i < n; ++i) {
    sides_[i].mixed = !sides_[i].folds;
    if (sides_[i].folds) meet(i, next(i));
  }
  asked_.clear();
  for (std::uint32_t i = n; i-- > 0;)
    if (!stays(sides_[i])) asked_.push_back(i);
  while (!asked_.empty()) {
    const std::uint32_t side = asked_.back();
    asked_.pop_back();
    if (goes(side)) asked_.push_back(sides_[side].after), asked_.push_back(sides_[side].before);
  }
  for (std::uint32_t i = 0; i < n; ++i)
    if (!sides_[i].gone && !stays(sides_[i])) part(sides_[i].before), part(i);
}

/// Lets the curve run by way of all that has gone between a side and the next, as nothing of it can.
void OffsetCurve::part(std::uint32_t first) {
  Side &a = sides_[first], &b = sides_[a.after];
  if (next(first) == a.after && !a.folds) return;
  a.looped = true;
  const Side& before_b = sides_[a.after == 0 ? sides_.size() - 1 : a.after - 1];
  a.end = a.folds ? a.length : dot_of(a.joint - a.from, a.along);
  b.begin = before_b.folds ? 0 : dot_of(before_b.joint - b.from, b.along);
}

/// What lies between a side and the one that follows.
void OffsetCurve::put_from(std::uint32_t first) {
  const Side& a = sides_[first];
  if (!a.looped) return put(next(first) == a.after && !a.folds ? a.joint : a.at(a.end));
  for (std::uint32_t i = first; i != a.after; i = next(i)) {
    const Side &s = sides_[i], &t = sides_[next(i)];
    if (!s.folds) {
      put(s.joint);
      continue;
    }
    put(s.at(s.length));
    put(t.corner);
    put(t.from);
  }
}

void OffsetCurve::put(Vector at) {
  const auto step = [](double um) { return static_cast<std::int64_t>(um * clipper::steps + (um < 0 ? -0.5 : 0.5)); };
  curve_.push_back({step(at.x), step(at.y)});
}

}  // namespace weft::geometry
