// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "model/bead.h"
#include "settings/groups/infill.h"

#include <array>
#include <cstddef>
#include <functional>
#include <span>

namespace weft::infill {

/// What figures of a layer's sparse infill are made from.
struct LookedAtLayer {
  Um height = 0;
  const Regions* outline = nullptr;  ///< the slice
  const Regions* sparse = nullptr;   ///< what sparse infill may fill
  const Beads* beads = nullptr;      ///< all; those with Role::infill count
};

/// Bounds of what sparse infill has of the plastic's own, 0 … 1, by its density alone.
struct Bounds {
  double stiffness_plane = 0, stiffness_z = 0;  ///< Young's modulus
  double conductivity_plane = 0, conductivity_z = 0;
};

/// What the sparse infill of an object is like.
struct Figures {
  double room_mm3 = 0, mm3 = 0, mm = 0;
  double in_room_mm3 = 0;     ///< of mm3: what is printed for several layers at once counts as one layer's
  double length_spread = 0;   ///< deviation between layers that have room, of the length of lines in it, of its mean
  double density_spread = 0;  ///< deviation between layers that have room, of the density, 0 … 1
  std::array<double, 3> fabric{};  ///< h₂, h₄, h₆: ‖Σ ℓ e^{inα}‖ / Σ ℓ; h₂ is 0 where no direction is preferred
  double looked_mm = 0, over_air_mm = 0;  ///< of every fifth layer: length, and what of it lies on nothing below
  double locality = 0;       ///< of the middle layer: greatest d² / (path between × b/ρ); 6 of Hilbert's curve
  double box_dimension = 0;  ///< of the middle layer: slope of log boxes over −log size, from 2 b/ρ to a quarter of it
  Bounds bounds;             ///< at the density that was laid

  double density() const { return room_mm3 > 0 ? in_room_mm3 / room_mm3 : 0; }
};

/// Bounds by density. Sources: Gibson & Ashby 1997, "Cellular solids", chapters 4 and 5: walls along the load carry
/// ρ, a lattice of triangles in its plane ρ/3, of hexagons 1.5 ρ³, an open foam ρ²; conductivity: Hashin & Shtrikman
/// 1962, in the plane of upright walls ρ/(2 − ρ), of sheets in space 2ρ/(3 − ρ).
Bounds bounds_of(InfillPattern pattern, double density);

/// @param layers upwards
/// @param for_each calls what it is given with each number below that count, in any order, also side by side
/// Cost: 20 ns a segment, and for every fifth layer 10 ns for each 0.1 mm of its infill.
using ForEach = std::function<void(std::size_t count, const std::function<void(std::size_t)>& f)>;
Figures figures_of(const InfillSettings& infill, std::span<const LookedAtLayer> layers, const ForEach& for_each);

}  // namespace weft::infill
