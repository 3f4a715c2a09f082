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
#include <iterator>
#include <numbers>

namespace weft::pipeline {
namespace {

using namespace weft::literals;

Um width_of(const adhesion::RaftLayer& layer, Um nozzle) {
  return flow::automatic_width(nozzle, layer.height);
}

/// Lines of a layer of the raft.
struct Lines {
  Um nozzle, spacing;
  bool across;
  Point origin;
  Role role;
  ScopeId scope;
};

/// A loop around, and lines inside; those of neighbouring layers cross each other.
void lay_raft(const adhesion::RaftLayer& layer, const Regions& area, const Lines& lines, Beads& out) {
  const Um band = flow::band(width_of(layer, lines.nozzle), layer.height);
  const double angle = lines.across ? std::numbers::pi / 2 : 0;
  Beads beads;
  const auto loop = [&](const Ring& ring) {
    Bead bead;
    bead.closed = true;
    for (const Point p : ring) bead.path.push_back({p, band, 1.F});
    beads.push_back(std::move(bead));
  };
  for (const Region& region : geometry::offset(area, {.by = -band / 2})) {
    loop(region.outer);
    for (const Ring& hole : region.holes) loop(hole);
  }
  for (const Region& region : geometry::offset(area, {.by = -band})) {
    stop_if_asked();
    if (lines.spacing <= band)
      infill::fill_solid(
          region, {.band = band, .angle_rad = angle, .origin = lines.origin, .turned = false, .ordered = false}, beads);
    else
      infill::fill_sparse(region,
                          {.pattern = InfillPattern::lines,
                           .density = static_cast<double>(band) / lines.spacing,
                           .band = band,
                           .angle_rad = angle,
                           .z = layer.z,
                           .origin = lines.origin},
                          beads);
  }
  for (Bead& bead : beads) bead.role = lines.role, bead.scope = lines.scope, bead.sequence = 0, bead.part = 0;
  std::move(beads.begin(), beads.end(), std::back_inserter(out));
}

Um nozzle_of_raft(const Settings& settings) {
  return nozzle_of(settings, settings.tools.adhesion_extruder_nr);
}

std::vector<adhesion::RaftLayer> layers_of(const Settings& settings) {
  return adhesion::raft_layers(settings.raft, nozzle_of_raft(settings), settings.layers.layer_height);
}

}  // namespace

PrintedLayers make_raft(const Settings& settings, const RaftScopes& scopes, const OnRaft& standing) {
  const Um nozzle = nozzle_of_raft(settings);
  const auto layers = layers_of(settings);
  // A part at the border stands there on the raft as well: of the beads only what bulges lies beyond the area.
  Um beyond = tolerances::border, widest = 0;
  for (const auto& layer : layers) {
    const Um width = width_of(layer, nozzle);
    beyond = std::max(beyond, tolerances::border + rounded(flow::bulge_um(width, layer.height, 1)));
    widest = std::max(widest, width);
  }
  Regions room = geometry::offset({{print_surface(settings.machine), {}}}, {.by = -beyond});
  Regions no_go;
  for (const Ring& ring : settings.machine.bed_exclude_areas) no_go.push_back({ring, {}});
  if (!no_go.empty()) room = geometry::subtract(room, geometry::offset(geometry::unite(no_go), {.by = beyond}));
  Regions all = standing.parts;
  all.insert(all.end(), standing.support.begin(), standing.support.end());
  const Regions area = adhesion::raft_area(settings.raft, all, room);
  Regions surface = area, open;
  if (!standing.support.empty()) {
    surface = adhesion::raft_area(settings.raft, standing.parts, room);
    open = geometry::subtract(geometry::intersect(geometry::offset(standing.support, {.by = widest}), area), surface);
  }
  const Box box = box_of(area);
  const Point origin = box.empty() ? Point{} : box.centre();
  PrintedLayers out;
  for (const auto& layer : layers) {
    auto& made = out.emplace_back();
    made.z = layer.z, made.height = layer.height;
    const bool across = out.size() % 2 == 0;
    const auto lay = [&](const Regions& under, Um spacing, Role role, ScopeId scope) {
      made.outline.insert(made.outline.end(), under.begin(), under.end());
      lay_raft(layer, under, {nozzle, spacing, across, origin, role, scope}, made.beads);
    };
    if (layer.part == adhesion::RaftPart::surface) {
      lay(surface, layer.spacing, Role::support_interface, scopes.surface);
      lay(open, layer.open_spacing, Role::support, scopes.between);
    } else {
      lay(area, layer.spacing, Role::support, layer.part == adhesion::RaftPart::base ? scopes.base : scopes.between);
    }
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
