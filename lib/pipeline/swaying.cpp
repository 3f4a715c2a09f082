// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/swaying.h"

#include "core/convex_hull.h"
#include "geometry/touching.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace weft::pipeline {
namespace {

/// How far a round rod of that cross-section gives at its top: F h³ / 3 E I, with I = A² / 4 π. Walls are stroked
/// along, where they are stiff, and give no more than the rod that has their area.
double aside_mm(double height_mm, double area_mm2) {
  constexpr double drag_n = 0.1;          // of a nozzle on the bead that it lays
  constexpr double stiffness_mpa = 2500;  // Young's modulus of printed PLA or PETG across layers, about
  return drag_n * height_mm * height_mm * height_mm * 4 * std::numbers::pi / (3 * stiffness_mpa * area_mm2 * area_mm2);
}

/// A region of a layer, and one above that stands on it alone.
struct Carried {
  std::uint32_t own = 0, above = 0;
};
std::vector<Carried> carried_alone(const Regions& layer, const Regions& above) {
  std::vector<Carried> out;
  if (layer.empty() || above.empty()) return out;
  const std::size_t own = layer.size();
  Regions both = layer;
  both.insert(both.end(), above.begin(), above.end());
  for (const auto& together : geometry::overlapping(both)) {  // ascending: own ones first
    if (together.front() >= own || (together.size() > 1 && together[1] < own)) continue;
    for (std::size_t k = 1; k < together.size(); ++k)
      out.push_back({static_cast<std::uint32_t>(together.front()), static_cast<std::uint32_t>(together[k] - own)});
  }
  return out;
}

/// Up to where each region of a layer carries what stands on it alone, while that is printed.
std::vector<Um> tops_of(const SlicedLayer& layer, const std::vector<Carried>& carried,
                        const std::vector<Um>& tops_above) {
  std::vector<Um> out(layer.regions.size(), layer.z);
  for (const auto& [own, above] : carried) out[own] = std::max(out[own], tops_above[above]);
  return out;
}

}  // namespace

std::optional<Swaying> most_swaying(const std::vector<slice::Cut>& cuts, std::size_t from, Um bead) {
  Um top = 0;
  for (const auto& cut : cuts)
    if (!cut.layer.regions.empty()) top = std::max(top, cut.layer.z);
  const double most_mm = to_mm(bead);
  const double least_mm2 =
      most_mm * most_mm / 4;  // what is smaller is hardly laid: what begins above it hangs in the air
  // Most objects have nothing so small at all: a hull has at least the area of its region.
  const auto may_sway = [&](std::size_t i) {
    const auto& [z, height, regions] = cuts[i].layer;
    const double above = to_mm(top - z + height);
    return std::any_of(regions.begin(), regions.end(), [&](const Region& region) {
      const double area = area_mm2(region);
      return area >= least_mm2 && aside_mm(above, area) > most_mm;
    });
  };
  std::size_t lowest = cuts.size();
  for (std::size_t i = from; i < cuts.size() && lowest == cuts.size(); ++i)
    if (may_sway(i)) lowest = i;
  std::optional<Swaying> out;
  std::vector<Um> tops;
  const auto from_top = [&](std::size_t k) { return cuts.size() - 1 - k; };
  const auto carried = [&](std::size_t k) {
    return k == 0 ? std::vector<Carried>{}
                  : carried_alone(cuts[from_top(k)].layer.regions, cuts[from_top(k - 1)].layer.regions);
  };
  tasks::parallel_in_order(cuts.size() - lowest, carried, [&](std::size_t k, const std::vector<Carried>& on) {
    const auto& layer = cuts[from_top(k)].layer;
    tops = tops_of(layer, on, tops);
    for (std::size_t r = 0; r < layer.regions.size(); ++r) {
      const double stands_mm = to_mm(tops[r] - layer.z + layer.height);
      const auto gives = [&](double area) {
        return area >= least_mm2 && aside_mm(stands_mm, area) > (out ? out->aside_mm : most_mm);
      };
      if (!gives(area_mm2(layer.regions[r]))) continue;
      const Region hull{convex_hull(layer.regions[r].outer), {}};
      const double area = area_mm2(hull);
      if (gives(area))
        out = {box_of(hull.outer).centre(), layer.z - layer.height, area, stands_mm, aside_mm(stands_mm, area)};
    }
  });
  return out;
}

}  // namespace weft::pipeline
