#include "infill/infill.h"

#include "infill/solid.h"
#include "infill/sparse.h"
#include "model/flow.h"

#include <numbers>

namespace weft::infill {
namespace {

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

}  // namespace

FillLayer fill(const InfillSettings& infill, const ShellSettings& shells, const FillInput& input) {
  const Um automatic = flow::automatic_width(input.nozzle, input.height);
  const Um skin_band = flow::band(shells.skin_line_width.value_or(automatic), input.height);
  const Um top_band = flow::band(shells.top_skin_line_width.value_or(input.nozzle), input.height);
  const Um sparse_band = flow::band(
      infill.infill_line_width.value_or(flow::automatic_width(input.nozzle, input.height, false)), input.height);
  const double overlap = infill.infill_overlap.of(input.wall_line_width > 0 ? input.wall_line_width : automatic);
  const bool turned_layer = input.index % 2 == 1;
  const double skin_angle = radians(shells.skin_angle + (turned_layer ? 90 : 0));

  FillLayer layer;
  SolidStyle solid{.role = Role::solid_infill,
                   .band = skin_band,
                   .angle_rad = skin_angle,
                   .overlap_um = overlap,
                   .connect = true,
                   .fixed_strand = false,
                   .flow = 1,
                   .origin = input.origin,
                   .part = 0,
                   .sequence = 0};
  SolidStyle top = solid;
  top.role = Role::top_skin, top.band = top_band;
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
      style.sequence = ++sequence;
      fill_solid(region, style, layer.beads);
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
      for (const Region& region : areas.sparse) fill_sparse(region, style, layer.beads);
    }
    fill_all(areas.solid, solid, areas.part);
    fill_all(areas.top, top, areas.part);
  }
  return layer;
}

}  // namespace weft::infill
