// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/hanging.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/simplify.h"
#include "infill/bridges.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace weft::infill {
namespace {

// Lines: what is narrower hangs on what is beside it, whichever way its lines run; over sparse infill, where nobody
// sees them and the infill's lines are below, on less.
constexpr double narrowest_ledge = 3, narrowest_over_infill = 2;

Regions regions_of(const Mask& cells) {
  std::vector<Ring> rings = cells.outlines();
  for (Ring& ring : rings) ring = geometry::simplified(ring, cells.grid().cell);
  return geometry::regions_from_rings(rings);
}

/// All cells of one region of `regions_of(cells)`, whose edges pass through the middles of some.
Mask cells_of(const Region& region, const Mask& cells) {
  return Mask(cells.grid(), {&region, 1}).grown(1) & cells;
}

/// A bridge takes what it covers from the other kinds. Strands that run the same way are of one bridge.
void add_bridge(Kinds& kinds, Hanging bridge) {
  for (const Hanging& other : kinds.hanging) bridge.area -= other.area;
  if (!bridge.area.any()) return;
  kinds.solid -= bridge.area, kinds.top -= bridge.area;
  if (kinds.sparse) *kinds.sparse -= bridge.area;
  const auto same = std::find_if(kinds.hanging.begin(), kinds.hanging.end(), [&](const Hanging& other) {
    return other.ledge == bridge.ledge && other.angle_rad == bridge.angle_rad;
  });
  if (same == kinds.hanging.end())
    kinds.hanging.push_back(std::move(bridge));
  else
    same->area |= bridge.area;
}

/// A bottom over air, and how lines over it run.
struct Gap {
  Region outline;
  Mask cells;
  Held held;
};

/// Gaps one bridge may span run the way that is best for all of them.
void turn_alike(std::vector<Gap>& gaps, const Mask& place, const Mask& below, Um nozzle) {
  constexpr double easy_span = 12.5;  // nozzles, 5 mm of 0.4: strands that hang no further are as good in any direction
  std::vector<Gap*> here;
  Regions outlines;
  double worst_um = easy_span * nozzle;
  for (Gap& gap : gaps)
    if (gap.cells.meets(place)) {
      here.push_back(&gap), outlines.push_back(gap.outline);
      worst_um = std::max(worst_um, gap.held.span_um);
    }
  if (here.size() < 2) return;
  const std::optional<Held> joint = held_over(outlines, below);
  if (!joint || joint->ledge || joint->span_um > worst_um) return;
  for (Gap* gap : here) gap->held = *joint;
}

}  // namespace

void find_bridges(const ShellSettings& settings, const HangingLayer& layer, const Mask& air, const Mask& below,
                  Kinds& kinds) {
  const Grid& grid = kinds.inside.grid();
  const Mask hanging = air.opened(cells(layer.nozzle / 2.0, grid));
  if (!hanging.any()) return;
  const int anchor = cells(settings.bridge_anchor, grid);
  std::vector<Gap> bridges, ledges;
  Mask bridged(grid);
  for (Region& outline : regions_of(hanging)) {
    stop_if_asked();
    const std::optional<Held> held = held_over({outline}, below);
    if (!held) continue;
    Mask own = cells_of(outline, hanging);
    if (!held->ledge) {
      bridged |= own;
      bridges.push_back({std::move(outline), std::move(own), *held});
    } else if (!settings.skin_angle && own.opened(cells(narrowest_ledge / 2 * layer.line, grid)).any()) {
      ledges.push_back({std::move(outline), std::move(own), *held});
    }
  }
  if (settings.bridge_angle)
    for (Gap& gap : bridges) gap.held.angle_rad = *settings.bridge_angle * std::numbers::pi / 180;
  else if (bridges.size() > 1)
    for (const Region& place : regions_of(bridged.grown(anchor) & kinds.inside))
      turn_alike(bridges, Mask(grid, {&place, 1}), below, layer.nozzle);
  for (const auto* gaps : {&bridges, &ledges})
    for (const Gap& gap : *gaps)
      add_bridge(kinds, {gap.cells.grown(anchor) & kinds.inside, gap.held.angle_rad, gap.held.ledge});
}

void find_internal_bridges(const ShellSettings& settings, const HangingLayer& layer, const SparseStyle& below,
                           const std::optional<Mask>& sparse, Kinds& kinds) {
  if (!sparse) return;
  constexpr double sliver = 1.5;  // lines
  const Grid& grid = kinds.inside.grid();
  const Mask hanging = (kinds.solid & *sparse).opened(cells(narrowest_over_infill / 2 * layer.line, grid));
  if (!hanging.any()) return;
  const Mask open = kinds.sparse ? *kinds.sparse & *sparse : Mask(grid);
  for (const Region& outline : regions_of(hanging)) {
    stop_if_asked();
    std::optional<double> angle = internal_bridge_angle_rad(outline, {hanging, open}, below, layer.nozzle);
    if (!angle) continue;
    if (settings.bridge_angle) angle = *settings.bridge_angle * std::numbers::pi / 180;
    Mask bridge = Mask(grid, {&outline, 1}).grown(cells(settings.bridge_anchor, grid)) & kinds.solid;
    // Strips that its anchors leave of the solid beside it would be slivers along their ends.
    const Mask rest = kinds.solid - bridge;
    if (rest.any())
      bridge |=
          (rest - rest.opened(cells(sliver / 2 * layer.line, grid))) & bridge.grown(cells(sliver * layer.line, grid));
    add_bridge(kinds, {std::move(bridge), *angle});
  }
}

}  // namespace weft::infill
