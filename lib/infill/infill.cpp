#include "infill/infill.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "infill/solid.h"
#include "infill/sparse.h"
#include "model/flow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

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

/// Across the bridge that most of an area lies on: its strands then carry each line at many places.
std::optional<double> angle_across_bridges(const Region& region, std::span<const BridgeArea> below) {
  const Box box = box_of(region.outer);
  for (const BridgeArea& bridge : below) {
    const Box other = box_of(bridge.regions);
    if (other.empty() || other.max.x < box.min.x || other.min.x > box.max.x || other.max.y < box.min.y ||
        other.min.y > box.max.y)
      continue;
    if (area_mm2(geometry::intersect({region}, bridge.regions)) >= area_mm2(region) / 2)
      return bridge.angle_rad + radians(90);
  }
  return std::nullopt;
}

/// How the areas of a layer are filled, but for what differs from area to area.
struct Styles {
  SolidStyle solid, top, bridge;
  SparseStyle sparse;
};

Styles styles_of(const InfillSettings& infill, const ShellSettings& shells, const FillInput& input) {
  const Um automatic = flow::automatic_width(input.nozzle, input.height);
  const double overlap = infill.infill_overlap.of(input.wall_line_width > 0 ? input.wall_line_width : automatic);
  Styles out;
  out.solid = {.role = Role::solid_infill,
               .band = flow::band(shells.skin_line_width.value_or(automatic), input.height),
               .angle_rad = 0,
               .overlap_um = overlap,
               .connect = infill.infill_connect_lines,
               .fixed_strand = false,
               .flow = 1,
               .origin = input.origin,
               .part = 0,
               .sequence = 0};
  out.top = out.bridge = out.solid;
  out.top.role = Role::top_skin;
  out.top.band = flow::band(shells.top_skin_line_width.value_or(input.nozzle), input.height);
  out.bridge.role = Role::bridge, out.bridge.band = input.nozzle, out.bridge.fixed_strand = true;
  out.bridge.flow = flow::bridge_flow(input.nozzle, input.height) * shells.bridge_flow / 100;
  out.sparse = sparse_style(infill, {input.index, input.z, input.height, input.nozzle, input.origin});
  out.sparse.overlap_um = overlap;
  return out;
}

}  // namespace

FillLayer fill(const InfillSettings& infill, const ShellSettings& shells, const FillInput& input) {
  const Styles styles = styles_of(infill, shells, input);
  const double turn = input.index % 2 == 1 ? radians(90) : 0;
  FillLayer layer;
  std::uint32_t sequence = 0;
  const auto fill_all = [&](const Regions& regions, SolidStyle style, std::uint32_t part, const auto& angle_of) {
    style.part = part;
    for (const Region& region : regions) {
      stop_if_asked();
      style.sequence = ++sequence;
      style.angle_rad = angle_of(region);
      fill_solid(region, style, layer.beads);
    }
  };
  const auto top_angle = [&](const Region& region) {
    return turn + (shells.skin_angle ? radians(*shells.skin_angle) : angle_along_walls(region));
  };
  const auto solid_angle = [&](const Region& region) {
    const auto across = angle_across_bridges(region, input.bridges_below);
    return across ? *across : top_angle(region);
  };
  for (const PartAreas& areas : input.areas) {
    for (const BridgeArea& area : areas.bridges)
      fill_all(area.regions, styles.bridge, areas.part, [&](const Region&) { return area.angle_rad; });
    if (infill.infill_sparse_density > 0) {
      SparseStyle style = styles.sparse;
      style.part = areas.part;
      for (const Region& region : areas.sparse) {
        stop_if_asked();
        fill_sparse(region, style, layer.beads);
      }
    }
    fill_all(areas.solid, styles.solid, areas.part, solid_angle);
    fill_all(areas.top, styles.top, areas.part, top_angle);
  }
  return layer;
}

}  // namespace weft::infill
