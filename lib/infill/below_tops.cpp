// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "infill/shells.h"

#include <cmath>
#include <numbers>

namespace weft::infill {
namespace {

// Borders between kinds of fill follow a grid of 0.1 mm and step by its cells.
constexpr Um jitter = 50;  // a shell's strips narrower than twice that are such steps
constexpr Um sliver = 10;  // what stands out less than twice that beyond what carries itself hangs nowhere
constexpr Um rim = 25;     // so far beyond it goes on, and is wanted as well

Regions sparse_of(const LayerAreas& layer) {
  Regions out;
  for (const PartAreas& part : layer) out.insert(out.end(), part.sparse.begin(), part.sparse.end());
  return out;
}

/// What of a layer's shell stands beyond the shell below, where that is further than carries itself.
Regions hanging(const Regions& shell, const Regions& below, double carries_um) {
  constexpr double everything_um = 1e7;  // of 90°: no bed is as wide
  if (carries_um > everything_um) return {};
  const auto by = static_cast<Um>(std::lround(carries_um));
  const Regions furthest = geometry::opening(
      geometry::subtract(shell, geometry::offset(below, {.by = by, .corner = geometry::Corner::bevel})), sliver,
      geometry::Corner::bevel);
  if (furthest.empty()) return {};
  return geometry::subtract(geometry::offset(furthest, {.by = by + rim, .corner = geometry::Corner::bevel}), below);
}

}  // namespace

void keep_below_tops(const InfillSettings& infill, const ShellObject& object, std::vector<LayerAreas>& areas) {
  if (!infill.infill_support_enabled || infill.infill_sparse_density <= 0 || areas.empty()) return;
  const double lean = std::tan(infill.infill_support_angle * std::numbers::pi / 180);
  const Um line = length_or(infill.infill_line_width, object.nozzle, object.nozzle);
  Regions shell, wanted;  // of the layer above: all but its sparse inside, and what of that must be filled
  for (std::size_t i = areas.size(); i-- > 0;) {
    stop_if_asked();
    const Regions sparse = sparse_of(areas[i]);
    Regions own =
        geometry::opening(geometry::subtract(*object.layers[i].outline, sparse), jitter, geometry::Corner::bevel);
    if (i + 1 < areas.size()) {
      wanted = geometry::unite(wanted, hanging(shell, own, lean * object.layers[i + 1].height));
      wanted = geometry::intersect(wanted, sparse);
    }
    const Regions filled = geometry::opening(wanted, line / 2, geometry::Corner::bevel);
    for (PartAreas& part : areas[i])
      if (!part.sparse.empty()) part.sparse = geometry::intersect(part.sparse, filled);
    shell = std::move(own);
  }
}

}  // namespace weft::infill
