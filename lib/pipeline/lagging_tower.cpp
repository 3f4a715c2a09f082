// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/lagging_tower.h"

#include "core/convex_hull.h"
#include "core/error.h"
#include "geometry/boolean.h"
#include "pipeline/one_at_a_time.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

/// Where a slab of the head may be while the nozzle is over the tower: the hull.
Ring swept(const Ring& tower, const Ring& slab) {
  std::vector<Point> corners;
  for (const Point a : tower)
    for (const Point b : slab) corners.push_back(a + b);
  return convex_hull(std::move(corners));
}

/// The first section that is printed in layer i or above it; nothing: the tower is done.
std::optional<std::size_t> section_after(const Passes& passes, std::size_t i) {
  const auto at = std::lower_bound(passes.section_of.begin(), passes.section_of.end(), i);
  if (at == passes.section_of.end()) return std::nullopt;
  return static_cast<std::size_t>(at - passes.section_of.begin());
}

bool is_tower(const Step& step) {
  const auto* bead = std::get_if<Extrude>(&step);
  return bead != nullptr && bead->role == Role::wipe_tower;
}

/// Does the nozzle go down there behind the step: is a bead of the tower the next that is laid?
bool tower_follows(const std::vector<Step>& steps, std::size_t i) {
  for (++i; i < steps.size(); ++i)
    if (std::holds_alternative<Extrude>(steps[i])) return is_tower(steps[i]);
  return false;
}

}  // namespace

void check_lag(const Settings& plate, const Passes& passes, std::span<const travel::LayerInput> layers) {
  const auto lags = [&](std::size_t k) { return layers[passes.section_of[k]].z > passes.tower[k].z; };
  bool any = false;
  for (std::size_t k = 0; k < passes.tower.size(); ++k) any = any || lags(k);
  if (!any) return;
  const auto head = head_of(plate.plate, plate.machine);
  if (head.empty())
    throw Error{Error::Kind::settings,
                "the nozzle goes down to the tower beside what is printed, and machine_head_profile "
                "does not say how wide the head is",
                "prime_tower_sparse",
                "as in 0: -10x-10, 10x-10, 10x10, -10x10; 12: -30x-25, 45x-25, 45x60, -30x60; or true"};
  const auto tower = tools::tower_outline(plate.tools, passes.size, passes.corner);
  for (const auto& slab : head) {
    const Regions there{{swept(tower, slab.outline), {}}};
    for (std::size_t i = 0; i < layers.size(); ++i) {
      const auto k = section_after(passes, i);
      if (!k || layers[i].z <= passes.tower[*k].z + slab.from) continue;
      for (const auto& object : layers[i].objects)
        if (!geometry::intersect(object.outline, there).empty())
          throw Error{
              Error::Kind::audit,
              fmt::format("prime_tower_sparse: when the nozzle goes down to the tower at z {:.2f}, the head hits "
                          "what is printed at z {:.2f}",
                          to_mm(passes.tower[*k].z), to_mm(layers[i].z)),
              {},
              "prime_tower_sparse = true, or a tower farther away (prime_tower_position_x, _y)"};
    }
  }
}

void lower_tower(Um lag, LayerPlan& plan) {
  if (lag <= 0) return;
  bool low = false;
  std::optional<Point> at;
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    if (auto* bead = std::get_if<Extrude>(&plan.steps[i]); bead != nullptr && !bead->path.empty()) {
      if (is_tower(plan.steps[i])) bead->below.assign(bead->path.size(), lag);
      at = bead->path.back().at;
      low = is_tower(plan.steps[i]);
    }
    auto* travel = std::get_if<Travel>(&plan.steps[i]);
    if (travel == nullptr || travel->path.empty()) continue;
    const bool goes_low = tower_follows(plan.steps, i);
    if (low && goes_low)
      for (Point3& p : travel->path) p.z -= lag;
    if (low && !goes_low && at) travel->path.insert(travel->path.begin(), {at->x, at->y, plan.z});
    if (!low && goes_low) travel->path.push_back({travel->path.back().x, travel->path.back().y, plan.z - lag});
    at = flat(travel->path.back());
    low = goes_low;
  }
}

}  // namespace weft::pipeline
