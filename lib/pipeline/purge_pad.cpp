// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/purge_pad.h"

#include "core/convex_hull.h"
#include "core/error.h"
#include "geometry/boolean.h"
#include "pipeline/place_tower.h"
#include "pipeline/room_around.h"
#include "settings/head_profile.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

/// Where the pad may not be: boxes of what lies on the bed, and of where the nozzle, at that height, has a slab of the
/// head in what is printed by then.
/// @param printed how many layers
std::vector<Box> in_the_way(const Settings& plate, const std::vector<HeadSlab>& head,
                            std::span<const travel::LayerInput> layers, std::size_t printed, Um z) {
  const Um beside = beside_of(plate) + beside_tower;
  std::vector<Box> out;
  for (std::size_t i = 0; i < layers.size(); ++i)
    for (const auto& object : layers[i].objects)
      for (const auto& region : object.outline) {
        const auto& layer = layers[i];
        const Box box = box_of(region.outer);
        if (layer.time.first()) out.push_back(box.grown(beside));
        for (const auto& slab : head) {
          if (i >= printed || layer.z <= z + slab.from) continue;
          const Box own = box_of(slab.outline);
          const Box away{box.min - own.max, box.max - own.min};
          if (std::none_of(out.begin(), out.end(),
                           [&](const Box& known) { return known.contains(away.min) && known.contains(away.max); }))
            out.push_back(away);
        }
      }
  return out;
}

/// @throws Error{audit} where the head, with the nozzle over the pad, is where something stands by then
void check_head(const std::vector<HeadSlab>& head, const Ring& pad, std::span<const travel::LayerInput> printed, Um z) {
  for (const auto& slab : head) {
    std::vector<Point> corners;
    for (const Point a : pad)
      for (const Point b : slab.outline) corners.push_back(a + b);
    const Ring swept = convex_hull(std::move(corners));
    const Box box = box_of(swept);
    for (const auto& layer : printed) {
      if (layer.z <= z + slab.from) continue;
      for (const auto& object : layer.objects)
        for (const auto& region : object.outline)
          if (box_of(region.outer).overlaps(box) && !geometry::intersect({region}, {{swept, {}}}).empty())
            throw Error{Error::Kind::audit,
                        fmt::format("prime_tower_position_x: when the nozzle is over the tower, the head hits what is "
                                    "printed at z {:.2f}",
                                    to_mm(layer.z)),
                        {},
                        "auto puts it where the head passes"};
    }
  }
}

}  // namespace

bool one_at_a_time(std::span<const travel::LayerInput> layers) {
  return std::any_of(layers.begin(), layers.end(), [](const auto& layer) { return layer.time.comes_down; });
}

void lay_pad(const Settings& plate, const std::vector<Settings>& tools, std::span<const travel::LayerInput> layers,
             Passes& passes) {
  tools::TowerLayer pad{layers.front().z, layers.front().height, {}};
  std::size_t last = 0;
  for (std::size_t p = 0; p < passes.passes.size(); ++p) {
    const auto& pass = passes.passes[p];
    const auto before = pad.strips.size();
    add_strips(tools, pass, p, pad);
    if (pad.strips.size() == before) continue;
    if (layers[pass.layer].z != pad.z)
      throw Error{Error::Kind::settings,
                  fmt::format("one_at_a_time: a tool changes at z {:.2f}, and what is purged lies on the bed",
                              to_mm(layers[pass.layer].z)),
                  "print_sequence", "print_sequence = all_at_once, or prime_tower_enable = false"};
    if (before == 0) pad.wall_pass = p;
    last = pass.layer;
  }
  if (pad.strips.empty()) return;
  passes.tower.push_back(std::move(pad));
  passes.section_of.push_back(last);
  passes.pad = true;
  passes.size = tools::tower_size(plate.tools, passes.tower, least_nozzle(tools));
  const auto head = head_of(plate.plate, plate.machine);
  const Um z = passes.tower.front().z;
  place_tower(plate, in_the_way(plate, head, layers, last, z), passes);
  check_head(head, tools::tower_outline(plate.tools, passes.size, passes.corner), layers.first(last), z);
}

}  // namespace weft::pipeline
