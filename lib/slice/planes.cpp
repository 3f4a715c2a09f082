// SPDX-License-Identifier: GPL-3.0-or-later
#include "slice/slice.h"

#include <algorithm>
#include <array>

namespace weft::slice {

std::vector<Plane> planes(std::span<const HeightFrom> heights, Um model_height) {
  std::vector<Plane> out;
  Um bottom = 0;
  for (std::size_t i = 0;;) {
    while (i + 1 < heights.size() && heights[i + 1].bottom <= bottom) ++i;
    const Um height = heights[i].layer_height;
    const Um below = bottom + height / 2;
    if (below > model_height) return out;
    bottom += height;
    // where the model ends in the very middle of a layer, that is cut just below its top
    out.push_back({bottom, height, std::min(below, model_height - 1)});
  }
}

std::vector<Plane> planes(const LayerSettings& settings, Um model_height) {
  const std::array heights{HeightFrom{0, settings.initial_layer_height.value_or(settings.layer_height)},
                           HeightFrom{1, settings.layer_height}};
  return planes(heights, model_height);
}

}  // namespace weft::slice
