// SPDX-License-Identifier: GPL-3.0-or-later
#include "travel/off_surfaces.h"

#include "geometry/boolean.h"
#include "geometry/offset.h"

namespace weft::travel {
namespace {

/// The walls next to the outer ones: a bead's distance from them.
std::vector<Ring> second_wall_rings(const LayerInput& input) {
  std::vector<Ring> rings;
  for (const auto& object : input.objects)
    for (const auto& bead : object.beads)
      if (bead.closed && bead.inset == 1 && bead.path.size() > 2 && bead.role == Role::inner_wall)
        rings.push_back(ring_of(bead));
  return rings;
}

/// A line's width, for keeping clear of the outer wall.
Um outer_wall_width(const LayerInput& input) {
  for (const auto& object : input.objects)
    for (const auto& bead : object.beads)
      if (begins_a_seam_line(bead)) return bead.path[0].width;
  return 0;
}

Regions enclosed(const std::vector<Ring>& rings) {
  return geometry::regions_from_rings(rings, geometry::WindingRule::even_odd);
}

/// Half a nozzle more of it: what oozes lies beside it.
Regions top_skin(const LayerInput& input) {
  const auto top = gathered(input, &ObjectLayer::top);
  return top.empty() ? top : geometry::offset(top, {.by = input.nozzle / 2});
}

/// The centreline of an open bead, of three points or more.
Ring there_and_back(const Bead& bead) {
  Ring ring = ring_of(bead);
  if (ring.size() == 2) ring.insert(ring.begin() + 1, lerp(ring[0], ring[1], 0.5));
  for (std::size_t i = bead.path.size() - 1; i-- > 1;) ring.push_back(ring[i]);
  return ring;
}

/// What rings enclose (even-odd), less an area.
Comb less(std::vector<Ring> rings, const Regions& area) {
  if (area.empty()) return Comb(std::move(rings));
  return Comb(geometry::subtract(enclosed(rings), area));
}

}  // namespace

Ring ring_of(const Bead& bead) {
  Ring ring;
  ring.reserve(bead.path.size());
  for (const auto& j : bead.path) ring.push_back(j.at);
  return ring;
}

bool begins_a_seam_line(const Bead& bead) {
  return bead.closed && bead.inset == 0 && bead.path.size() > 2 && row_of(bead.role).outside;
}

std::vector<Ring> outer_wall_rings(const LayerInput& input) {
  std::vector<Ring> rings;
  for (const auto& object : input.objects)
    for (const auto& bead : object.beads)
      if (begins_a_seam_line(bead)) rings.push_back(ring_of(bead));
  return rings;
}

Regions gathered(const LayerInput& input, Regions ObjectLayer::*which) {
  Regions all;
  for (const auto& object : input.objects) all.insert(all.end(), (object.*which).begin(), (object.*which).end());
  return all;
}

Comb within_second_walls(const LayerInput& input, const Regions& outline) {
  if (auto second = second_wall_rings(input); !second.empty()) return less(std::move(second), top_skin(input));
  const auto outer = outer_wall_rings(input);
  const auto top = top_skin(input);
  if (outer.empty() && top.empty()) return Comb(outline);  // support alone
  const auto base = outer.empty() ? outline : enclosed(outer);
  const auto within = geometry::offset(base, {.by = -outer_wall_width(input)});
  return Comb(top.empty() ? within : geometry::subtract(within, top));
}

Comb half_a_bead_within(const LayerInput& input) {
  const auto inside = geometry::offset(enclosed(outer_wall_rings(input)), {.by = -outer_wall_width(input) / 2});
  const auto top = top_skin(input);
  return Comb(top.empty() ? inside : geometry::subtract(inside, top));
}

Comb outer_walls(const LayerInput& input) {
  auto rings = outer_wall_rings(input);
  for (const auto& object : input.objects)
    for (const auto& bead : object.beads)
      if (!bead.closed && bead.inset == 0 && row_of(bead.role).outside && bead.path.size() > 1)
        rings.push_back(there_and_back(bead));
  return Comb(std::move(rings));
}

Comb within_outer_walls(const LayerInput& input) {
  return less(outer_wall_rings(input), top_skin(input));
}

}  // namespace weft::travel
