// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/orient_model.h"

#include "geometry/boolean.h"
#include "geometry/simplify.h"
#include "mesh/facings.h"
#include "mesh/placement.h"
#include "mesh/transform.h"
#include "model/flow.h"
#include "slice/slice.h"
#include "support/plastic.h"
#include "support/support.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <cmath>

namespace weft::pipeline {
namespace {

using namespace weft::literals;

constexpr std::size_t hull_candidates = 40, flat_candidates = 24, sliced_candidates = 6, told = 5;
constexpr int coarse_layers = 60;

/// Plastic that a way of laying it costs, mm³: what support takes, and what the rest is worth beside it.
double cost_of(double planned_mm3, const Report::Orientation& o, double widest_mm2) {
  constexpr double mm3_by_scar_mm2 = 0.5;   // a scar is filed off
  constexpr double mm3_by_height_mm = 2;    // each layer is begun, cooled and ended
  constexpr double mm3_without_foot = 300;  // it comes off the bed
  const double foot = std::min(1.0, o.foot_mm2 / std::max(1.0, 0.1 * widest_mm2));
  const double slender = o.height_mm / std::sqrt(std::max(o.foot_mm2, 0.01));
  return planned_mm3 + mm3_by_scar_mm2 * (o.contact_mm2 + o.on_part_mm2) + mm3_by_height_mm * o.height_mm +
         mm3_without_foot * (1 - foot) + 10 * std::clamp(slender - 8, 0.0, 30.0);
}

/// The same from facets alone.
double guessed(const SupportSettings& s, const mesh::Laid& laid) {
  return laid.steep_mm3 * s.support_infill_rate / 100 + laid.steep_mm2 * 1.1 + 2 * laid.height_mm +
         (laid.foot_mm2 < 20 ? 100 : 0);
}

/// The layers of a mesh that stands on z = 0: the first as it is printed, the others as high as suffices.
std::vector<SlicedLayer> sliced(const Settings& settings, const Mesh& mesh) {
  const Um height = box_of(mesh).max.z;
  LayerSettings layers = settings.layers;
  layers.layer_height = std::clamp<Um>(height / coarse_layers, settings.layers.layer_height, 1_mm);
  const slice::Cutter cutter(mesh, slice::planes(layers, height));
  std::vector<SlicedLayer> out;
  for (std::size_t i = 0; i < cutter.size(); ++i) out.push_back(cutter.cut(i, layers).layer);
  return out;
}

/// @param plan  whether support is planned for it, which costs; else it is reckoned as columns
Report::Orientation judged(const Settings& settings, const Mesh& model, const std::array<double, 3>& down, bool plan) {
  Mesh mesh = mesh::transformed(model, mesh::laid_on(down), {});
  mesh = mesh::moved(std::move(mesh), {0, 0, -box_of(mesh).min.z});
  const auto layers = sliced(settings, mesh);
  std::vector<const SlicedLayer*> pointers;
  for (const auto& layer : layers) pointers.push_back(&layer);
  SupportSettings s = settings.support;
  s.support_enable = s.support_auto = true, s.support_enforce_layers = 0;
  const Um nozzle = settings.machine.nozzle_diameter;
  support::Object object;
  object.layers = pointers, object.nozzle = nozzle;
  object.outer_line = length_or(settings.walls.wall_line_width_0, nozzle, flow::automatic_outer_width(nozzle));
  const auto demand = support::demand(s, object);
  Report::Orientation out;
  out.down = down, out.height_mm = to_mm(box_of(mesh).max.z);
  double widest_mm2 = 0;
  Regions falling;  // columns, from the top down
  for (std::size_t i = layers.size(); i-- > 0;) {
    widest_mm2 = std::max(widest_mm2, area_mm2(layers[i].regions));
    if (!falling.empty()) {
      const auto cut = geometry::cut(falling, layers[i].regions);
      out.on_part_mm2 += area_mm2(cut.inside);
      falling = cut.outside;
      out.support_mm3 += area_mm2(falling) * to_mm(layers[i].height);
    }
    out.contact_mm2 += area_mm2(demand[i].wanted);
    if (demand[i].wanted.empty()) continue;
    falling.insert(falling.end(), demand[i].wanted.begin(), demand[i].wanted.end());
    falling = geometry::simplified(geometry::unite(falling), 50);
  }
  if (!layers.empty()) out.foot_mm2 = area_mm2(layers.front().regions);
  if (!plan) {
    const double roof = s.support_roof_enable ? to_mm(s.support_roof_height) : 0;
    out.cost_mm3 = cost_of(out.support_mm3 * s.support_infill_rate / 100 + out.contact_mm2 * roof, out, widest_mm2);
    return out;
  }
  const auto planned = support::plan(s, object, demand);
  out.on_part_mm2 = planned.figures.on_part_mm2;
  out.cost_mm3 = cost_of(support::plastic_mm3(s, nozzle, planned), out, widest_mm2);
  return out;
}

}  // namespace

std::vector<Report::Orientation> orientations_of(const Settings& settings, const Mesh& mesh) {
  const auto hull = mesh::hull_of(mesh);
  const auto candidates = mesh::facings_of(mesh, hull, hull_candidates, flat_candidates);
  const mesh::Facets facets(mesh, hull);
  const double degrees = settings.support.support_angle.value_or(45);
  auto guesses = tasks::parallel_map(candidates.size(), [&](std::size_t i) {
    return std::pair(guessed(settings.support, facets.laid(candidates[i].down, degrees)), i);
  });
  std::sort(guesses.begin(), guesses.end());
  if (guesses.size() > sliced_candidates) guesses.resize(sliced_candidates);
  if (std::none_of(guesses.begin(), guesses.end(), [](const auto& g) { return g.second == 0; }))
    guesses.emplace_back(0.0, std::size_t{0});  // as the file has it: it is to be no worse
  auto out = tasks::parallel_map(
      guesses.size(), [&](std::size_t i) { return judged(settings, mesh, candidates[guesses[i].second].down, false); });
  const auto cheaper = [](const auto& a, const auto& b) { return a.cost_mm3 < b.cost_mm3; };
  const auto as_given = std::find_if(guesses.begin(), guesses.end(), [](const auto& g) { return g.second == 0; });
  const double given_mm3 = out[static_cast<std::size_t>(as_given - guesses.begin())].cost_mm3;
  std::stable_sort(out.begin(), out.end(), cheaper);
  // Branches take less than columns where they are high: what is not decided by far is decided by a plan of both.
  constexpr double by_far = 0.6;
  const auto& given_down = candidates.front().down;
  if (out.front().down != given_down && out.front().cost_mm3 > by_far * given_mm3) {
    const std::array downs{given_down, out.front().down};
    auto both =
        tasks::parallel_map(downs.size(), [&](std::size_t i) { return judged(settings, mesh, downs[i], true); });
    std::stable_sort(both.begin(), both.end(), cheaper);
    std::erase_if(out, [&](const auto& o) { return o.down == downs[0] || o.down == downs[1]; });
    out.insert(out.begin(), both.begin(), both.end());
  }
  if (out.size() > told) out.resize(told);
  return out;
}

}  // namespace weft::pipeline
