// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/ironing.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace weft::pipeline {

void tell_slow_ironing(std::span<const IronedLayer> layers, Notices& notices) {
  constexpr double long_s = 180, slow_mm3_s = 0.1;
  const IronedLayer* worst = nullptr;
  for (const auto& layer : layers) {
    const auto& own = layer.ironing;
    if (own.s > long_s && own.mm3 < slow_mm3_s * own.s && (worst == nullptr || own.s > worst->ironing.s))
      worst = &layer;
  }
  if (worst == nullptr) return;
  const auto& own = worst->ironing;
  notices.push_back(
      {"ironing_slow",
       fmt::format("ironing_enabled: at z {:.3f} the nozzle irons for {:.0f} minutes at {:.3f} mm³/s: filament that "
                   "stands in the melt so long may clog; a larger ironing_flow, ironing_line_spacing or speed_ironing "
                   "is quicker through it",
                   to_mm(worst->z), own.s / 60, own.mm3 / own.s)});
}

bool primes_after_ironing(const Scopes& scopes) {
  for (std::size_t i = 0; i < scopes.size(); ++i)
    if (scopes[static_cast<ScopeId>(i)].shells.ironing_prime > 0) return true;
  return false;
}

void prime_after_ironing(const Scopes& scopes, LayerPlan& layer, double& owed_mm3) {
  std::vector<Step> steps;
  steps.reserve(layer.steps.size() + 1);
  for (Step& step : layer.steps) {
    if (auto* prime = std::get_if<Prime>(&step)) prime->extra_mm3 = std::exchange(owed_mm3, 0);
    if (const auto* bead = std::get_if<Extrude>(&step)) {
      if (bead->role == Role::ironing)
        owed_mm3 = scopes[bead->scope].shells.ironing_prime;
      else if (owed_mm3 > 0)
        steps.emplace_back(Prime{std::exchange(owed_mm3, 0)});
    }
    steps.push_back(std::move(step));
  }
  layer.steps = std::move(steps);
}

}  // namespace weft::pipeline
