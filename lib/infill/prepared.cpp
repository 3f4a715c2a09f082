// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/prepared.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "infill/lightning.h"
#include "infill/mask.h"
#include "infill/scan.h"
#include "infill/sparse.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace weft::infill {
namespace {

Regions sparse_of(const LayerAreas& layer) {
  Regions out;
  for (const PartAreas& part : layer) {
    out.insert(out.end(), part.sparse.begin(), part.sparse.end());
    out.insert(out.end(), part.combined.begin(), part.combined.end());
  }
  return out;
}

/// The height of the layers that most of the object is made of.
Um height_of_most(const ShellObject& object) {
  std::map<Um, Um> of_height;
  for (const ShellLayer& layer : object.layers) of_height[layer.height] += layer.height;
  return std::max_element(of_height.begin(), of_height.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

/// The surface as the infill meets it: walls, tops and bottoms; or tops alone.
CubeTree cubes_of(const InfillSettings& infill, const ShellObject& object, const std::vector<LayerAreas>& areas,
                  const Frame& frame, double spacing, bool tops_only) {
  const double high = object.layers.back().z;
  const double radius = std::hypot(std::hypot(object.box.size().x, object.box.size().y) / 2 +
                                       std::hypot(infill.infill_offset_x, infill.infill_offset_y),
                                   high);
  CubeTree cubes(spacing, radius);
  const double apart = cubes.least_edge() / 4;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    stop_if_asked();
    const Regions here = sparse_of(areas[i]);
    if (here.empty()) continue;
    const double z = object.layers[i].z;
    const auto add = [&](double x, double y) {
      const Turned t = frame.into({rounded(x), rounded(y)});
      cubes.add(t.x, t.y, z);
    };
    if (!tops_only)
      for (const Ring& ring : geometry::rings_of(here))
        for (std::size_t k = 0; k < ring.size(); ++k) {
          const Point a = ring[k], b = ring[(k + 1) % ring.size()];
          const int pieces = static_cast<int>(std::ceil(distance(a, b) / apart));
          for (int t = 0; t < pieces; ++t)
            add(std::lerp(a.x, b.x, static_cast<double>(t) / pieces),
                std::lerp(a.y, b.y, static_cast<double>(t) / pieces));
        }
    const auto add_bare = [&](std::size_t beside) {
      const Regions bare = beside < areas.size() ? geometry::subtract(here, sparse_of(areas[beside])) : here;
      if (bare.empty()) return;
      const Box box = box_of(bare);
      const Um cell = std::max(1, rounded(apart));
      const Grid grid{box.min, cell, box.size().x / cell + 1, box.size().y / cell + 1};
      const Mask mask(grid, bare);
      for (int r = 0; r < grid.rows; ++r)
        for (int c = 0; c < grid.columns; ++c)
          if (mask.at(c, r)) add(grid.origin.x + (c + 0.5) * cell, grid.origin.y + (r + 0.5) * cell);
    };
    add_bare(i + 1);
    if (!tops_only) add_bare(i == 0 ? areas.size() : i - 1);
  }
  cubes.balance();
  return cubes;
}

}  // namespace

Prepared prepare(const InfillSettings& infill, const ShellObject& object, const std::vector<LayerAreas>& areas,
                 Point origin, Point on_bed) {
  Prepared out;
  if (object.layers.empty() || infill.infill_sparse_density <= 0) return out;
  const SparseStyle style = sparse_style(
      infill, {.height = height_of_most(object), .nozzle = object.nozzle, .turned_rad = object.turned_rad});
  out.band = style.band;
  const double spacing = style.band / std::max(style.density, 0.01);
  const InfillPattern pattern = infill.infill_pattern;
  const Point anchored = origin + Point{infill.infill_offset_x, infill.infill_offset_y};
  if (pattern == InfillPattern::cubicsubdiv || pattern == InfillPattern::support_cubic) {
    out.cubes_angle_rad = style.angle_rad;
    out.cubes = cubes_of(infill, object, areas, Frame(style.angle_rad, anchored), spacing,
                         pattern == InfillPattern::support_cubic);
  }
  if (pattern == InfillPattern::lightning) {
    std::vector<LightningLayer> layers;
    for (std::size_t i = 0; i < areas.size(); ++i) layers.push_back({object.layers[i].height, sparse_of(areas[i])});
    const auto tangent = [](double degrees) { return std::tan(degrees * std::numbers::pi / 180); };
    const double usual = infill.lightning_infill_support_angle;
    LightningLean lean{tangent(infill.lightning_infill_prune_angle.value_or(usual)),
                       tangent(infill.lightning_infill_straightening_angle.value_or(usual))};
    if (infill.lightning_infill_overhang_angle) lean.beside_wall = tangent(*infill.lightning_infill_overhang_angle);
    out.branches = lightning(layers, spacing, lean, anchored);
  }
  out.direction = read_direction(infill, object, on_bed);
  if (Density::varies(infill)) out.density.emplace(infill, object, areas, on_bed);
  return out;
}

}  // namespace weft::infill
