// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/landing.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/trimmed.h"
#include "support/kinds.h"
#include "support/lengths.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace weft::support {
namespace {

/// A part of a layer that stands on the part, and how high it is to be.
struct Landing {
  Regions area;  ///< what of it is wide enough to be printed apart
  Um height = 0;
  double mm2 = 0;  ///< all of it
};

std::vector<Landing> landings_of(const Room& room, const SupportLayer& layer, const SupportLayer& below) {
  const auto& s = room.settings();
  const auto& object = room.object();
  const Um gap = bottom_gap(s), line = line_width(s, object.nozzle), bottom = layer.z - layer.height;
  const auto run = layers_between(object, bottom - gap - below.height, bottom - gap);
  std::vector<Landing> out;
  const Regions under = all_areas(below);
  for (const auto kind : kinds)
    for (const Region& region : layer.*kind) {
      const Box near = box_of(region.outer).grown(line + 1);
      const Regions rests_on = geometry::trimmed(under, near);
      if (rests_on.size() == 1 && rests_on.front() == region) continue;  // as most of a column does
      Regions part = room.part(bottom - gap - below.height, bottom - gap, near);
      if (part.empty() || geometry::intersect({region}, part).empty()) continue;
      Regions standing = geometry::subtract({region}, grown(rests_on, line));
      for (std::size_t i = run.to; i-- > run.from && !standing.empty();) {  // the highest is what it stands on
        const Um z = object.layers[i]->z, free = bottom - z - gap;
        if (free < 0) continue;
        const Regions here = geometry::intersect(standing, room.part(z - 1, z, near));
        if (here.empty()) continue;
        standing = geometry::subtract(standing, here);
        Regions wide = free > 1 && !s.support_synchronize_layers ? opened(here, line) : Regions{};
        out.push_back({std::move(wide), layer.height + free, area_mm2(here)});
      }
    }
  return out;
}

/// Takes an area out of a layer, kind by kind.
SupportLayer taken(SupportLayer& layer, const Regions& area) {
  SupportLayer out{layer.z, layer.height, {}, {}, {}, {}, layer.first, {}};
  for (const auto kind : kinds) {
    if ((layer.*kind).empty()) continue;
    out.*kind = geometry::intersect(layer.*kind, area);
    if (!(out.*kind).empty()) layer.*kind = geometry::subtract(layer.*kind, area);
  }
  return out;
}

}  // namespace

double land(const Room& room, std::vector<SupportLayer>& layers) {
  const auto& settings = room.settings();
  if (settings.support_type == SupportType::buildplate || layers.empty()) return 0;
  const Um most = room.object().nozzle * 3 / 4;
  const auto landings = tasks::parallel_map(layers.size(), [&](std::size_t k) {
    stop_if_asked();
    return k == 0 ? std::vector<Landing>{} : landings_of(room, layers[k], layers[k - 1]);
  });
  std::vector<SupportLayer> lowest;
  double on_part_mm2 = 0;
  for (std::size_t k = 1; k < layers.size(); ++k)
    for (const auto& landing : landings[k]) {
      on_part_mm2 += landing.mm2;
      if (landing.area.empty()) continue;
      auto own = taken(layers[k], landing.area);
      own.height = landing.height;
      if (landing.height > most) {
        own.height = landing.height - landing.height / 2;
        auto under = own;
        under.z -= own.height, under.height = landing.height / 2;
        lowest.push_back(std::move(under));
      }
      lowest.push_back(std::move(own));
    }
  if (lowest.empty()) return on_part_mm2;
  std::move(lowest.begin(), lowest.end(), std::back_inserter(layers));
  return on_part_mm2;
}

}  // namespace weft::support
