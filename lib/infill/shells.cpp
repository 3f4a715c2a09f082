// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/shells.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/simplify.h"
#include "infill/exact_areas.h"
#include "infill/hanging.h"
#include "infill/mask_parts.h"
#include "model/flow.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace weft::infill {
namespace {

using namespace weft::literals;

constexpr Um finest_cell = 0.1_mm;
constexpr double most_cells = 2.3e6;  // of the grid over an object: 150 × 150 mm of the finest cells
constexpr int margin_cells = 4;

/// Layers [from, to).
struct LayerRange {
  std::size_t from, to;
};

/// What a run of layers is compared with, made once: outlines and insides of all layers within reach.
class Window {
 public:
  Window(const ShellObject& object, LayerRange within_reach) : from_(within_reach.from) {
    const Grid whole = Grid::over(object.box, finest_cell, 0, most_cells);
    Box box;
    for (std::size_t i = from_; i < within_reach.to; ++i)
      box.add(weft::box_of(*object.layers[i].outline)), box.add(weft::box_of(*object.layers[i].inside));
    grid_ = whole.window(box, margin_cells * whole.cell);
    for (std::size_t i = from_; i < within_reach.to; ++i)
      layers_.push_back({{grid_, *object.layers[i].outline}, {grid_, *object.layers[i].inside}});
  }
  struct Layer {
    LayerArea outline, inside;
  };
  const Grid& grid() const { return grid_; }
  const Layer& layer(std::size_t index) const { return layers_[index - from_]; }
  const Mask& outline(std::size_t index) const { return layer(index).outline.cells(); }
  const Mask& inside(std::size_t index) const { return layer(index).inside.cells(); }

