// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/hanging.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/simplify.h"
#include "infill/bridges.h"
#include "infill/scan.h"
#include "infill/small_patches.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace weft::infill {
namespace {

// Lines: what is narrower hangs on what is beside it, whichever way its lines run; over sparse infill, where nobody
// sees them and the infill's lines are below, on less.
constexpr double narrowest_ledge = 3, narrow_over_infill = 2, narrowest_over_infill = 1;

Regions regions_of(const Mask& cells) {
  std::vector<Ring> rings = cells.outlines();
  for (Ring& ring : rings) ring = geometry::simplified(ring, cells.grid().cell);
  return geometry::regions_from_rings(rings);
}

/// All cells of one region of `regions_of(cells)`, whose edges pass through the middles of some.
Mask cells_of(const Region& region, const Mask& cells) {
  return Mask(cells.grid(), {&region, 1}).grown(1) & cells;
}

/// What strands over an area cover with their anchors. Those of a narrow area are anchored where they end: what lies
/// beside it needs none, and would be most of the bridge.
Mask anchored(const Region& area, double angle_rad, Um anchor, double line, const Grid& grid) {
  Mask all = Mask(grid, {&area, 1}).grown(cells(anchor, grid));
  const Frame frame(angle_rad, area.outer.front());
  const Outline outline(area, frame);
  if (outline.greatest_y() - outline.least_y() > 2.0 * anchor) return all;
  double left = 0, right = 0;
  for (const Turned& t : outline.points()) left = std::min(left, t.x), right = std::max(right, t.x);
  const double low = outline.least_y() - line / 2, high = outline.greatest_y() + line / 2;
  left -= 2.0 * anchor, right += 2.0 * anchor;
  const Region along{
      {frame.back({left, low}), frame.back({right, low}), frame.back({right, high}), frame.back({left, high})}, {}};
  return all &= Mask(grid, {&along, 1});
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
  const Mask wide = hanging.opened(cells(narrow_over_infill / 2 * layer.line, grid));
  const Mask open = kinds.sparse ? *kinds.sparse & *sparse : Mask(grid);
  const OverSparse around{hanging, open, below};
  for (const Region& outline : regions_of(hanging)) {
    stop_if_asked();
    const bool narrow = !Mask(grid, {&outline, 1}).meets(wide);
    std::optional<double> angle = internal_bridge_angle_rad(outline, around, layer.nozzle, narrow);
    if (!angle) continue;
    if (settings.bridge_angle) angle = *settings.bridge_angle * std::numbers::pi / 180;
    Mask bridge = anchored(outline, *angle, settings.bridge_anchor, layer.line, grid) & kinds.solid;
    if (const Regions beyond = up_to_holds(outline, *angle, around, layer.line); !beyond.empty())
      bridge |= Mask(grid, beyond) & kinds.inside;
    // Strips that its anchors leave of the solid beside it would be slivers along their ends.
    const Mask rest = kinds.solid - bridge;
    if (rest.any())
      bridge |=
          (rest - rest.opened(cells(sliver / 2 * layer.line, grid))) & bridge.grown(cells(sliver * layer.line, grid));
    add_bridge(kinds, {std::move(bridge), *angle});
  }
  const SmallPatches small(settings.infill_solid_below_area, sparse);
  if (kinds.sparse && below.density > 0)
    for (Hanging& bridge : kinds.hanging)
      if (bridge.area.meets(hanging)) small.give_to(bridge.area, *kinds.sparse);
}

}  // namespace weft::infill
