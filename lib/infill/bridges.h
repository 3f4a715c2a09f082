// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "infill/mask.h"
#include "infill/sparse.h"

#include <optional>

namespace weft::infill {

constexpr double easy_span = 12.5;  ///< nozzles, 5 mm of 0.4: strands that hang no further do in any direction

/// How lines over a gap run.
struct Held {
  double angle_rad = 0;
  bool ledge = false;  ///< most of them are held at one end only
  double span_um = 0;  ///< of the strands that are held so: their mean, weighted by length cubed
};

/// The direction in which strands over all `gaps` hang between two supports most often, and among those the one with
/// the shortest spans. Where few strands would rest on both ends it is a ledge: the direction in which lines are held
/// at one end most often, and stand out least. Nothing where few are held at all.
/// @param below  the layer that the strands can rest on
/// Cost: 36 directions, each a scan of the gaps. Pre: there is one
std::optional<Held> held_over(const Regions& gaps, const Mask& below);

/// What strands of a layer meet around sparse infill below them.
struct OverSparse {
  const Mask& hanging;       ///< where they hang between its lines
  const Mask& open;          ///< beside that, where the layer below is sparse infill too and holds no end
  const SparseStyle& below;  ///< that infill
};

/// The direction in which strands over the sparse infill below `area` span the shortest free ways from line to line,
/// with those that `up_to_holds` lets go on. What is around the area holds them too, but where it is open: a strand
/// that ends there stands out from the last line. Along the area, where it has a direction, unless another is clearly
/// better. Nothing where no way is long in any direction: there ordinary lines do.
/// @param nozzle diameter
/// @param narrow strands across it would be dabs: they run along it and are held at both ends, or there are none
/// Cost: the infill of the area, and up to 19 scans of it.
std::optional<double> internal_bridge_angle_rad(const Region& area, const OverSparse& around, Um nozzle, bool narrow);

/// Where strands over sparse infill must go on so that each lies on two things at least: on lines of that infill, or on
/// what is around the area and not open. Along those that do not, beyond their ends; one that finds nothing stays.
/// Post: strips of whole strands, with a line's width of what each comes to lie on.
/// @param line width of a strand, µm
/// Cost: nothing for an area that nothing open is beside; else the infill around it, and a scan.
Regions up_to_holds(const Region& area, double angle_rad, const OverSparse& around, double line);

}  // namespace weft::infill
