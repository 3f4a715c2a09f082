#include "walls/laying.h"

#include "walls/planner.h"

#include <utility>

namespace weft::walls {

Laying Planner::run() {
  find_core();
  cut_at_thresholds();
  filter();
  open_needless_mouths();
  pass_junctions();
  ramps();
  for (std::uint32_t e = 0; e < core_.size(); ++e) set_core_bounds(e);
  run_into_corners();
  return std::move(out_);
}

Laying lay(Skeleton& skeleton, const Widths& widths, const LayingOptions& options) {
  return Planner(skeleton, widths, options).run();
}

}  // namespace weft::walls
