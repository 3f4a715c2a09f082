// SPDX-License-Identifier: GPL-3.0-or-later
#include "slice/slice.h"

#include <algorithm>

namespace weft::slice {

std::vector<Plane> planes(const LayerSettings& settings, Um model_height) {
  std::vector<Plane> out;
  Um bottom = 0;
  for (Um height = settings.initial_layer_height.value_or(settings.layer_height);; height = settings.layer_height) {
    const Um below = bottom + height / 2;
    if (below > model_height) return out;
    bottom += height;
    // where the model ends in the very middle of a layer, that is cut just below its top
    out.push_back({bottom, height, std::min(below, model_height - 1)});
  }
}

}  // namespace weft::slice
