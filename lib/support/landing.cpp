// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/landing.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/trimmed.h"
#include "support/kinds.h"
#include "support/lengths.h"
#include "support/thin.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <utility>

namespace weft::support {
namespace {

/// A part of a layer that stands on the part, and how high it is to be.
struct Landing {
  Regions area;  ///< what of it is wide enough to be printed apart
  Um height = 0;
  double mm2 = 0;  ///< all of it
  Regions feet;    ///< what of it may stand on feet
  std::size_t feet_levels = 0;
};

/// How high what stands on a place goes on above it, but no more than about `most`.
Um height_above(const Box& place, std::span<const SupportLayer> levels, Um most) {
  const auto meets = [&](const SupportLayer& level) {
    return std::any_of(kinds.begin(), kinds.end(), [&](const auto kind) {
      const Regions& all = level.*kind;
      return std::any_of(all.begin(), all.end(), [&](const Region& r) { return box_of(r.outer).overlaps(place); });
    });
  };
  Um height = 0;
  for (const SupportLayer& level : levels) {
    if (height > most || !meets(level)) break;
    height += level.height;
  }
  return height;
}

/// What of an area that stands on the part may do so by feet: what has more of its kind above it, to cross from foot to
/// foot, and is no higher than feet hold. What crosses sags by less than it is high, so feet are as high as a bead may
/// be, and nothing comes nearer to the part than they.
/// @param column  that it is of
/// @param above   the levels above
void stand_on_feet(const Room& room, const Region& column, Regions SupportLayer::*kind,
                   std::span<const SupportLayer> above, const Regions& area, Landing& landing) {
  constexpr double steady = 5;  // height by width: feet are a quarter of the beads that hold what is four times that
  const double wide = 4e6 * area_mm2(column) / perimeter_of(column.outer);  // a square's side, twice a strip's
  const Um most = rounded(steady * wide), least = room.object().nozzle * 2 / 3;
  std::size_t levels = 1;
  for (Um height = landing.height;; height += above[levels++ - 1].height) {
    if (levels > above.size()) return;
    const Regions& next = above[levels - 1].*kind;
    if (height >= least) {
      landing.feet = geometry::intersect(area, geometry::trimmed(next, box_of(area)));
      break;
    }
    if (std::find(next.begin(), next.end(), column) == next.end()) return;  // feet would stand beside each other
  }
  if (height_above(box_of(area), above, most) > most) landing.feet.clear();
  landing.feet_levels = levels;
}

/// @param layers  of which the second lies on the first
std::vector<Landing> landings_of(const Room& room, std::span<const SupportLayer> layers) {
  const SupportLayer &below = layers[0], &layer = layers[1];
  const auto& s = room.settings();
  const auto& object = room.object();
  const Um gap = bottom_gap(s), line = line_width(s, object.nozzle), bottom = layer.z - layer.height;
  const auto run = layers_between(object, bottom - gap - below.height, bottom - gap);
  constexpr double all_of_it = 0.98;  // nothing would be left that is thin
  std::vector<Landing> out;
  const Regions under = all_areas(below);
  for (const auto kind : kinds)
    for (const Region& region : layer.*kind) {
      const Regions& same_below = below.*kind;  // as most of a column has
      if (std::find(same_below.begin(), same_below.end(), region) != same_below.end()) continue;
      const Regions alone{region};
      if (!room.comes_near(bottom - gap - below.height, bottom - gap, alone, geometry::SegmentIndex(alone), 0))
        continue;
      const Box near = box_of(region.outer).grown(line + 1);
      const Regions rests_on = geometry::trimmed(under, near);
      if (rests_on.size() == 1 && rests_on.front() == region) continue;
      Regions standing = geometry::subtract({region}, grown(rests_on, line));
      for (std::size_t i = run.to; i-- > run.from && !standing.empty();) {  // the highest is what it stands on
        const Um z = object.layers[i]->z, free = bottom - z - gap;
        if (free < 0) continue;
        const Regions here = geometry::intersect(standing, room.part(z - 1, z, near));
        if (here.empty()) continue;
        standing = geometry::subtract(standing, here);
        const double mm2 = area_mm2(here);
        Regions apart;
        if (free > 1 && !s.support_synchronize_layers)
          apart = mm2 > all_of_it * area_mm2(region) ? here : without_thin(here, line);
        out.push_back({std::move(apart), layer.height + free, mm2, {}, 0});
        if (!s.support_bottom_enable) stand_on_feet(room, region, kind, layers.subspan(2), here, out.back());
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
    return k == 0 ? std::vector<Landing>{} : landings_of(room, std::span(layers).subspan(k - 1));
  });
  std::vector<SupportLayer> lowest;
  double on_part_mm2 = 0;
  for (std::size_t k = 1; k < layers.size(); ++k)
    for (const auto& landing : landings[k]) {
      on_part_mm2 += landing.mm2;
      if (!landing.feet.empty())
        for (std::size_t l = 0; l < landing.feet_levels; ++l) append(layers[k + l].feet, landing.feet);
      if (landing.area.empty()) continue;
      auto own = taken(layers[k], landing.area);
      own.height = landing.height, own.feet = landing.feet;
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
