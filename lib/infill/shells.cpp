// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/shells.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/simplify.h"
#include "geometry/spatial_index.h"
#include "infill/belts.h"
#include "infill/bridges.h"
#include "infill/few_points.h"
#include "infill/mask.h"
#include "model/flow.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <utility>

namespace weft::infill {
namespace {

using namespace weft::literals;

constexpr Um finest_cell = 0.1_mm;
constexpr double most_cells = 2.3e6;  // of the grid over an object: 150 × 150 mm of the finest cells
constexpr int margin_cells = 4;
constexpr double as_straight = 0.55;  // cells on each side of a line that the middles of its cells' sides lie in
constexpr int beyond_cells = 2;  // how far an area is drawn over the wall beside it before it is cut to the wall's edge

/// Layers [from, to).
struct LayerRange {
  std::size_t from, to;
};

/// The masks that a run of layers needs, made once: insides of all layers within reach, outlines of the run, of three
/// layers below and one above.
class Window {
 public:
  Window(const ShellObject& object, LayerRange run, LayerRange within_reach)
      : insides_from_(within_reach.from), outlines_from_(run.from - std::min<std::size_t>(run.from, 3)) {
    const Grid whole = Grid::over(object.box, finest_cell, 0, most_cells);
    Box box;
    for (std::size_t i = within_reach.from; i < within_reach.to; ++i)
      box.add(weft::box_of(*object.layers[i].outline)), box.add(weft::box_of(*object.layers[i].inside));
    grid_ = whole.window(box, margin_cells * whole.cell);
    for (std::size_t i = insides_from_; i < within_reach.to; ++i)
      insides_.emplace_back(grid_, *object.layers[i].inside);
    for (std::size_t i = outlines_from_; i < std::min(run.to + 1, object.layers.size()); ++i)
      outlines_.emplace_back(grid_, *object.layers[i].outline);
  }
  const Grid& grid() const { return grid_; }
  const Mask& outline(std::size_t layer) const { return outlines_[layer - outlines_from_]; }
  const Mask& inside(std::size_t layer) const { return insides_[layer - insides_from_]; }

