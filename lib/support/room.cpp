// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/room.h"

#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "support/lengths.h"
#include "tasks/parallel.h"

#include <algorithm>

namespace weft::support {

Um beside(const SupportSettings& settings, const Object& object) {
  return settings.support_xy_distance.of(object.outer_line);
}

LayerRun layers_between(const Object& object, Um low, Um high) {
  const auto& layers = object.layers;
  const auto first = std::partition_point(layers.begin(), layers.end(), [&](const auto* l) { return l->z <= low; });
  const auto last = std::partition_point(first, layers.end(), [&](const auto* l) { return l->z - l->height < high; });
  return {static_cast<std::size_t>(first - layers.begin()), static_cast<std::size_t>(last - layers.begin())};
}

Regions outlines_between(const Object& object, Um low, Um high) {
  const auto run = layers_between(object, low, high);
  Regions out;
  for (std::size_t i = run.from; i < run.to; ++i) append(out, object.layers[i]->regions);
  return run.to - run.from > 1 ? geometry::unite(out) : out;
}

Regions blocked_between(const Object& object, Um low, Um high) {
  Regions out;
  const auto run = layers_between(object, low, high);
  for (std::size_t i = run.from; i < std::min(run.to, object.blocked.size()); ++i) append(out, object.blocked[i]);
  return out.empty() ? out : geometry::unite(out);
}

namespace {

/// What of a level waits for the next step over a slope: what the part has left since the step began, no wider than a
/// step may be.
Regions stair(const SupportSettings& settings, const Object& object, const Stack::Level& level) {
  const Um step = settings.support_bottom_stair_step_height, width = settings.support_bottom_stair_step_width;
  if (step <= 0 || width <= 0 || level.bottom() <= object.floor) return {};
  const Um begun = object.floor + (level.bottom() - object.floor) / step * step, gap = bottom_gap(settings);
  if (begun == level.bottom()) return {};
  const Regions now = outlines_between(object, level.bottom() - gap - 1, level.bottom() - gap);
  if (now.empty()) return {};
  return geometry::intersect(outlines_between(object, begun - gap, level.bottom() - gap), grown(now, width));
}

}  // namespace

std::vector<KeepOut> keep_outs(const SupportSettings& settings, const Object& object, const Stack& stack) {
  const Um xy = beside(settings, object);
  const Um close = settings.support_xy_overrides_z ? xy : std::min(xy, settings.support_xy_distance_overhang);
  return tasks::parallel_map(stack.levels.size(), [&](std::size_t k) {
    const auto& level = stack.levels[k];
    KeepOut out;
    const Regions part = outlines_between(object, level.bottom(), level.z);
    const auto kept_off = [&](Um by) {  // to 5 µm: a distance that is set is kept at corners too
      return by == 0 ? part : geometry::offset(part, {.by = by, .corner = geometry::Corner::round});
    };
    out.near = kept_off(xy);
    out.touch = close == xy ? out.near : kept_off(close);
    const Um above = top_gap(settings), below = bottom_gap(settings);
    if (above > 0) out.over = outlines_between(object, level.z, level.z + above);
    if (below > 0 && level.bottom() > object.floor)
      append(out.over, outlines_between(object, level.bottom() - below, level.bottom()));
    append(out.over, stair(settings, object, level));
    if (settings.support_blockers_avoided) append(out.over, blocked_between(object, level.bottom(), level.z));
    return out;
  });
}

std::vector<Regions> shadows(const SupportSettings& settings, const Object& object, const Stack& stack) {
  std::vector<Regions> out(stack.levels.size());
  const Um xy = beside(settings, object);
  Regions all;
  std::size_t layer = 0;
  for (std::size_t k = 0; k < stack.levels.size(); ++k) {
    Regions more;
    while (layer < object.layers.size() && object.layers[layer]->z - object.layers[layer]->height < stack.levels[k].z)
      append(more, object.layers[layer++]->regions);
    if (!more.empty() && !geometry::subtract(more, all).empty()) {
      append(all, grown(more, xy));
      all = geometry::unite(all);
    }
    out[k] = all;
  }
  return out;
}

}  // namespace weft::support
