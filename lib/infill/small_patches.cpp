// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/small_patches.h"

#include "infill/mask_parts.h"

#include <utility>

namespace weft::infill {
namespace {

/// The parts of an area that are that large, or those that are not.
Mask parts_of(const Mask& area, double least_mm2, bool large) {
  Mask out(area.grid());
  const MaskParts parts(area);
  for (std::size_t i = 0; i < parts.size(); ++i)
    if ((parts.mm2(i) >= least_mm2) == large)
      for (const CellRun& run : parts.runs(i)) out.set(run);
  return out;
}

bool lies_on(const Mask& below, const Region& patch) {
  constexpr int edge_cells = 2;  // of a patch: what it may lie beside what is below with
  const Grid& grid = below.grid();
  return Mask(grid.window(weft::box_of(patch.outer), grid.cell), {&patch, 1}).shrunk(edge_cells).meets(below);
}

bool lies_beside(const Mask& area, const Region& patch) {
  const Grid& grid = area.grid();
  return Mask(grid.window(weft::box_of(patch.outer), 2 * grid.cell), {&patch, 1}).grown(1).meets(area);
}

}  // namespace

template <class Closes>
void SmallPatches::close_where(Mask& sparse, Mask& solid, const Closes& closes) const {
  const Mask candidates = parts_of(sparse, least_mm2_, false);
  if (!candidates.any()) return;
  Regions small;
  for (Ring& ring : candidates.outlines()) {
    Region patch{std::move(ring), {}};  // looked at without its holes, and no smaller for that
    if (double_area(patch.outer) >= 0 && area_mm2(patch) < least_mm2_ && closes(patch))
      small.push_back(std::move(patch));
  }
  if (small.empty()) return;
  const Mask closed = Mask(sparse.grid(), small) & sparse;
  sparse -= closed, solid |= closed;
}

void SmallPatches::close(Mask& sparse, Mask& solid) const {
  std::optional<Mask> large;
  close_where(sparse, solid, [&](const Region& patch) {
    if (below_ && !large) large = parts_of(*below_, least_mm2_, true);
    return !large || !lies_on(*large, patch);
  });
}

void SmallPatches::give_to(Mask& bridge, Mask& sparse) const {
  if (below_)
    close_where(sparse, bridge,
                [&](const Region& patch) { return lies_on(*below_, patch) && lies_beside(bridge, patch); });
}

bool SmallPatches::closes(const Region& patch) const {
  return area_mm2(patch) < least_mm2_ && !(below_ && lies_on(*below_, patch));
}

}  // namespace weft::infill
