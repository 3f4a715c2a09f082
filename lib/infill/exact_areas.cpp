// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/exact_areas.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/spatial_index.h"
#include "infill/few_points.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <utility>

namespace weft::infill {
namespace {

constexpr double as_straight = 0.55;  // cells on each side of a line that the middles of its cells' sides lie in
constexpr int beyond_cells = 2;  // how far an area is drawn over the wall beside it before it is cut to the wall's edge

/// One kind of fill while exact areas are cut out.
struct Kind {
  const Mask* cells;
  Regions* areas;                  ///< of the part in work
  const Regions* exact = nullptr;  ///< its outlines, where they are known
};

/// Through the middles of the cells' sides: what slants is straight there, not a staircase.
Ring through_middles(const Ring& outline, Um cell) {
  Ring out;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point a = outline[i], b = outline[(i + 1) % outline.size()];
    const int sides = std::max(std::abs(b.x - a.x), std::abs(b.y - a.y)) / cell;
    const Point step{b.x == a.x ? 0 : (b.x > a.x ? cell : -cell), b.y == a.y ? 0 : (b.y > a.y ? cell : -cell)};
    for (int k = 0; k < sides; ++k) out.push_back({a.x + k * step.x + step.x / 2, a.y + k * step.y + step.y / 2});
  }
  return out;
}

/// Outlines of an area that may run over the wall beside it, to be cut with what is inside of the walls.
Regions rough_outline(const Mask& cells, const Mask& inside) {
  const Mask drawn = cells | (cells.grown(beyond_cells) - inside);
  Regions rings;  // holes among them: the Booleans take rings as they are wound
  for (const Ring& ring : drawn.outlines())
    rings.push_back({few_points(through_middles(ring, cells.grid().cell), true, as_straight * cells.grid().cell), {}});
  return rings;
}

/// Cuts regions of one part that hold several kinds. The last kind present gets the rest, so nothing is lost.
void cut_apart(const Regions& mixed, std::span<const Kind> kinds, const Mask& inside) {
  const Box box = weft::box_of(mixed);
  std::vector<const Kind*> present;
  for (const Kind& kind : kinds)
    if (kind.exact != nullptr || kind.cells->meets(inside, box)) present.push_back(&kind);
  Regions rest = mixed;
  for (std::size_t k = 0; k < present.size(); ++k) {
    Regions& areas = *present[k]->areas;
    if (k + 1 == present.size()) {
      areas.insert(areas.end(), rest.begin(), rest.end());
      break;
    }
    auto cut = geometry::cut(
        rest, present[k]->exact != nullptr ? *present[k]->exact : rough_outline(*present[k]->cells, inside));
    rest = std::move(cut.outside);
    std::move(cut.inside.begin(), cut.inside.end(), std::back_inserter(areas));
  }
}

/// Patches of sparse infill that bridges and belts leave too small to be worth it become solid.
void drop_small_sparse(PartAreas& areas, const SmallPatches& which) {
  const auto small = std::stable_partition(areas.sparse.begin(), areas.sparse.end(),
                                           [&](const Region& patch) { return !which.closes(patch); });
  if (small == areas.sparse.end()) return;
  Regions patches(small, areas.sparse.end());
  areas.sparse.erase(small, areas.sparse.end());
  areas.solid = areas.solid.empty() ? std::move(patches) : geometry::unite(areas.solid, patches);
}

/// The part (region of the outline) that each region of the inside lies in.
std::vector<std::uint32_t> parts_of(const Regions& inside, const Regions& outline) {
  std::vector<std::uint32_t> parts(inside.size(), 0);
  if (outline.size() < 2 || inside.empty()) return parts;
  const geometry::SegmentIndex index(outline);
  for (std::size_t i = 0; i < inside.size(); ++i) {
    stop_if_asked();
    parts[i] = static_cast<std::uint32_t>(index.region_at(inside[i].outer.front()).value_or(0));
  }
  return parts;
}

}  // namespace

LayerAreas exact_areas(const ShellLayer& layer, const Kinds& kinds, const SmallPatches* small) {
  const std::vector<std::uint32_t> parts = parts_of(*layer.inside, *layer.outline);
  std::vector<std::size_t> order(parts.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return parts[a] < parts[b]; });

  Regions belted;
  Mask fuzzy = kinds.inside;  // where outlines are those of cells
  if (kinds.belts) {
    for (const Belts::Of& of : kinds.belts->found) belted.insert(belted.end(), of.area.begin(), of.area.end());
    fuzzy -= kinds.belts->area;
  }
  LayerAreas result;
  for (std::size_t i = 0; i < order.size();) {
    PartAreas& areas = result.emplace_back();
    areas.part = parts[order[i]];
    for (const Hanging& each : kinds.hanging) areas.bridges.push_back({{}, each.angle_rad, each.ledge});
    std::vector<Kind> all;
    if (kinds.belts) all.push_back({&kinds.belts->area, &areas.belted, &belted});
    for (std::size_t b = 0; b < kinds.hanging.size(); ++b)
      all.push_back({&kinds.hanging[b].area, &areas.bridges[b].regions});
    all.push_back({&kinds.top, &areas.top});
    if (kinds.sparse) all.push_back({&*kinds.sparse, &areas.sparse});
    all.push_back({&kinds.solid, &areas.solid});
    Regions mixed;
    for (; i < order.size() && parts[order[i]] == areas.part; ++i) {
      stop_if_asked();
      const Region& region = (*layer.inside)[order[i]];
      if (kinds.belts)
        for (const Belts::Of& of : kinds.belts->found)
          if (of.region == order[i]) areas.belts.insert(areas.belts.end(), of.lines.begin(), of.lines.end());
      std::vector<const Kind*> present;
      if (order.size() == 1) {
        for (const Kind& kind : all)
          if (kind.cells->any()) present.push_back(&kind);
      } else {
        const Grid& grid = kinds.inside.grid();
        const Mask cells(grid.window(weft::box_of(region.outer), grid.cell), {&region, 1});
        for (const Kind& kind : all)
          if (kind.cells->meets(cells)) present.push_back(&kind);
      }
      if (present.size() > 1)
        mixed.push_back(region);
      else
        (present.empty() ? areas.solid : *present.front()->areas).push_back(region);
    }
    if (!mixed.empty()) cut_apart(mixed, all, fuzzy);
    std::erase_if(areas.bridges, [](const BridgeArea& b) { return b.regions.empty(); });
    if (small != nullptr) drop_small_sparse(areas, *small);
  }
  return result;
}

}  // namespace weft::infill
