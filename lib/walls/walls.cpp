#include "walls/walls.h"

#include "geometry/offset.h"
#include "model/flow.h"

#include <algorithm>

namespace weft::walls {
namespace {

void add_rings(const Regions& at, Um width, std::uint16_t inset, std::uint32_t part, Beads& out) {
  auto add = [&](const Ring& ring) {
    if (ring.size() < 3) return;
    Bead bead;
    bead.role = inset == 0 ? Role::outer_wall : Role::inner_wall;
    bead.closed = true;
    bead.inset = inset;
    bead.part = part;
    for (const Point p : ring) bead.path.push_back({p, width});
    out.push_back(std::move(bead));
  };
  for (const Region& region : at) {
    add(region.outer);
    for (const Ring& hole : region.holes) add(hole);
  }
}

}  // namespace

WallLayer build(const WallSettings& settings, const WallInput& input) {
  WallLayer out;
  const Um height = input.layer.height;
  const Um outer =
      flow::band(settings.wall_line_width_0.value_or(flow::automatic_outer_width(input.nozzle_diameter)), height);
  const Um inner =
      flow::band(settings.wall_line_width_x.value_or(flow::automatic_width(input.nozzle_diameter, height)), height);
  for (std::uint32_t part = 0; part < input.layer.regions.size(); ++part) {
    const Regions whole{input.layer.regions[part]};
    Um edge = 0;
    Beads beads;
    for (int i = 0; i < settings.wall_line_count; ++i) {
      const Um width = i == 0 ? outer : inner;
      const Regions at = geometry::offset(whole, {.by = -(edge + width / 2)});
      if (at.empty()) break;
      add_rings(at, width, static_cast<std::uint16_t>(i), part, beads);
      edge += width;
    }
    if (settings.wall_order == WallOrder::inside_out) std::reverse(beads.begin(), beads.end());
    out.beads.insert(out.beads.end(), beads.begin(), beads.end());
    const Regions rest = edge == 0 ? whole : geometry::offset(whole, {.by = -edge});
    out.inside.insert(out.inside.end(), rest.begin(), rest.end());
  }
  return out;
}

}  // namespace weft::walls
