// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/small_patches.h"

#include "infill/mask_parts.h"

#include <utility>

namespace weft::infill {

bool SmallPatches::closes(const Region& patch) {
  return area_mm2(patch) < least_mm2_ && !goes_on_below(patch);
}

void SmallPatches::close(Mask& sparse, Mask& solid) {
  const MaskParts parts(sparse);
  Mask candidates(sparse.grid());  // a patch is looked at without its holes, and no smaller for that
  bool any = false;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts.mm2(i) >= least_mm2_) continue;
    for (const CellRun& run : parts.runs(i)) candidates.set(run);
    any = true;
  }
  if (!any) return;
  Regions small;
  for (Ring& ring : candidates.outlines())
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
    large_.emplace(grid);
    const MaskParts parts(*below_);
    for (std::size_t i = 0; i < parts.size(); ++i)
      if (parts.mm2(i) >= least_mm2_)
        for (const CellRun& run : parts.runs(i)) large_->set(run);
  }
  return Mask(grid.window(weft::box_of(patch.outer), grid.cell), {&patch, 1}).shrunk(edge_cells).meets(*large_);
}

}  // namespace weft::infill
