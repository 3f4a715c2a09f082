// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stop.h"
#include "geometry/boolean.h"
#include "infill/shells.h"

#include <algorithm>
#include <cstdint>

namespace weft::infill {
namespace {

/// The layers that are printed at once, from `first`: as many as stand below `most`.
std::size_t end_of_group(const ShellObject& object, std::size_t first, Um most) {
  std::size_t end = first;
  for (Um height = 0; end < object.layers.size(); ++end) {
    height += object.layers[end].height;
    if (height > most) break;
  }
  return std::max(end, first + 1);
}

Regions sparse_of(const LayerAreas& layer) {
  Regions out;
  for (const PartAreas& part : layer) out.insert(out.end(), part.sparse.begin(), part.sparse.end());
  return out;
}

}  // namespace

void combine_sparse(const InfillSettings& infill, const ShellObject& object, std::vector<LayerAreas>& areas) {
  if (!infill.infill_sparse_thickness || infill.infill_sparse_density <= 0) return;
  constexpr Um rounding = 1;  // heights of layers are rounded
  const Um most = std::min(*infill.infill_sparse_thickness, object.nozzle) + rounding;
  std::size_t turn = 0;
  for (std::size_t first = 1, end = first; first < areas.size(); first = end, ++turn) {
    stop_if_asked();
    end = end_of_group(object, first, most);
    const std::size_t count = end - first, last = end - 1;
    if (count < 2 || end > areas.size()) continue;
    Regions common = sparse_of(areas[first]);
    for (std::size_t i = first + 1; i < end && !common.empty(); ++i)
      common = geometry::intersect(common, sparse_of(areas[i]));
    if (common.empty()) continue;
    for (PartAreas& part : areas[last])
      if (!part.sparse.empty()) {
        part.combined = geometry::intersect(part.sparse, common);
        part.combined_layers = static_cast<int>(count), part.combined_turn = turn;
      }
    for (std::size_t i = first; i < end; ++i)
      for (PartAreas& part : areas[i])
        if (!part.sparse.empty()) part.sparse = geometry::subtract(part.sparse, common);
  }
}

}  // namespace weft::infill
