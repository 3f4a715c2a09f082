// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/small_patches.h"

#include "geometry/boolean.h"

#include <utility>

namespace weft::infill {

bool SmallPatches::closes(const Region& patch) {
  return area_mm2(patch) < least_mm2_ && !goes_on_below(patch);
}

void SmallPatches::close(Mask& sparse, Mask& solid) {
  Regions small;
  for (Ring& ring : sparse.outlines())
    if (double_area(ring) > 0)
      if (Region patch{std::move(ring), {}}; closes(patch)) small.push_back(std::move(patch));
  if (small.empty()) return;
  const Mask closed = Mask(sparse.grid(), small) & sparse;
  sparse -= closed, solid |= closed;
}

bool SmallPatches::goes_on_below(const Region& patch) {
  constexpr int edge_cells = 2;  // of a patch: what it may lie beside what is below with
  if (!below_) return false;
  const Grid& grid = below_->grid();
  if (!large_) {
    Regions patches = geometry::regions_from_rings(below_->outlines());
    std::erase_if(patches, [&](const Region& each) { return area_mm2(each) < least_mm2_; });
    large_.emplace(grid, patches);
  }
  return Mask(grid.window(weft::box_of(patch.outer), grid.cell), {&patch, 1}).shrunk(edge_cells).meets(*large_);
}

}  // namespace weft::infill
