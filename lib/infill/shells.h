// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "infill/belts.h"
#include "settings/groups/infill.h"
#include "settings/groups/shells.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace weft::infill {

/// One layer of an object as shells see it.
struct ShellLayer {
  Um z = 0;  ///< top of the layer
  Um height = 0;
  const Regions* outline = nullptr;  ///< the slice
  const Regions* inside = nullptr;   ///< what the walls left of it
  const Regions* held = nullptr;     ///< what of it rests on support, where something does
  const Regions* open = nullptr;     ///< where it may be sparse; null: everywhere
};

/// An object from the bed upwards, and the box of all its outlines.
struct ShellObject {
  std::span<const ShellLayer> layers;
  Box box;
  Um nozzle = 0;              ///< diameter
  double overlap_factor = 1;  ///< how far lines side by side overlap (model/flow.h)
  double turned_rad = 0;      ///< counter-clockwise, against the file that it is of
};
Box box_of(std::span<const ShellLayer> layers);

/// Over air: free strands from support to support.
struct BridgeArea {
  Regions regions;
  double angle_rad = 0;  ///< direction of the strands, against X
  bool ledge = false;    ///< it is held at one side: lines like others of solid layers, that begin where they are held
};

/// What fills one part (region of the outline) of a layer. The areas do not overlap; together they are the part's
/// inside.
struct PartAreas {
  std::uint32_t part = 0;
  Regions top;    ///< solid, seen from above, and patches that are one surface with that
  Regions solid;  ///< other solid: bottoms, under tops, beside slopes
  Regions sparse;
  Regions combined;  ///< sparse, printed here for `combined_layers` layers at once
  int combined_layers = 1;
  std::size_t combined_turn = 0;  ///< number of the layers printed at once, by which directions of lines alternate
  std::vector<BeltLine> belts;    ///< lines of narrow solid along walls,
  Regions belted;                 ///< and what they cover
  std::vector<BridgeArea> bridges;
};
using LayerAreas = std::vector<PartAreas>;  ///< parts ascending, each once

/// What of the layers [first, first + count) is skin, bridge, or sparse.
///
/// A place is solid when, within the skin's layers above or below it, there is air: beside a slope as far as walls
/// alone are thinner than the skin. Solid also carries the walls above, and holds those that end below: all that is
/// beyond the inside of these, but for half a nozzle, or at 45° if that is more, for each layer that they are away.
/// Layers are compared on a grid of bits (mask.h) of 0.1 mm (more for objects over 150 mm); strips narrower than two
/// thirds of a line are left out unless they are seen from outside, which are widened to a line instead; belts between
/// walls and sparse infill are as wide as their lines (belts.h). Boundaries between two kinds of fill follow the grid
/// within one cell; those along walls are exact. Pre:  the layers are in order; `first + count` is within them. The
/// result of a layer does not depend on `first` and
///       `count`: call it for runs of 8 to 32 layers (a run reads the skin's layers around it).
/// Cost: 0.1 to 0.3 ms a layer for a part the size of a hand.
std::vector<LayerAreas> find_areas(const ShellSettings& settings, const InfillSettings& infill,
                                   const ShellObject& object, std::size_t first, std::size_t count);

/// What is sparse in as many layers as infill_sparse_thickness holds is printed in the highest of them, for all of
/// them; the rest stays where it is. The first layer stands for itself. `areas` is that of all layers of the object.
/// Cost: a Boolean a layer where there is something to combine.
void combine_sparse(const InfillSettings& infill, const ShellObject& object, std::vector<LayerAreas>& areas);

/// With infill_support_enabled sparse infill stays only straight below what of the shells does not carry itself: each
/// layer's that stands beyond the one below by more than infill_support_angle allows. `areas` is that of all layers of
/// the object. Cost: five Booleans and three offsets a layer.
void keep_below_tops(const InfillSettings& infill, const ShellObject& object, std::vector<LayerAreas>& areas);

}  // namespace weft::infill
