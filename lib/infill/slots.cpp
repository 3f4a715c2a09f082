// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/slots.h"

#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "infill/strips.h"

#include <cmath>
#include <utility>
#include <vector>

namespace weft::infill {
namespace {

constexpr double widest = 2.4;      // bands: of wider ones lines at an angle are no dabs
constexpr double least_area = 4;    // bands²: less is a corner
constexpr double most_bend = 0.25;  // bands, beyond its mean width
constexpr double along_side = 0.2;  // sine, between the sides of a slot

/// A straight part of a region that is about as wide as two lines, or less.
struct Slot {
  Region area;
  double angle_rad = 0;
};

/// That of the slot's side: its ends may slant.
double angle_of_longest_edge(const Ring& ring) {
  double longest = 0, angle = 0;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
    if (const double length = distance(ring[j], ring[i]); length > longest)
      longest = length, angle = std::atan2(ring[i].y - ring[j].y, ring[i].x - ring[j].x);
  return angle;
}

/// Whether two of a region's edges face each other as sides of a slot do: most regions are spared an opening by that.
bool has_sides_of_slots(const Region& region, double band) {
  struct Side {
    Point from, to;
    double length = 0;
  };
  std::vector<Side> sides;
  const auto look = [&](const Ring& ring) {
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
      if (const double length = distance(ring[j], ring[i]); 2 * length * widest >= least_area * band)
        sides.push_back({ring[j], ring[i], length});
  };
  look(region.outer);
  for (const Ring& hole : region.holes) look(hole);
  const auto faces = [&](const Side& a, const Side& b) {
    const double ax = (a.to.x - a.from.x) / a.length, ay = (a.to.y - a.from.y) / a.length,
                 bx = (b.to.x - b.from.x) / b.length, by = (b.to.y - b.from.y) / b.length;
    if (ax * bx + ay * by > 0 || std::abs(ax * by - ay * bx) > along_side) return false;
    const auto along = [&](Point p) { return (p.x - a.from.x) * ax + (p.y - a.from.y) * ay; };
    const auto off = [&](Point p) { return (p.y - a.from.y) * ax - (p.x - a.from.x) * ay; };
    return along(b.from) > 0 && along(b.to) < a.length && std::min(off(b.from), off(b.to)) > 0 &&
           std::min(off(b.from), off(b.to)) < widest * band;
  };
  for (std::size_t i = 0; i < sides.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (faces(sides[i], sides[k])) return true;
  return false;
}

/// The straight slots of a region, whichever way its lines run.
std::vector<Slot> slots_of(const Region& region, const SolidStyle& style) {
  const double least_mm2 = least_area * to_mm(style.band) * to_mm(style.band);
  std::vector<Slot> out;
  if (angle_along_strip(region, style.band) || !has_sides_of_slots(region, style.band)) return out;
  constexpr Um rounding = 3;  // what it leaves of an edge is no slot
  const Um half = rounded(widest / 2 * style.band);
  const auto grown = [](const Regions& regions, Um by) {
    return geometry::offset(regions, {.by = by, .corner = geometry::Corner::miter});
  };
  const Regions wide = grown(grown({region}, -half), half + rounding);
  for (Region& each : geometry::subtract({region}, wide))
    if (area_mm2(each) >= least_mm2 &&
        (angle_along_strip(each, style.band) || angle_of_axis(each, most_bend * style.band))) {
      const double along = angle_of_longest_edge(each.outer);
      out.push_back({std::move(each), along});
    }
  return out;
}

}  // namespace

void fill_solid_and_slots(const Region& region, const SolidStyle& style, Beads& beads) {
  std::vector<Slot> slots;
  if (!style.fixed_strand && style.gaps) slots = slots_of(region, style);
  if (slots.empty()) return fill_solid(region, style, beads);
  Regions areas;
  for (const Slot& slot : slots) areas.push_back(slot.area);
  for (const Region& rest : geometry::subtract({region}, areas)) fill_solid(rest, style, beads);
  SolidStyle along = style;
  for (const Slot& slot : slots) {
    along.angle_rad = slot.angle_rad;
    fill_solid(slot.area, along, beads);
  }
}

}  // namespace weft::infill
