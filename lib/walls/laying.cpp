// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/laying.h"

#include "core/stop.h"
#include "walls/mitre.h"
#include "walls/planner.h"

#include <utility>

namespace weft::walls {

Laying Planner::run() {
  find_core();
  stop_if_asked();
  cut_at_thresholds();
  stop_if_asked();
  filter();
  stop_if_asked();
  pass_junctions();
  stop_if_asked();
  ramps();
  stop_if_asked();
  for (std::uint32_t e = 0; e < edges_.size(); ++e) set_core_bounds(e);
  run_into_corners();
  out_.spans.reserve(edges_.size());
  for (const Edge& edge : edges_) out_.spans.push_back(edge.span);
  mitre_inner_walls(s_, out_);
  return std::move(out_);
}

Laying lay(Skeleton& skeleton, const Widths& widths, const LayingOptions& options) {
  return Planner(skeleton, widths, options).run();
}

}  // namespace weft::walls
