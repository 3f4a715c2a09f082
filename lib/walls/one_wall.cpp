// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/one_wall.h"

#include "geometry/boolean.h"
#include "geometry/offset.h"

#include <iterator>
#include <utility>

namespace weft::walls {

Regions seen_from_above(const Widths& widths, const Regions& inside, const Regions& above) {
  return geometry::opening(geometry::subtract(inside, above), rounded(widths.inner));
}

void add_covered_walls(const WallSettings& settings, const Widths& widths, const Regions& seen, Um nozzle,
                       std::uint32_t index, Part& part) {
  Widths own = widths;
  own.outer = widths.inner, own.bulge = 0;
  own.walls = widths.walls - 1;
  if (own.walls <= 0) return;
  // What is narrower than a wall is left to skin, which is there on both sides of it.
  const Regions covered =
      geometry::opening(geometry::subtract(part.inside, seen), rounded(widths.inner / 2), geometry::Corner::miter);
  Regions inside = geometry::subtract(part.inside, covered);
  for (const Region& region : covered) {
    Part walls = part_of(settings, own, region, nozzle, index);
    for (Bead& bead : walls.beads) {
      bead.role = Role::inner_wall, ++bead.inset;
      part.beads.push_back(std::move(bead));
    }
    std::move(walls.inside.begin(), walls.inside.end(), std::back_inserter(inside));
    part.valid = part.valid && walls.valid;
  }
  part.inside = geometry::unite(inside);
}

}  // namespace weft::walls
