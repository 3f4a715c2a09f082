#include "walls/walls.h"

#include "geometry/boolean.h"
#include "geometry/medial_axis.h"
#include "geometry/offset.h"
#include "model/flow.h"
#include "walls/finish.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::walls {
namespace {

constexpr double chord_um = 4;  // how far a chord may stand off a bead that bends around a corner

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

/// Concentric walls of nominal width: when there is no medial axis to go by.
Regions plain(const Widths& widths, const Regions& whole, std::uint32_t part, Beads& out) {
  Um edge = 0;
  for (int i = 0; i < widths.walls; ++i) {
    const Um width = rounded(i == 0 ? widths.outer : widths.inner);
    const Regions at = geometry::offset(whole, {.by = -(edge + width / 2)});
    if (at.empty()) break;
    add_rings(at, width, static_cast<std::uint16_t>(i), part, out);
    edge += width;
  }
  return edge == 0 ? whole : geometry::offset(whole, {.by = -edge});
}

Regions rest_of(const Skeleton& skeleton, const Laying& laying, Point origin) {
  std::vector<Ring> rings;
  for (const auto& places : trace_rest(skeleton, laying)) {
    Ring ring;
    for (const Place p : places) {
      const Point q{origin.x + rounded(p.x), origin.y + rounded(p.y)};
      if (ring.empty() || ring.back() != q) ring.push_back(q);
    }
    if (ring.size() >= 3) rings.push_back(std::move(ring));
  }
  return rings.empty() ? Regions{} : geometry::regions_from_rings(rings);
}

struct Part {
  Beads beads;
  Regions inside;
  double dropped_mm = 0;
  bool valid = true;
};

Part build_part(const WallSettings& settings, const Widths& widths, const Region& region, std::uint32_t index) {
  Part out;
  const auto axis = geometry::medial_axis(region);
  if (!axis.valid) {
    out.valid = false;
    out.inside = plain(widths, {region}, index, out.beads);
    return out;
  }
  Skeleton skeleton = skeleton_of(axis, chord_um);
  LayingOptions options;
  options.steep = std::sin(settings.wall_transition_angle / 2 * std::numbers::pi / 180);
  options.ramp = settings.wall_transition_length.of(400);
  options.filter = settings.wall_transition_filter_distance;
  const Laying laying = lay(skeleton, widths, options);
  FinishOptions finishing;
  finishing.origin = axis.origin;
  finishing.part = index;
  finishing.least_feature = widths.least_feature;
  finishing.least_length = settings.min_wall_length;
  finishing.compensate = settings.flow_compensation;
  finishing.stable_outer = std::max<double>(settings.min_output_width, widths.outer / 4);
  finishing.stable_inner = std::max<double>(settings.min_output_width, widths.inner / 4);
  finishing.least_flow = settings.min_flow_ratio / 100;
  finishing.most_flow = settings.max_flow_ratio / 100;
  for (auto& line : trace_pairs(skeleton, laying)) finish(std::move(line), finishing, out.beads, out.dropped_mm);
  for (auto& line : trace_middles(skeleton, laying)) finish(std::move(line), finishing, out.beads, out.dropped_mm);
  out.inside = rest_of(skeleton, laying, axis.origin);
  return out;
}

}  // namespace

WallLayer build(const WallSettings& settings, const WallInput& input) {
  WallLayer out;
  const Widths widths = widths_of(settings, input.nozzle_diameter, input.layer.height, input.index);
  if (widths.walls == 0) {
    out.inside = input.layer.regions;
    return out;
  }
  for (std::uint32_t i = 0; i < input.layer.regions.size(); ++i) {
    Part part = build_part(settings, widths, input.layer.regions[i], i);
    put_in_order(part.beads, settings.wall_order);
    out.beads.insert(out.beads.end(), std::make_move_iterator(part.beads.begin()),
                     std::make_move_iterator(part.beads.end()));
    out.inside.insert(out.inside.end(), std::make_move_iterator(part.inside.begin()),
                      std::make_move_iterator(part.inside.end()));
  }
  return out;
}

}  // namespace weft::walls
