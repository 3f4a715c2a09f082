// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/stack.h"

#include "support/lengths.h"

#include <algorithm>

namespace weft::support {
namespace {

/// The tops that contacts ask for, ascending, each once.
std::vector<Um> wanted_tops(const SupportSettings& settings, const Object& object, const Demand& demand) {
  // What somebody drew is printed as it is, layer by layer.
  const bool every = settings.support_synchronize_layers || !object.given.empty();
  std::vector<Um> own, out;
  for (const auto* layer : object.layers) own.push_back(layer->z);
  for (std::size_t i = 1; i < object.layers.size(); ++i) {
    if (!every && demand[i].wanted.empty()) continue;
    const Um top = object.layers[i]->z - object.layers[i]->height - top_gap(settings);
    if (!settings.support_synchronize_layers) {
      out.push_back(top);
      continue;
    }
    const auto above = std::upper_bound(own.begin(), own.end(), top);
    if (above != own.begin()) out.push_back(*std::prev(above));
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace

Stack stack_of(const SupportSettings& settings, const Object& object, const Demand& demand) {
  Stack out;
  out.contact.assign(object.layers.size(), Stack::none);
  if (object.layers.empty()) return out;
  const Um least = object.nozzle / 4, usual = object.nozzle * 3 / 4;
  const Um most = std::clamp(settings.support_infill_sparse_thickness.value_or(usual), least, object.nozzle);
  Um below = object.floor;
  const auto add = [&](Um z) {
    const Um way = z - below;
    const Um pieces = std::max<Um>(1, (way + most - 1) / most);
    for (Um p = 1; p <= pieces; ++p) {
      const Um to = p == pieces ? z : below + (z - below) / (pieces - p + 1);
      out.levels.push_back({to, to - below});
      below = to;
    }
  };
  if (!object.on_raft) {  // what lies on the bed is printed as one layer
    out.levels.push_back({object.layers.front()->z, object.layers.front()->z - object.floor});
    below = object.layers.front()->z;
  }
  for (const Um z : wanted_tops(settings, object, demand))
    if (z - below >= std::min(least, object.layers.back()->height)) add(z);
  for (std::size_t i = 1; i < object.layers.size(); ++i) {
    const Um top = object.layers[i]->z - object.layers[i]->height - top_gap(settings);
    const auto above = std::upper_bound(out.levels.begin(), out.levels.end(), top,
                                        [](Um z, const Stack::Level& level) { return z < level.z; });
    if (above != out.levels.begin()) out.contact[i] = static_cast<std::uint32_t>(above - out.levels.begin() - 1);
  }
  return out;
}

std::size_t interface_levels(const Stack& stack, std::size_t level, Um height) {
  std::size_t count = 0;
  for (Um below = height; count <= level; below -= stack.levels[level - count++].height)
    if (below < stack.levels[level - count].height / 2) break;
  return std::max<std::size_t>(1, count);
}

}  // namespace weft::support
