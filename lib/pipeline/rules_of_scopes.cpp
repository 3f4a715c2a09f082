// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/rules_of_scopes.h"

namespace weft::pipeline {

std::vector<motion::Rules> rules_of(const Scopes& scopes) {
  std::vector<motion::Rules> out;
  for (std::size_t i = 0; i < scopes.size(); ++i) {
    const auto id = static_cast<ScopeId>(i);
    out.push_back(motion::rules_of(scopes[id], &scopes[scopes.above_first_layer(id)]));
  }
  return out;
}

std::vector<overhangs::Strand> strands_of(const Scopes& scopes) {
  std::vector<overhangs::Strand> out;
  for (std::size_t i = 0; i < scopes.size(); ++i) {
    const auto& s = scopes[static_cast<ScopeId>(i)];
    out.push_back({s.machine.nozzle_diameter, s.shells.bridge_flow / 100, s.shells.overhang_walls});
  }
  return out;
}

std::vector<contour::Rules> contours_of(const Scopes& scopes) {
  std::vector<contour::Rules> out;
  for (std::size_t i = 0; i < scopes.size(); ++i) {
    const auto& s = scopes[static_cast<ScopeId>(i)];
    out.push_back(
        {s.layers.z_contouring, s.layers.z_contour_min_height, s.machine.machine_nozzle_tip_outer_diameter / 2});
  }
  return out;
}

}  // namespace weft::pipeline