 private:
  std::size_t insides_from_, outlines_from_;
  Grid grid_;
  std::vector<Mask> outlines_, insides_;
};

/// How many layers above (or below) a layer decide whether it is solid: [low, high) with the layer itself; beyond the
/// object's ends means that air is within the skin.
struct Reach {
  std::size_t below = 0, above = 0;
};

Reach reach_of(const ShellSettings& settings, std::span<const ShellLayer> layers, std::size_t index) {
  Reach reach{static_cast<std::size_t>(settings.bottom_layers), static_cast<std::size_t>(settings.top_layers)};
  const ShellLayer& here = layers[index];
  constexpr Um rounding = 1_um;
  // the skin under a top surface at layer j reaches down to this layer's top when z_j − z < thickness
  for (std::size_t j = index + reach.above;
       j < layers.size() && layers[j].z - here.z + rounding < settings.top_thickness; ++j)
    reach.above = j - index + 1;
  const auto bottom_of = [&](std::size_t j) { return layers[j].z - layers[j].height; };
  while (reach.below <= index &&
         bottom_of(index) - bottom_of(index - reach.below) + rounding < settings.bottom_thickness)
    ++reach.below;
  return reach;
}

/// What each cell of a layer is filled with. Disjoint, and within `inside`.
struct Kinds {
  const Mask& inside;
  Mask top, solid;
  std::vector<Mask> bridges;
  std::vector<double> bridge_angles;
  std::optional<Mask> sparse;  ///< present when any
  std::optional<Belts> belts;
};

int cells(double um, const Grid& grid) {
  return std::max(1, static_cast<int>(std::lround(um / grid.cell)));
}

Mask solid_cells(const Window& window, std::span<const ShellLayer> layers, std::size_t index, Reach reach) {
  const Mask& inside = window.inside(index);
  if (index + reach.above >= layers.size() && reach.above > 0) return inside;
  if (reach.below > index) return inside;
  std::vector<const Mask*> others;
  for (std::size_t j = index - reach.below; j <= index + reach.above; ++j)
    if (j != index) others.push_back(&window.inside(j));
  Mask core = inside;
  core &= others;
  return inside - core;
}

/// Strips of an area that are narrower than a line and a half.
struct Strips {
  Mask wide;  ///< the rest
  Mask all;
  Mask ends;  ///< of them: those shorter than four lines that lie beside the rest
  Mask dabs;  ///< and those that do not
};
Strips strips_of(const Mask& area, double line) {
  constexpr double short_strip = 4;  // lines, of one line's width
  const Grid& grid = area.grid();
  Strips out{area.opened(cells(0.75 * line, grid)) & area, Mask(grid), Mask(grid), Mask(grid)};
  out.all = area - out.wide;
  if (!out.all.any()) return out;
  Regions ends, dabs;
  for (Region& strip : geometry::regions_from_rings(out.all.outlines())) {
    if (area_mm2(strip) >= short_strip * line * line * 1e-6) continue;
    const Mask own(grid.window(weft::box_of(strip.outer), 2 * grid.cell), {&strip, 1});
    (own.grown(1).meets(out.wide) ? ends : dabs).push_back(std::move(strip));
  }
  if (!ends.empty()) out.ends = Mask(grid, ends);
  if (!dabs.empty()) out.dabs = Mask(grid, dabs);
  return out;
}

/// What of sparse infill is solid because it is narrow. Tips of a wider area stay what they are: a dab of solid there
/// closes nothing, and takes two travels.
Mask closed_strips(const Mask& sparse, double line) {
  Strips strips = strips_of(sparse, line);
  return strips.all -= strips.ends;
}

/// What of a layer is solid, and what is sparse, before it is looked at which way strands run.
struct Split {
  double line = 0;  ///< width of an ordinary one, µm
  Mask solid, seen_above, air_below;
  std::optional<Mask> sparse;  ///< present when any
};

Split split_of(const ShellSettings& settings, const InfillSettings& infill, const ShellObject& object,
               const Window& window, std::size_t index) {
  const ShellLayer& layer = object.layers[index];
  const Grid& grid = window.grid();
  const Mask& inside = window.inside(index);
  const Reach reach = reach_of(settings, object.layers, index);
  const Mask none(grid);
  Split out{static_cast<double>(flow::automatic_width(object.nozzle, layer.height)), inside, none, none, std::nullopt};
  if (reach.above > 0) out.seen_above = index + 1 < object.layers.size() ? inside - window.outline(index + 1) : inside;
  if (reach.below > 0 && index > 0) out.air_below = inside - window.outline(index - 1);
  const bool whole =
      settings.infill_solid_every_layers && index % static_cast<std::size_t>(*settings.infill_solid_every_layers) == 0;
  if (infill.infill_sparse_density >= 100 || whole) return out;
  out.solid = solid_cells(window, object.layers, index, reach).opened(cells(0.3 * out.line, grid));
  if (out.seen_above.any() || out.air_below.any())
    out.solid |= (out.seen_above | out.air_below).grown(cells(out.line, grid)) & inside;
  Mask sparse = inside - out.solid;
  if (layer.open != nullptr) sparse &= Mask(grid, *layer.open);
  if (out.solid.any()) sparse -= closed_strips(sparse, out.line);
  out.solid = inside - sparse;
  if (sparse.any()) out.sparse = std::move(sparse);
  return out;
}

Regions regions_of(const Mask& cells) {
  std::vector<Ring> rings = cells.outlines();
  for (Ring& ring : rings) ring = geometry::simplified(ring, cells.grid().cell);
  return geometry::regions_from_rings(rings);
}

/// A bridge takes what it covers from the other kinds.
void add_bridge(Kinds& kinds, Mask bridge, double angle_rad) {
  for (const Mask& other : kinds.bridges) bridge -= other;
  if (!bridge.any()) return;
  kinds.solid -= bridge, kinds.top -= bridge;
  if (kinds.sparse) *kinds.sparse -= bridge;
  kinds.bridges.push_back(std::move(bridge));
  kinds.bridge_angles.push_back(angle_rad);
}

/// Bottoms over air that hang between supports become bridges. Their ends rest on what is below, also where there
/// would be sparse infill beside the bottom.
void find_bridges(const ShellSettings& settings, Kinds& kinds, const Mask& air, const Mask& below, Um nozzle) {
  const Grid& grid = kinds.inside.grid();
  const Mask gaps = air.opened(cells(nozzle / 2.0, grid));
  if (!gaps.any()) return;
  for (const Region& gap : regions_of(gaps)) {
    stop_if_asked();
    std::optional<double> angle = bridge_angle_rad(gap, below);
    if (!angle) continue;
    if (settings.bridge_angle) angle = *settings.bridge_angle * std::numbers::pi / 180;
    add_bridge(kinds, Mask(grid, {&gap, 1}).grown(cells(settings.bridge_anchor, grid)) & kinds.inside, *angle);
  }
}

/// Solid over sparse infill hangs from line to line of it: strands run across the shortest free spans.
void find_internal_bridges(const ShellSettings& settings, const SparseStyle& below, Kinds& kinds,
                           const std::optional<Mask>& sparse, double line, Um nozzle) {
  if (!sparse) return;
  constexpr double narrowest = 1.5;  // lines: a narrower belt is held from its sides
  const Grid& grid = kinds.inside.grid();
  const Mask hanging = (kinds.solid & *sparse).opened(cells(narrowest / 2 * line, grid));
  if (!hanging.any()) return;
  for (const Region& area : regions_of(hanging)) {
    stop_if_asked();
    std::optional<double> angle = internal_bridge_angle_rad(area, below, nozzle);
    if (!angle) continue;
    if (settings.bridge_angle) angle = *settings.bridge_angle * std::numbers::pi / 180;
    add_bridge(kinds, Mask(grid, {&area, 1}).grown(cells(settings.bridge_anchor, grid)) & kinds.solid, *angle);
  }
}

/// Which patches of a layer's sparse infill are too small to be worth it: solid, too; not those that lie on infill that
/// is none: their lines would hang from line to line of that, an island in sparse infill.
class SmallPatches {
 public:
  /// @param below the sparse infill of the layer below
  SmallPatches(double least_mm2, const std::optional<Mask>& below) : least_mm2_(least_mm2), below_(below) {}