 private:
  std::size_t from_;
  Grid grid_;
  std::vector<Layer> layers_;
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

/// What has to cover sparse infill: outlines, or air were within the skin; and insides, or walls would stand on sparse
/// infill. A wall, and solid that carries one, may step by `step` (µm) beyond what is below it: insides cover that much
/// more, and as much again for each layer further away. Below it is the same: there walls end in solid.
/// @returns nothing where the skin reaches beyond the object's ends
std::optional<LayersInReach> layers_in(Reach reach, const Window& window, std::size_t layers, std::size_t index,
                                       Um step) {
  if (reach.below > index || index + reach.above >= layers) return std::nullopt;
  LayersInReach out{&window.layer(index).inside, {}};
  const Mask& here = out.here->cells();
  const auto add = [&](const Window::Layer& other, std::size_t away) {
    if (here.within(other.inside.cells())) return;
    const int steps = static_cast<int>(away);
    out.covers.push_back({&other.outline, 0, &other.outline.cells()});
    const Mask& carried = other.inside.grown(step, steps);
    if (!other.outline.cells().within(carried)) out.covers.push_back({&other.inside, steps * step, &carried});
  };
  for (std::size_t away = std::max(reach.below, reach.above); away > 0; --away) {
    if (away <= reach.below) add(window.layer(index - away), away);
    if (away <= reach.above) add(window.layer(index + away), away);
  }
  return out;
}

Mask solid_cells(const LayersInReach& layers) {
  std::vector<const Mask*> covers;
  for (const Cover& cover : layers.covers) covers.push_back(cover.cells);
  Mask covered = layers.here->cells();
  covered &= covers;
  return layers.here->cells() - covered;
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
  const MaskParts strips(out.all);
  for (std::size_t i = 0; i < strips.size(); ++i) {
    if (strips.mm2(i) >= short_strip * line * line * 1e-6) continue;
    const auto runs = strips.runs(i);
    const bool end = std::any_of(runs.begin(), runs.end(), [&](const auto& run) { return out.wide.any_around(run); });
    for (const CellRun& run : runs) (end ? out.ends : out.dabs).set(run);
  }
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
  std::optional<Mask> thin;    ///< of it: what would be solid, but is too narrow for a line of its own
  LayersInReach layers;        ///< that decided so
};

Split split_of(const ShellSettings& settings, const InfillSettings& infill, const ShellObject& object,
               const Window& window, std::size_t index) {
  const ShellLayer& layer = object.layers[index];
  const Grid& grid = window.grid();
  const Mask& inside = window.inside(index);
  const Reach reach = reach_of(settings, object.layers, index);
  const auto beyond = [&](std::size_t other) {  // of the inside: what that layer does not cover
    return other < object.layers.size() ? inside - window.outline(other) : inside;
  };
  Split out{static_cast<double>(flow::automatic_width(object.nozzle, layer.height)),
            Mask(grid),
            reach.above > 0 ? beyond(index + 1) : Mask(grid),
            reach.below > 0 && index > 0 ? beyond(index - 1) : Mask(grid),
            {},
            {},
            {}};
  const bool whole =
      settings.infill_solid_every_layers && index % static_cast<std::size_t>(*settings.infill_solid_every_layers) == 0;
  std::optional<LayersInReach> layers;
  if (infill.infill_sparse_density < 100 && !whole)
    layers = layers_in(reach, window, object.layers.size(), index, std::max(object.nozzle / 2, layer.height));
  if (!layers) {
    out.solid = inside;
    return out;
  }
  out.layers = *std::move(layers);
  const Mask all = solid_cells(out.layers);
  out.solid = all.opened(cells(0.3 * out.line, grid));
  if (out.seen_above.any() || out.air_below.any())
    out.solid |= (out.seen_above | out.air_below).grown(cells(out.line, grid)) & inside;
  Mask sparse = inside - out.solid;
  if (layer.open != nullptr) sparse &= Mask(grid, *layer.open);
  if (out.solid.any()) sparse -= closed_strips(sparse, out.line);
  out.solid = inside - sparse;
  if (sparse.any()) out.thin = all & sparse, out.sparse = std::move(sparse);
  return out;
}

/// Narrow solid beside sparse infill is as wide as its lines; what is too short for one is sparse.
/// @param thin of what is sparse: what belts may close
/// @param line width of the lines that are laid: what carries walls between two belts is no more than some of them
void lay_belts(const Regions& inside, const Mask& thin, const LayersInReach& layers, double line, Um band,
               Kinds& kinds) {
  const Grid& grid = kinds.inside.grid();
  Belts belts = find_belts(inside, kinds.solid | thin, *kinds.sparse - thin, layers, band);
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

/// Strips of solid too narrow to fill apart are top where they lie beside it, and where all of them is seen from above:
/// between walls, where the top is no wider.
void give_strips_to_top(const Mask& seen_above, double line, Kinds& kinds) {
  if (!seen_above.any() || !kinds.solid.any()) return;
  const int by = cells(line, kinds.solid.grid());
  const Mask strips = kinds.solid - kinds.solid.opened(cells(0.5 * line, kinds.solid.grid()));
  if (!strips.any()) return;
  Mask to_top = strips & seen_above;
  if (to_top.any()) to_top -= (kinds.solid - seen_above).grown(by);
  if (kinds.top.any()) to_top |= strips & kinds.top.grown(by);
  kinds.top |= to_top, kinds.solid -= to_top;
}

/// Strips of solid between tops, below walls that stand there, are top: between letters' floors they would be a
/// patchwork.
void give_what_lies_between_to_top(double line, Kinds& kinds) {
  constexpr double widest = 3.5;  // lines: two walls of letters and what they enclose
  if (!kinds.top.any() || !kinds.solid.any()) return;
  const int by = cells(widest / 2 * line, kinds.top.grid());
  const Mask between = kinds.top.grown(by).shrunk(by) & kinds.solid;
  kinds.top |= between, kinds.solid -= between;
}

/// A patch of solid that is no larger than the top of its layer is top: what of a top is covered by something that
/// stands on it, letters or a boss, and what closes the slope beside it. One surface has fewer ends of lines than two
/// that fit into each other, and its lines need not be narrower or wider along their border.
void give_patches_to_top(Kinds& kinds) {
  if (!kinds.top.any() || !kinds.solid.any()) return;
  const Grid& grid = kinds.solid.grid();
  const double top_mm2 = static_cast<double>(kinds.top.count()) * to_mm(grid.cell) * to_mm(grid.cell);
  Regions patches;
  for (Region& patch : geometry::regions_from_rings(kinds.solid.outlines())) {
    if (area_mm2(patch) > top_mm2) continue;
    const Grid around = grid.window(weft::box_of(patch.outer), 3 * grid.cell);
    if (Mask(around, {&patch, 1}).grown(1).meets(kinds.top)) patches.push_back(std::move(patch));
  }
  if (patches.empty()) return;
  const Mask given = Mask(grid, patches).grown(1) & kinds.solid;
  kinds.top |= given, kinds.solid -= given;
}

Kinds kinds_of(const ShellSettings& settings, const InfillSettings& infill, const ShellObject& object,
               const Window& window, std::size_t index, Split split, const std::optional<Mask>& sparse_below) {
  const Grid& grid = window.grid();
  const double line = split.line;
  const HangingLayer hanging{line, object.nozzle};
  Kinds kinds{window.inside(index), Mask(grid), std::move(split.solid), {}, std::move(split.sparse), {}};
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
        find_bridges(settings, hanging, split.air_below - held, window.outline(index - 1) | held, kinds);
      } else {
        find_bridges(settings, hanging, split.air_below, window.outline(index - 1), kinds);
      }
    }
    kinds.top = seen & kinds.solid;
    kinds.solid -= kinds.top;
  }
  give_strips_to_top(split.seen_above, line, kinds);
  give_what_lies_between_to_top(line, kinds);
  if (settings.bridges && index > 0) {
    const ShellLayer& below = object.layers[index - 1];
    const SparseStyle style = sparse_style(infill, {.index = index - 1,
                                                    .turn = index - 1,
                                                    .z = below.z,
                                                    .height = below.height,
                                                    .nozzle = object.nozzle,
                                                    .origin = object.box.centre(),
                                                    .turned_rad = object.turned_rad});
    find_internal_bridges(settings, hanging, style, sparse_below, kinds);
  }
  give_patches_to_top(kinds);
  if (kinds.sparse) {
    const Um height = object.layers[index].height,
             laid = length_or(settings.skin_line_width, object.nozzle, flow::automatic_width(object.nozzle, height));
    lay_belts(*object.layers[index].inside, *split.thin & *kinds.sparse, split.layers, laid,
              flow::spacing(laid, height, object.overlap_factor), kinds);
  }
  if (kinds.sparse && !kinds.sparse->any()) kinds.sparse.reset();
  return kinds;
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
  const Window window(object, within_reach);
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
      const SmallPatches small(settings.infill_solid_below_area, sparse_below);
      result.push_back(exact_areas(object.layers[i], kinds, infill.infill_sparse_density > 0 ? &small : nullptr));
    }
    sparse_below = std::move(sparse), unclosed_below = std::move(unclosed);
  }
  return result;
}

}  // namespace weft::infill
