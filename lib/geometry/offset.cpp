// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/offset.h"

#include "core/stop.h"
#include "geometry/clipper_door.h"
#include "geometry/nesting.h"
#include "geometry/simplify.h"
#include "geometry/spatial_index.h"
#include "geometry/wound.h"

#include <cassert>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace weft::geometry {
namespace {

struct Vector {
  double x = 0, y = 0;
  friend Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y}; }
  friend Vector operator*(double s, Vector v) { return {s * v.x, s * v.y}; }
};
double dot_of(Vector a, Vector b) {
  return a.x * b.x + a.y * b.y;
}
double cross_of(Vector a, Vector b) {
  return a.x * b.y - a.y * b.x;
}

/// An edge's length in µm and its unit normal, to the right of its direction: outwards for a counter-clockwise ring.
struct Edge {
  Vector normal;
  double length = 0;
  Vector along() const { return {-normal.y, normal.x}; }
};

/// Draws the raw offset curve of rings: it may cross itself; what it winds around positively is the offset region.
class Pen {
 public:
  Pen(const OffsetOptions& options, Point origin) : options_(options), origin_(origin), by_(options.by) {
    const double radius = std::max(1.0, std::abs(by_));
    const double sag = std::min<double>(std::max(1, options.arc_tolerance), radius);
    arc_step_rad_ = 2 * std::acos(1 - sag / radius);
  }

  clipper::FineRing draw(const Ring& ring) {
    curve_.clear();
    const std::size_t n = ring.size();
    edges_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      const Point d = ring[i + 1 == n ? 0 : i + 1] - ring[i];
      const double length = std::hypot(d.x, d.y);
      edges_[i] = {{d.y / length, -d.x / length}, length};
    }
    for (std::size_t i = 0; i < n; ++i) turn(ring[i], edges_[i == 0 ? n - 1 : i - 1], edges_[i]);
    return curve_;
  }

 private:
  void turn(Point at, const Edge& before, const Edge& after) {
    corner_ = {static_cast<double>(at.x) - origin_.x, static_cast<double>(at.y) - origin_.y};
    const double cosine = dot_of(before.normal, after.normal), sine = cross_of(before.normal, after.normal);
    if (sine * by_ < 0)
      fold(before, after, cosine, sine);
    else
      fan(before, after, cosine, sine);
  }

  /// The offset edges cross each other.
  void fold(const Edge& before, const Edge& after, double cosine, double sine) {
    const double trimmed = std::abs(by_ * sine) / (1 + cosine);
    if (trimmed <= std::min(before.length, after.length) / 2) {
      put(by_ / (1 + cosine) * (before.normal + after.normal));
      return;
    }
    put(by_ *
        before.normal);  // by way of the corner itself: the loops so made wind negatively, however short the edges
    put({0, 0});
    put(by_ * after.normal);
  }

  /// The offset edges leave a gap.
  void fan(const Edge& before, const Edge& after, double cosine, double sine) {
    constexpr double straight = 0.1;  // µm: a miter that stands out no further is no corner
    const double reach = cosine > -1 ? std::sqrt(2 / (1 + cosine)) : HUGE_VAL;  // of the miter, as a multiple of by
    const double beyond = std::abs(by_) * (reach - 1);
    const double allowed = options_.corner == Corner::round ? std::max<double>(1, options_.arc_tolerance) : straight;
    if (beyond <= allowed || (options_.corner == Corner::miter && reach <= std::max(1.0, options_.miter_limit))) {
      put(by_ / (1 + cosine) * (before.normal + after.normal));
      return;
    }
    const double angle_rad = cosine <= -1 ? std::numbers::pi : std::acos(std::min(1.0, cosine));
    switch (options_.corner) {
      case Corner::bevel:
        put(by_ * before.normal);
        put(by_ * after.normal);
        break;
      case Corner::miter: {
        const double prolonged = std::abs(by_) * std::tan(angle_rad / 4);
        put(by_ * before.normal + prolonged * before.along());
        put(by_ * after.normal + -prolonged * after.along());
        break;
      }
      case Corner::round: {
        const int chords = std::max(1, static_cast<int>(std::ceil(angle_rad / arc_step_rad_)));
        const double turn_rad = (sine > 0 || (sine == 0 && by_ > 0) ? angle_rad : -angle_rad) / chords;
        for (int i = 0; i <= chords; ++i) {
          const double c = std::cos(i * turn_rad), s = std::sin(i * turn_rad);
          const Vector n = before.normal;
          put(by_ * Vector{c * n.x - s * n.y, s * n.x + c * n.y});
        }
      }
    }
  }

  void put(Vector from_corner) {
    const Vector p = corner_ + from_corner;
    curve_.push_back({std::llround(p.x * clipper::steps), std::llround(p.y * clipper::steps)});
  }

  OffsetOptions options_;
  Point origin_;
  double by_;
  double arc_step_rad_ = 0;
  Vector corner_;
  std::vector<Edge> edges_;
  clipper::FineRing curve_;
};
/// Curves that neither cross nor touch anything are outlines as they are, and those that cross cleanly are followed
/// from crossing to crossing: no sweep is needed.
std::optional<Regions> settled(const clipper::FineRings& curves, Point origin) {
  std::vector<Ring> rings;
  for (const auto& curve : curves) {
    rings.push_back(clipper::coarse(curve, origin));
    if (rings.back().empty()) rings.pop_back();
  }
  const SegmentIndex index(rings);
  const auto crossings = index.clean_crossings();
  if (!crossings) return std::nullopt;
  if (crossings->empty()) return nested_apart(rings, index, WindingRule::positive);
  auto outlines = wound(rings, index, *crossings);
  if (!outlines) return std::nullopt;
  return clipper::tidied(*std::move(outlines), origin);
}
}  // namespace

Regions offset(const Regions& regions, const OffsetOptions& options) {
  const Box box = box_of(regions);
  if (box.empty()) return {};
  Pen pen(options, box.centre());
  clipper::FineRings curves;
  StopNowAndThen stop(64);
  const auto draw = [&](Ring ring) {
    stop.step();
    drop_collinear(ring);
    if (ring.size() >= 3) curves.push_back(pen.draw(ring));
  };
  for (const auto& region : regions) {
    draw(region.outer);
    for (const auto& hole : region.holes) draw(hole);
  }
  if (auto done = settled(curves, box.centre())) return *std::move(done);
  return clipper::run(clipper::Operation::unite, WindingRule::positive, curves, {}, box.centre());
}

Regions opening(const Regions& regions, Um radius, Corner corner) {
  return offset(offset(regions, {.by = -radius, .corner = corner}), {.by = radius, .corner = corner});
}

Regions closing(const Regions& regions, Um radius, Corner corner) {
  return offset(offset(regions, {.by = radius, .corner = corner}), {.by = -radius, .corner = corner});
}

}  // namespace weft::geometry