  bool closes(const Region& patch) { return area_mm2(patch) < least_mm2_ && !goes_on_below(patch); }

  /// Closes those among cells.
  void close(Mask& sparse, Mask& solid) {
    Regions small;
    for (Ring& ring : sparse.outlines())
      if (double_area(ring) > 0)
        if (Region patch{std::move(ring), {}}; closes(patch)) small.push_back(std::move(patch));
    if (small.empty()) return;
    const Mask closed = Mask(sparse.grid(), small) & sparse;
    sparse -= closed, solid |= closed;
  }

 private:
  bool goes_on_below(const Region& patch) {
    if (!below_) return false;
    const Grid& grid = below_->grid();
    if (!large_) {
      Regions patches = geometry::regions_from_rings(below_->outlines());
      std::erase_if(patches, [&](const Region& each) { return area_mm2(each) < least_mm2_; });
      large_.emplace(grid, patches);
    }
    return Mask(grid.window(weft::box_of(patch.outer), grid.cell), {&patch, 1}).shrunk(beyond_cells).meets(*large_);
  }

  double least_mm2_;
  const std::optional<Mask>& below_;
  std::optional<Mask> large_;
};

/// Narrow solid beside sparse infill is as wide as its lines; what is too short for one is sparse.
void lay_belts(const Regions& inside, double line, Um band, Kinds& kinds) {
  const Grid& grid = kinds.inside.grid();
  Belts belts = find_belts(inside, kinds.solid, *kinds.sparse, band);
  if (!belts.found.empty()) {
    kinds.solid -= belts.area;
    const Mask left = (kinds.solid - kinds.solid.opened(cells(0.4 * line, grid))) & belts.area.grown(cells(line, grid));
    kinds.solid -= left;
    *kinds.sparse |= left, *kinds.sparse -= belts.area;
  }
  const Mask dabs = strips_of(kinds.solid, line).dabs;
  if (dabs.any()) {
    const Mask open = dabs & kinds.sparse->grown(cells(1.5 * line, grid));  // reaches over all of what lies beside it
    kinds.solid -= open, *kinds.sparse |= open;
  }
  if (!belts.found.empty()) kinds.belts = std::move(belts);
}

Kinds kinds_of(const ShellSettings& settings, const InfillSettings& infill, const ShellObject& object,
               const Window& window, std::size_t index, Split split, const std::optional<Mask>& sparse_below) {
  const Grid& grid = window.grid();
  const double line = split.line;
  Kinds kinds{window.inside(index), Mask(grid), std::move(split.solid), {}, {}, std::move(split.sparse), {}};
  if (split.seen_above.any())
    kinds.top = split.seen_above.opened(cells(0.4 * line, grid)).grown(cells(0.5 * line, grid)) & kinds.solid;
  kinds.solid -= kinds.top;
  if (split.air_below.any()) {
    kinds.solid |= kinds.top;  // what is bridge below is not top
    const Mask seen = kinds.top;
    if (settings.bridges) {
      const Regions* on_support = object.layers[index].held;
      if (on_support != nullptr && !on_support->empty()) {
        const Mask held(grid, *on_support);
        find_bridges(settings, kinds, split.air_below - held, window.outline(index - 1) | held, object.nozzle);
      } else {
        find_bridges(settings, kinds, split.air_below, window.outline(index - 1), object.nozzle);
      }
    }
    kinds.top = seen & kinds.solid;
    kinds.solid -= kinds.top;
  }
  // strips between top and walls too narrow to fill apart go to the top
  if (kinds.top.any() && kinds.solid.any()) {
    Mask strips = kinds.solid - kinds.solid.opened(cells(0.5 * line, grid));
    const Mask to_top = std::move(strips) & kinds.top.grown(cells(line, grid));
    kinds.top |= to_top, kinds.solid -= to_top;
  }
  if (settings.bridges && index > 0) {
    const ShellLayer& below = object.layers[index - 1];
    const SparseStyle style = sparse_style(infill, {.index = index - 1,
                                                    .turn = index - 1,
                                                    .z = below.z,
                                                    .height = below.height,
                                                    .nozzle = object.nozzle,
                                                    .origin = object.box.centre(),
                                                    .turned_rad = object.turned_rad});
    find_internal_bridges(settings, style, kinds, sparse_below, line, object.nozzle);
  }
  const Um height = object.layers[index].height;
  if (kinds.sparse)
    lay_belts(
        *object.layers[index].inside, line,
        flow::spacing(length_or(settings.skin_line_width, object.nozzle, flow::automatic_width(object.nozzle, height)),
                      height, object.overlap_factor),
        kinds);
  if (kinds.sparse && !kinds.sparse->any()) kinds.sparse.reset();
  return kinds;
}

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
void drop_small_sparse(PartAreas& areas, SmallPatches& which) {
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

LayerAreas exact_areas(const ShellSettings& settings, const InfillSettings& infill, const ShellLayer& layer,
                       const Kinds& kinds, const std::optional<Mask>& sparse_below) {
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
  SmallPatches small(settings.infill_solid_below_area, sparse_below);
  for (std::size_t i = 0; i < order.size();) {
    PartAreas& areas = result.emplace_back();
    areas.part = parts[order[i]];
    for (const double angle : kinds.bridge_angles) areas.bridges.push_back({{}, angle});
    std::vector<Kind> all;
    if (kinds.belts) all.push_back({&kinds.belts->area, &areas.belted, &belted});
    for (std::size_t b = 0; b < kinds.bridges.size(); ++b)
      all.push_back({&kinds.bridges[b], &areas.bridges[b].regions});
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
    if (infill.infill_sparse_density > 0) drop_small_sparse(areas, small);
  }
  return result;
}

}  // namespace

Box box_of(std::span<const ShellLayer> layers) {
  Box box;
  for (const ShellLayer& layer : layers) box.add(weft::box_of(*layer.outline)), box.add(weft::box_of(*layer.inside));
  return box;
}

std::vector<LayerAreas> find_areas(const ShellSettings& settings, const InfillSettings& infill,
                                   const ShellObject& object, std::size_t first, std::size_t count) {
  const LayerRange run{first, first + count};
  LayerRange within_reach = run;
  // what is sparse below matters too, and there what is large below that
  const std::size_t below_run = first - std::min<std::size_t>(first, 2);
  for (std::size_t i = below_run; i < run.to; ++i) {
    const Reach reach = reach_of(settings, object.layers, i);
    within_reach.from = std::min(within_reach.from, i - std::min(i, std::max<std::size_t>(reach.below, 1)));
    within_reach.to =
        std::max(within_reach.to, std::min(object.layers.size(), i + std::max<std::size_t>(reach.above, 1) + 1));
  }
  const Window window(object, run, within_reach);
  std::vector<LayerAreas> result;
  std::optional<Mask> sparse_below, unclosed_below;
  for (std::size_t i = below_run; i < run.to; ++i) {
    stop_if_asked();
    if (object.layers[i].inside->empty()) {
      sparse_below.reset(), unclosed_below.reset();
      if (i >= run.from) result.emplace_back();
      continue;
    }
    Split split = split_of(settings, infill, object, window, i);
    std::optional<Mask> unclosed = split.sparse;
    if (split.sparse && infill.infill_sparse_density > 0)
      SmallPatches(settings.infill_solid_below_area, unclosed_below).close(*split.sparse, split.solid);
    std::optional<Mask> sparse = split.sparse;
    if (i >= run.from) {
      const Kinds kinds = kinds_of(settings, infill, object, window, i, std::move(split), sparse_below);
      result.push_back(exact_areas(settings, infill, object.layers[i], kinds, sparse_below));
    }
    sparse_below = std::move(sparse), unclosed_below = std::move(unclosed);
  }
  return result;
}

}  // namespace weft::infill
