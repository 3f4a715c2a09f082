// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/purge_into.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <utility>

namespace weft::pipeline {
namespace {

/// Behind so many walls the colour of infill does not show.
constexpr int hiding_walls = 2;

/// One change that purges, and what it has taken.
struct Change {
  std::size_t pass = 0;
  ToolId tool = 0;
  double left_mm3 = 0;
  double flow = 1;
  Beads taken;
};

/// Moves beads that are wanted from the list to the change, in their order, while it needs more.
/// @returns their volume, mm³
double take(Beads& beads, Um height, const std::function<bool(const Bead&)>& wanted, Change& change) {
  double sum = 0;
  std::erase_if(beads, [&](Bead& bead) {
    if (change.left_mm3 <= 0 || !wanted(bead)) return false;
    const double mm3 = volume_mm3(bead, height) * change.flow;
    change.left_mm3 -= mm3, sum += mm3;
    change.taken.push_back(std::move(bead));
    return true;
  });
  return sum;
}

/// The last pass of the layer in which each part of the object gets a wall; parts without walls are not there.
std::map<std::uint32_t, std::size_t> last_walls(const travel::ObjectLayer& object, const Passes& passes,
                                                std::size_t layer) {
  std::map<std::uint32_t, std::size_t> out;
  for (std::size_t p = passes.begin[layer]; p < passes.begin[layer + 1]; ++p)
    for (const Bead& bead : object.beads) {
      const bool here = bead.tool == any_tool ? p == passes.begin[layer] : bead.tool == passes.passes[p].tool;
      if (here && is_wall(bead.role)) out[bead.part] = p;
    }
  return out;
}

/// Each next to the one before, as far as that is easily had.
void put_in_order(Beads& beads) {
  for (std::size_t i = 1; i < beads.size(); ++i) {
    const Point at = beads[i - 1].path.back().at;
    const auto away = [&](const Bead& bead) {
      return std::min(distance(at, bead.path.front().at), distance(at, bead.path.back().at));
    };
    const auto next = std::min_element(beads.begin() + static_cast<std::ptrdiff_t>(i), beads.end(),
                                       [&](const Bead& a, const Bead& b) { return away(a) < away(b); });
    std::iter_swap(beads.begin() + static_cast<std::ptrdiff_t>(i), next);
    if (auto& path = beads[i].path; distance(at, path.back().at) < distance(at, path.front().at))
      std::reverse(path.begin(), path.end());
  }
}

void fill(const Scopes& scopes, travel::LayerInput& layer, std::size_t index, const Passes& passes, Change& change,
          Report::Purged& purged) {
  const auto each = [&](const auto& f) {
    for (auto& object : layer.objects)
      if (object.height == 0 || object.height == layer.height) f(object);
  };
  each([&](travel::ObjectLayer& object) {
    purged.objects_mm3 += take(
        object.beads, layer.height, [&](const Bead& bead) { return scopes[bead.scope].tools.purge_into_object; },
        change);
  });
  each([&](travel::ObjectLayer& object) {
    if (object.support)
      purged.support_mm3 += take(
          object.beads, layer.height,
          [&](const Bead& bead) { return bead.tool == any_tool && bead.role == Role::support; }, change);
  });
  each([&](travel::ObjectLayer& object) {
    if (object.support) return;
    const auto walls = last_walls(object, passes, index);
    purged.infill_mm3 += take(
        object.beads, layer.height,
        [&](const Bead& bead) {
          const auto& own = scopes[bead.scope];
          const auto last = walls.find(bead.part);
          return last != walls.end() && last->second < change.pass && bead.role == Role::infill &&
                 own.tools.purge_into_infill && own.walls.wall_line_count >= hiding_walls;
        },
        change);
  });
}

}  // namespace

void purge_into(ToolScopes& tools, Scopes& scopes, std::span<travel::LayerInput> layers, Passes& passes) {
  const auto& all = tools.tools();
  for (std::size_t p = 0; p < passes.passes.size(); ++p) {
    auto& pass = passes.passes[p];
    if (pass.purge_mm3 <= 0 || all[pass.tool].tools.material_soluble || all[*pass.from].tools.material_soluble)
      continue;
    Change change{p, pass.tool, pass.purge_mm3, all[pass.tool].material.material_flow / 100, {}};
    fill(scopes, layers[pass.layer], pass.layer, passes, change, passes.purged);
    if (change.taken.empty()) continue;
    for (auto& bead : change.taken) {
      bead.tool = pass.tool;
      bead.scope = tools.laid_over(bead.scope, pass.tool, scopes);
    }
    put_in_order(change.taken);
    pass.purge_mm3 = std::max(0.0, change.left_mm3);
    passes.into.emplace(p, std::move(change.taken));
  }
}

}  // namespace weft::pipeline
