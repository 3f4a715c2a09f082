// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/plan.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace weft {

double speed_between(const Travel& travel, Point3 a, Point3 b) {
  if (a.z == b.z || travel.z_speed_mm_s <= 0) return travel.speed_mm_s;
  const double up = std::abs(static_cast<double>(b.z) - a.z);
  const double along = std::sqrt(static_cast<double>(distance2(flat(a), flat(b))) + up * up);
  return std::min(travel.speed_mm_s, travel.z_speed_mm_s * along / up);
}

Point3 end_of(const LayerPlan& layer, Point3 before) {
  std::optional<Point3> end;
  const overloaded look{
      [&](const Extrude& bead) {
        if (!bead.path.empty()) end = place_of(bead, bead.path.size() - 1, layer.z);
      },
      [&](const Travel& travel) {
        if (!travel.path.empty()) end = travel.path.back();
      },
      [&](const Retract& retract) {
        if (!retract.wipe.empty()) end = Point3{retract.wipe.back().x, retract.wipe.back().y, layer.z};
      },
      [&](const Feed& feed) {
        if (feed.moves) end = Point3{feed.to.x, feed.to.y, layer.z};
      },
      LeavesAlone<Prime, SetFan, ObjectStart, ObjectEnd, ToolChange, SetTemperature, Pause, SetPressureAdvance>{}};
  for (auto step = layer.steps.rbegin(); step != layer.steps.rend() && !end; ++step) std::visit(look, *step);
  return end.value_or(before);
}

}  // namespace weft
