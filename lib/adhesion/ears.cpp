// SPDX-License-Identifier: GPL-3.0-or-later
#include "adhesion/ears.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "geometry/spatial_index.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace weft::adhesion {
namespace {

using namespace weft::literals;

constexpr Um first_radius = 2_mm, least_radius = 0.25_mm;
/// Chords stand off the disc, and edges are rounded to the lattice: what is thinner than this was not left over by it.
constexpr Um sliver = 8;
constexpr double deeper = 1.3;   // than a corner of that width is: it sticks out
constexpr Um same_tip = 0.3_mm;  // tips no further apart are one

double off_ring(const Ring& ring, Point p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
    least = std::min<double>(least, geometry::foot_of(p, {ring[j], ring[i]}).distance_um);
  return least;
}
double off(const Regions& regions, Point p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Region& region : regions) {
    least = std::min(least, off_ring(region.outer, p));
    for (const Ring& hole : region.holes) least = std::min(least, off_ring(hole, p));
  }
  return least;
}

/// Where a piece that the disc leaves over touches what it covers: the two places that are furthest apart.
struct Mouth {
  Point a, b;
  double width() const { return distance(a, b); }
};
std::optional<Mouth> mouth_of(const Region& piece, const Regions& covered) {
  const Box near = box_of(piece.outer).grown(2 * sliver);
  std::vector<geometry::Segment> edges;
  for (const Region& region : covered)
    for (std::size_t i = 0, j = region.outer.size() - 1; i < region.outer.size(); j = i++) {
      Box box;
      box.add(region.outer[j]), box.add(region.outer[i]);
      if (box.overlaps(near)) edges.push_back({region.outer[j], region.outer[i]});
    }
  std::vector<Point> on;
  for (const Point p : piece.outer)
    if (std::any_of(edges.begin(), edges.end(),
                    [&](const auto& edge) { return geometry::foot_of(p, edge).distance_um <= sliver + 3; }))
      on.push_back(p);
  if (on.size() < 2) return std::nullopt;
  Mouth out{on.front(), on.front()};
  for (const Point p : on)
    for (const Point q : on)
      if (distance(p, q) > out.width()) out = {p, q};
  return out;
}

/// The place of a piece that is furthest from its mouth, and how far that is.
struct Tip {
  Point at;
  double depth_um = 0;
};
Tip tip_of(const Region& piece, const Mouth& mouth) {
  Tip out{piece.outer.front(), -1};
  for (const Point p : piece.outer) {
    const double depth = geometry::foot_of(p, {mouth.a, mouth.b}).distance_um;
    if (depth > out.depth_um) out = {p, depth};
  }
  return out;
}

/// Half the angle of the corner that has such a mouth. Between a side and the disc what is left over runs out in a
/// wedge, which is a sliver from √(2 · radius · sliver) before its end on.
double half_angle(double mouth_um, Um radius) {
  const double lost = std::sqrt(2.0 * radius * sliver);
  return std::acos(std::min(mouth_um / (2 * std::hypot(radius, lost)), 1.0)) - std::atan2(lost, radius);
}

class Tips {
 public:
  explicit Tips(double sharper_than_deg) : most_rad_(sharper_than_deg * std::numbers::pi / 180) {}

  /// @param body what the region was cut from: where they meet is no tip
  void find(const Region& region, const Regions& body, Um radius) {
    stop_if_asked();
    const Regions covered = geometry::opening({region}, radius);
    const Regions about = geometry::offset(covered, {.by = sliver});
    for (const Region& piece : geometry::subtract({region}, about)) {
      const auto mouth = mouth_of(piece, covered);
      if (!mouth) {
        smaller(piece, body, radius);
        continue;
      }
      const double half = half_angle(mouth->width(), radius);
      const Tip tip = tip_of(piece, *mouth);
      const double corner_um = radius * std::cos(half) * std::cos(half) / std::max(std::sin(half), 1e-6);
      if (tip.depth_um > deeper * corner_um + sliver)
        smaller(piece, covered, radius);
      else if (2 * half <= most_rad_)
        add(tip.at, body);
    }
  }

  std::vector<Point> take() && { return std::move(tips_); }

 private:
  void smaller(const Region& piece, const Regions& body, Um radius) {
    if (radius / 2 >= least_radius) return find(piece, body, radius / 2);
    if (area_mm2(piece) > 0.01) add(box_of(piece.outer).centre(), body);  // a needle
  }
  void add(Point at, const Regions& body) {
    if (!body.empty() && off(body, at) <= same_tip) return;
    if (std::none_of(tips_.begin(), tips_.end(), [&](Point p) { return distance(p, at) <= same_tip; }))
      tips_.push_back(at);
  }

  double most_rad_;
  std::vector<Point> tips_;
};

}  // namespace

std::vector<Point> tips_of(const Regions& outlines, double sharper_than_deg) {
  Tips tips(sharper_than_deg);
  for (const Region& region : outlines) tips.find({region.outer, {}}, {}, first_radius);
  return std::move(tips).take();
}

}  // namespace weft::adhesion
