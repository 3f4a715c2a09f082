#include "model/plan.h"

#include <algorithm>
#include <cmath>

namespace weft {

double speed_between(const Travel& travel, Point3 a, Point3 b) {
  if (a.z == b.z || travel.z_speed_mm_s <= 0) return travel.speed_mm_s;
  const double up = std::abs(static_cast<double>(b.z) - a.z);
  const double along = std::sqrt(static_cast<double>(distance2(flat(a), flat(b))) + up * up);
  return std::min(travel.speed_mm_s, travel.z_speed_mm_s * along / up);
}

Point3 end_of(const LayerPlan& layer, Point3 before) {
  for (auto step = layer.steps.rbegin(); step != layer.steps.rend(); ++step) {
    if (const auto* extrude = std::get_if<Extrude>(&*step); extrude && !extrude->path.empty())
      return place_of(*extrude, extrude->path.size() - 1, layer.z);
    if (const auto* travel = std::get_if<Travel>(&*step); travel && !travel->path.empty()) return travel->path.back();
    if (const auto* retract = std::get_if<Retract>(&*step); retract && !retract->wipe.empty())
      return {retract->wipe.back().x, retract->wipe.back().y, layer.z};
  }
  return before;
}

}  // namespace weft
