// SPDX-License-Identifier: GPL-3.0-or-later
#include "travel/comb_base.h"

#include "geometry/boolean.h"
#include "geometry/offset.h"

#include <algorithm>
#include <cmath>

namespace weft::travel {
namespace {

bool is_outer_wall(const Bead& bead) {
  return bead.inset == 0 && (bead.role == Role::outer_wall || bead.role == Role::overhang_wall);
}

bool is_closed_wall(const Bead& bead) {
  return is_outer_wall(bead) && bead.closed && bead.path.size() > 2;
}

/// What the parts of an object have.
struct Part {
  bool beads = false, closed = false, open = false;
};

std::vector<Part> parts_of(const ObjectLayer& object) {
  std::vector<Part> parts(object.outline.size());
  for (const Bead& bead : object.beads) {
    if (bead.part >= parts.size()) parts.resize(bead.part + 1);
    Part& part = parts[bead.part];
    part.beads = true;
    if (is_closed_wall(bead))
      part.closed = true;
    else if (is_outer_wall(bead) && bead.path.size() > 1)
      part.open = true;
  }
  return parts;
}

/// The band of an open bead, piece by piece.
void add_band(const Bead& bead, std::vector<Ring>& rings) {
  for (std::size_t i = 1; i < bead.path.size(); ++i) {
    const Junction &a = bead.path[i - 1], &b = bead.path[i];
    const double length = distance(a.at, b.at);
    if (length <= 0) continue;
    const double x = (b.at.x - a.at.x) / length, y = (b.at.y - a.at.y) / length;
    const auto beside = [&](const Junction& j, double along, double side) {
      const double half = j.width / 2.0;  // reaches over its ends, too, so that pieces meet
      return Point{j.at.x + rounded(half * (along * x - side * y)), j.at.y + rounded(half * (along * y + side * x))};
    };
    rings.push_back({beside(a, -1, -1), beside(b, 1, -1), beside(b, 1, 1), beside(a, -1, 1)});
  }
}

/// The outline of a part without walls, grown to where its beads end.
Regions reached(const Region& outline, std::uint32_t part, const Beads& beads) {
  constexpr Um most = 5000;
  const Comb edge(Regions{outline});
  double beyond = 0;
  for (const Bead& bead : beads) {
    if (bead.part != part) continue;
    for (const Junction& j : bead.path)
      if (edge.part_of(j.at) == Comb::outside)
        if (const auto near = edge.nearest_on_boundary(j.at, most)) beyond = std::max(beyond, distance(j.at, *near));
  }
  if (beyond <= 0) return {outline};
  return geometry::offset({outline}, {.by = rounded(std::ceil(beyond)), .corner = geometry::Corner::round});
}

/// The parts of an object that have no walls, as far as their infill reaches. Support's beads end within its outline.
void add_parts_without_walls(const ObjectLayer& object, Regions& out) {
  const auto parts = parts_of(object);
  for (std::uint32_t i = 0; i < object.outline.size(); ++i) {
    if (!parts[i].beads || parts[i].closed || parts[i].open) continue;
    if (object.support) {
      out.push_back(object.outline[i]);
      continue;
    }
    const Regions part = reached(object.outline[i], i, object.beads);
    out.insert(out.end(), part.begin(), part.end());
  }
}

}  // namespace

bool all_closed(const LayerInput& input) {
  for (const ObjectLayer& object : input.objects)
    for (const Part& part : parts_of(object))
      if (part.beads && (!part.closed || part.open)) return false;
  return true;
}

Regions comb_base(const LayerInput& input, Um by) {
  std::vector<Ring> closed, bands;
  Regions others;
  for (const ObjectLayer& object : input.objects) {
    for (const Bead& bead : object.beads) {
      if (is_closed_wall(bead)) {
        Ring& ring = closed.emplace_back();
        for (const Junction& j : bead.path) ring.push_back(j.at);
      } else if (is_outer_wall(bead)) {
        add_band(bead, bands);
      }
    }
    add_parts_without_walls(object, others);
  }
  Regions base = geometry::regions_from_rings(closed, geometry::WindingRule::even_odd);
  if (!bands.empty()) base = geometry::unite(base, geometry::regions_from_rings(bands));
  if (by != 0) base = geometry::offset(base, {.by = by, .corner = geometry::Corner::round});
  if (others.empty()) return base;
  base.insert(base.end(), others.begin(), others.end());
  return geometry::regions_from_rings(geometry::rings_of(base));  // most lie apart from each other
}

}  // namespace weft::travel
