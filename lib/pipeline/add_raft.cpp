// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/add_raft.h"

#include "adhesion/raft.h"
#include "core/stop.h"
#include "core/tolerances.h"
#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "infill/solid.h"
#include "infill/sparse.h"
#include "model/flow.h"
#include "pipeline/nozzles.h"

#include <algorithm>
#include <numbers>

namespace weft::pipeline {
namespace {

using namespace weft::literals;

Um width_of(const adhesion::RaftLayer& layer, Um nozzle) {
  return flow::automatic_width(nozzle, layer.height);
}

/// A loop around, and lines inside; those of neighbouring layers cross each other.
Beads raft_beads(const adhesion::RaftLayer& layer, const Regions& area, Um nozzle, bool across, Point origin) {
  const Um band = flow::band(width_of(layer, nozzle), layer.height);
  const double angle = across ? std::numbers::pi / 2 : 0;
  const Role role = layer.part == adhesion::RaftPart::surface ? Role::support_interface : Role::support;
  Beads beads;
  const auto loop = [&](const Ring& ring) {
    Bead bead;
    bead.role = role, bead.closed = true;
    for (const Point p : ring) bead.path.push_back({p, band, 1.F});
    beads.push_back(std::move(bead));
  };
  for (const Region& region : geometry::offset(area, {.by = -band / 2})) {
    loop(region.outer);
    for (const Ring& hole : region.holes) loop(hole);
  }
  for (const Region& region : geometry::offset(area, {.by = -band})) {
    stop_if_asked();
    if (layer.spacing <= band)
      infill::fill_solid(
          region, {.band = band, .angle_rad = angle, .origin = origin, .turned = false, .ordered = false}, beads);
    else
      infill::fill_sparse(region,
                          {.pattern = InfillPattern::lines,
                           .density = static_cast<double>(band) / layer.spacing,
                           .band = band,
                           .angle_rad = angle,
                           .z = layer.z,
                           .origin = origin},
                          beads);
  }
  for (Bead& bead : beads) bead.role = role, bead.sequence = 0, bead.part = 0;
  return beads;
}

Um nozzle_of_raft(const Settings& settings) {
  return nozzle_of(settings, settings.tools.adhesion_extruder_nr);
}

std::vector<adhesion::RaftLayer> layers_of(const Settings& settings) {
  return adhesion::raft_layers(settings.raft, nozzle_of_raft(settings), settings.layers.layer_height);
}

}  // namespace

PrintedLayers make_raft(const Settings& settings, const RaftScopes& scopes, const Regions& standing) {
  const Um nozzle = nozzle_of_raft(settings);
  // A part at the border stands there on the raft as well: of the beads only what bulges lies beyond the area.
  Um beyond = tolerances::border;
  for (const auto& layer : layers_of(settings))
    beyond = std::max(beyond, tolerances::border + rounded(flow::bulge_um(width_of(layer, nozzle), layer.height, 1)));
  Regions room = geometry::offset({{print_surface(settings.machine), {}}}, {.by = -beyond});
  Regions no_go;
  for (const Ring& ring : settings.machine.bed_exclude_areas) no_go.push_back({ring, {}});
  if (!no_go.empty()) room = geometry::subtract(room, geometry::offset(geometry::unite(no_go), {.by = beyond}));
  const Regions area = adhesion::raft_area(settings.raft, standing, room);
  const Box box = box_of(area);
  PrintedLayers out;
  for (const auto& layer : layers_of(settings)) {
    auto& made = out.emplace_back();
    made.z = layer.z, made.height = layer.height;
    made.outline = area;
    made.beads = raft_beads(layer, area, nozzle, out.size() % 2 == 0, box.empty() ? Point{} : box.centre());
    const ScopeId scope = layer.part == adhesion::RaftPart::base      ? scopes.base
                          : layer.part == adhesion::RaftPart::between ? scopes.between
                                                                      : scopes.surface;
    for (Bead& bead : made.beads) bead.scope = scope;
  }
  return out;
}

Um raft_lift(const Settings& settings) {
  if (settings.adhesion.adhesion_type != AdhesionType::raft) return 0;
  return layers_of(settings).back().z + settings.raft.raft_airgap;
}

AdhesionSettings adhesion_of(const AdhesionSettings& settings) {
  constexpr Um usual_brim = 8_mm;  // where a brim is asked for, but not how wide
  AdhesionSettings out = settings;
  const AdhesionType type = settings.adhesion_type;
  if (type == AdhesionType::as_set) return out;
  if (type == AdhesionType::skirt)
    out.skirt_line_count = std::max(1, settings.skirt_line_count);
  else if (type != AdhesionType::raft)  // around a raft it fills the nozzle as well as around parts
    out.skirt_line_count = 0;
  const Um brim = settings.brim_width > 0 ? settings.brim_width : usual_brim;
  out.brim_width = type == AdhesionType::brim ? brim : 0;
  return out;
}

}  // namespace weft::pipeline
