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

using namespace weft::literals;

/// A slot no wider than a line, along which lines run.
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

/// The slots of a region that run as its lines do. Two lines may stand astride of one: none lies in it then.
std::vector<Slot> slots_of(const Region& region, const SolidStyle& style) {
  constexpr double widest = 1.1;    // bands
  constexpr double shortest = 4;    // bands², of a slot's area: less is a corner
  constexpr double parallel = 0.2;  // sine: what leans more is crossed by lines, and is a strip of them
  const double least_mm2 = shortest * to_mm(style.band) * to_mm(style.band);
  std::vector<Slot> out;
  const Regions wide = geometry::opening({region}, rounded(widest / 2 * style.band), geometry::Corner::miter);
  for (Region& each : geometry::subtract({region}, wide))
    if (area_mm2(each) >= least_mm2)
      if (const double along = angle_of_longest_edge(each.outer);
          angle_along_strip(each, style.band) && std::abs(std::sin(along - style.angle_rad)) < parallel)
        out.push_back({std::move(each), along});
  return out;
}

double covered_mm2(const Beads& beads, std::size_t from) {
  double mm3 = 0;
  for (std::size_t i = from; i < beads.size(); ++i) mm3 += volume_mm3(beads[i], 1_mm);
  return mm3;
}

}  // namespace

void fill_solid_and_slots(const Region& region, const SolidStyle& style, Beads& beads) {
  constexpr double of_corners = 4;  // bands²
  const std::size_t from = beads.size();
  fill_solid(region, style, beads);
  const double band_mm = to_mm(style.band);
  if (style.fixed_strand || !style.gaps || area_mm2(region) - covered_mm2(beads, from) < of_corners * band_mm * band_mm)
    return;
  const std::vector<Slot> slots = slots_of(region, style);
  if (slots.empty()) return;
  beads.resize(from);
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
