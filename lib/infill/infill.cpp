// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/infill.h"

#include "core/stop.h"
#include "infill/solid.h"
#include "infill/sparse.h"
#include "model/flow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace weft::infill {
namespace {

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

/// The direction (up to 90°) of most of the area's edge, when half of it runs that way or across; else 45°. Lines along
/// straight walls end square on the walls across, so they leave nothing open.
double angle_along_walls(const Region& region) {
  constexpr double shortest_um = 1000;  // of what counts as a straight wall
  constexpr std::size_t bins = 90;
  constexpr double quarter = std::numbers::pi / 2;
  std::array<double, bins> length{}, longest{}, angle{};
  double all = 0;
  const auto look = [&](const Ring& ring) {
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const double l = distance(ring[j], ring[i]);
      all += l;
      if (l < shortest_um) continue;
      double a = std::fmod(std::atan2(ring[i].y - ring[j].y, ring[i].x - ring[j].x) + 2 * std::numbers::pi, quarter);
      if (a > quarter - 1e-9) a = 0;
      const auto bin = static_cast<std::size_t>(std::lround(a / quarter * bins)) % bins;
      length[bin] += l;
      if (l > longest[bin]) longest[bin] = l, angle[bin] = a;
    }
  };
  look(region.outer);
  for (const Ring& hole : region.holes) look(hole);
  const auto peak = static_cast<std::size_t>(std::max_element(length.begin(), length.end()) - length.begin());
  return length[peak] >= all / 2 ? angle[peak] : radians(45);
}

/// The directions, joints and order that a pattern of solid layers asks for.
void apply(SkinPattern pattern, SolidStyle& style) {
  style.connect = style.connect && pattern != SkinPattern::monotonic_lines;
  style.turned = pattern != SkinPattern::aligned_lines;
  style.ordered = pattern == SkinPattern::monotonic || pattern == SkinPattern::monotonic_lines;
}

/// Lines laid so far apart that they overlap less are as wide as before.
void spread_out(Um by, std::size_t from, Beads& beads) {
  if (by == 0) return;
  for (std::size_t i = from; i < beads.size(); ++i)
    for (Junction& j : beads[i].path) j.width = std::max(1, j.width - by);
}

}  // namespace

FillLayer fill(const InfillSettings& infill, const ShellSettings& shells, const FillInput& input) {
  const Um automatic = flow::automatic_width(input.nozzle, input.height);
  const Um skin_band = flow::spacing(shells.skin_line_width.value_or(automatic), input.height, input.overlap_factor);
  const Um top_band =
      flow::spacing(shells.top_skin_line_width.value_or(input.nozzle), input.height, input.overlap_factor);
  const Um sparse_width = infill.infill_line_width.value_or(flow::automatic_width(input.nozzle, input.height, false));
  const Um sparse_band = flow::band(sparse_width, input.height);
  const double overlap = infill.infill_overlap.of(input.wall_line_width > 0 ? input.wall_line_width : automatic);
  const bool turned_layer = input.index % 2 == 1;
  const double turn = turned_layer ? radians(90) : 0;

  FillLayer layer;
  SolidStyle solid{.role = Role::solid_infill,
                   .band = skin_band,
                   .angle_rad = 0,
                   .overlap_um = overlap,
                   .connect = infill.infill_connect_lines,
                   .fixed_strand = false,
                   .flow = 1,
                   .origin = input.origin,
                   .part = 0,
                   .sequence = 0};
  SolidStyle top = solid;
  top.role = Role::top_skin, top.band = top_band;
  apply(shells.bottom_pattern, solid);
  apply(shells.top_pattern, top);
  SolidStyle bridge = solid;
  bridge.role = Role::bridge, bridge.band = input.nozzle, bridge.fixed_strand = true;
  bridge.flow = flow::bridge_flow(input.nozzle, input.height) * shells.bridge_flow / 100;
  const SparseStyle sparse{.pattern = infill.infill_pattern,
                           .density = infill.infill_sparse_density / 100,
                           .band = sparse_band,
                           .angle_rad = radians(infill.infill_angle),
                           .overlap_um = overlap,
                           .connect = infill.infill_connect_lines,
                           .turned_layer = turned_layer,
                           .z = input.z,
                           .origin = input.origin,
                           .part = 0};
  std::uint32_t sequence = 0;
  const auto fill_all = [&](const Regions& regions, SolidStyle style, std::uint32_t part) {
    style.part = part;
    for (const Region& region : regions) {
      stop_if_asked();
      style.sequence = style.ordered ? ++sequence : 0;
      if (style.role != Role::bridge)
        style.angle_rad =
            (style.turned ? turn : 0) + (shells.skin_angle ? radians(*shells.skin_angle) : angle_along_walls(region));
      const std::size_t from = layer.beads.size();
      fill_solid(region, style, layer.beads);
      if (style.role != Role::bridge) spread_out(flow::spread(input.height, input.overlap_factor), from, layer.beads);
    }
  };
  for (const PartAreas& areas : input.areas) {
    for (const BridgeArea& area : areas.bridges) {
      bridge.angle_rad = area.angle_rad;
      fill_all(area.regions, bridge, areas.part);
    }
    if (infill.infill_sparse_density > 0) {
      SparseStyle style = sparse;
      style.part = areas.part;
      for (const Region& region : areas.sparse) {
        stop_if_asked();
        fill_sparse(region, style, layer.beads);
      }
      style.layers = areas.combined_layers;
      style.band = flow::band(sparse_width, input.height * areas.combined_layers);
      for (const Region& region : areas.combined) {
        stop_if_asked();
        fill_sparse(region, style, layer.beads);
      }
    }
    fill_all(areas.solid, solid, areas.part);
    fill_all(areas.top, top, areas.part);
  }
  return layer;
}

Notices check(const InfillSettings& infill, Um nozzle_diameter, Um height) {
  if (infill.infill_line_width || infill.infill_sparse_density <= 0 || infill.infill_sparse_density >= 100) return {};
  const double d = to_mm(nozzle_diameter), h = to_mm(height);
  const double strand_mm = std::numbers::pi / 4 * (d * d - h * h) / h + h,
               widest_mm = to_mm(flow::automatic_width(nozzle_diameter, height, false));
  if (strand_mm <= widest_mm) return {};
  return {
      {"infill_line_width_cut",
       fmt::format("infill_line_width: auto would be {:.2f} mm, a strand of the nozzle's cross-section in layers of "
                   "{:.2f} mm; a nozzle of {:.2f} mm presses none flat beyond {:.2f} mm, and lines are that wide",
                   strand_mm, h, d, widest_mm)}};
}

}  // namespace weft::infill
