// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "mesh/placement.h"

#include <optional>
#include <span>
#include <vector>

namespace weft::mesh {

/// Something to be put on a plate, by its footprint around (0, 0).
struct Item {
  Point size;        ///< of its box, which is centred
  const Ring* hull;  ///< convex; what has to be on the surface
};

struct Arrangement {
  std::vector<Point> at;  ///< of each item
  bool fits = false;
};

/// Places for the items with `spacing` between their boxes. Deterministic.
/// Throws: Error::Kind::audit when they would leave the lattice.
Arrangement arrange(std::span<const Item> items, const Plate& plate, std::optional<Point> center, Um spacing);

}  // namespace weft::mesh
