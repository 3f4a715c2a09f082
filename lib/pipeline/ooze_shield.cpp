// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/ooze_shield.h"

#include "core/convex_hull.h"
#include "core/error.h"
#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "model/flow.h"

#include <algorithm>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

/// One more than the last layer that begins or goes on with another tool.
std::size_t end_of_changes(const Passes& passes) {
  std::size_t out = 0;
  for (const auto& pass : passes.passes)
    if (pass.changes && pass.from) out = pass.layer + 1;
  return out;
}

Um width_of(const Settings& plate, Um height) {
  return flow::automatic_width(plate.machine.nozzle_diameter, height);
}

}  // namespace

Regions ooze_shield(const Settings& plate, std::span<const travel::LayerInput> layers, const Passes& passes) {
  if (!plate.tools.ooze_shield_enabled || end_of_changes(passes) == 0) return {};
  std::vector<Point> corners;
  for (const auto& layer : layers)
    for (const auto& object : layer.objects)
      for (const auto& region : object.outline) corners.insert(corners.end(), region.outer.begin(), region.outer.end());
  if (corners.empty()) return {};
  const Ring hull = convex_hull(std::move(corners));
  if (hull.size() < 3) return {};
  const Um out_by = plate.tools.ooze_shield_dist + width_of(plate, plate.layers.layer_height);
  auto out = geometry::offset(Regions{{hull, {}}}, {.by = out_by, .corner = geometry::Corner::round});
  if (!geometry::subtract(out, Regions{{print_surface(plate.machine), {}}}).empty())
    throw Error{Error::Kind::audit,
                fmt::format("ooze_shield_dist: the shield, {:.1f} × {:.1f} mm, leaves the print surface",
                            to_mm(box_of(out.front().outer).size().x), to_mm(box_of(out.front().outer).size().y)),
                {},
                "lower it, move the models, or ooze_shield_enabled = false"};
  return out;
}

void add_ooze_shield(const Settings& plate, const Regions& shield, const Passes& passes,
                     std::span<travel::LayerInput> layers) {
  if (shield.empty()) return;
  const std::size_t end = std::min(end_of_changes(passes), layers.size());
  const bool on_brim =
      plate.adhesion.adhesion_type == AdhesionType::brim && plate.adhesion.brim_width > plate.tools.ooze_shield_dist;
  for (std::size_t i = 0; i < end; ++i) {
    if (on_brim && layers[i].time.first()) continue;
    const Um width = width_of(plate, layers[i].height);
    for (const auto& region : geometry::offset(shield, {.by = -width / 2, .corner = geometry::Corner::round})) {
      Bead bead;
      for (const Point p : region.outer) bead.path.push_back({p, flow::band(width, layers[i].height), 1.F});
      bead.role = Role::skirt;
      bead.closed = true;
      bead.scope = layers[i].scope;
      layers[i].adhesion.insert(layers[i].adhesion.begin(), std::move(bead));
    }
  }
}

}  // namespace weft::pipeline
