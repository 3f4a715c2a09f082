// SPDX-License-Identifier: GPL-3.0-or-later
#include "adhesion/raft.h"

#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "model/flow.h"

#include <algorithm>

namespace weft::adhesion {
namespace {

constexpr Um arc_tolerance = 25;  // a raft needs no finer corners

}  // namespace

std::vector<RaftLayer> raft_layers(const RaftSettings& settings, Um nozzle, Um layer_height) {
  std::vector<RaftLayer> out;
  Um z = 0;
  const auto add = [&](RaftPart part, Um height, Um spacing, Um open_spacing) {
    z += height;
    out.push_back({part, z, height, spacing, open_spacing});
  };
  const Um base = settings.raft_base_thickness.value_or(nozzle * 3 / 4);
  const auto band_at = [&](Um height) { return flow::band(flow::automatic_width(nozzle, height), height); };
  const Um at_base = settings.raft_base_line_spacing.value_or(band_at(base) * 10 / 9);
  add(RaftPart::base, base, at_base, at_base);
  const auto open_at = [&](Um height) { return settings.raft_interface_line_spacing.value_or(2 * band_at(height)); };
  const Um between = settings.raft_interface_thickness.value_or(nozzle * 6 / 10);
  for (int i = 0; i < settings.raft_interface_layers; ++i)
    add(RaftPart::between, between, open_at(between), open_at(between));
  const Um surface = settings.raft_surface_thickness.value_or(layer_height);
  const Um at_surface = settings.raft_surface_line_spacing.value_or(0);
  for (int i = 0; i < settings.raft_surface_layers; ++i)
    add(RaftPart::surface, surface, at_surface, std::max(at_surface, open_at(surface)));
  return out;
}

Regions raft_area(const RaftSettings& settings, const Regions& standing, const Regions& room) {
  Regions out = geometry::offset(
      standing, {.by = settings.raft_margin, .corner = geometry::Corner::round, .arc_tolerance = arc_tolerance});
  if (settings.raft_smoothing > 0) out = geometry::closing(out, settings.raft_smoothing);
  return geometry::intersect(out, room);
}

}  // namespace weft::adhesion
