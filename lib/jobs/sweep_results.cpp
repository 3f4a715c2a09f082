// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/sweep.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <nlohmann/json.hpp>

namespace weft::jobs {

double strength_estimate(const Record& record, const Settings& settings) {
  const auto report = nlohmann::json::parse(record.line, nullptr, false);
  if (report.is_discarded() || !report.contains("features") || !report.contains("models")) return 0;
  double outline_mm3 = 0;
  for (const auto& model : report["models"]) outline_mm3 += std::abs(model.value("volume_mm3", 0.0));
  double solid_mm3 = 0, sparse_mm3 = 0;
  for (const auto& [name, feature] : report["features"].items()) {
    if (name == "skirt" || name == "brim" || name.starts_with("support") || name == "wipe_tower") continue;
    (name == "infill" ? sparse_mm3 : solid_mm3) += feature.value("mm3", 0.0);
  }
  const double density = settings.infill.infill_sparse_density / 100;
  if (outline_mm3 <= 0) return 0;
  const double room_mm3 = density > 0 ? sparse_mm3 / density : 0;  // where the sparse infill stands
  const bool stretched = settings.infill.infill_pattern == InfillPattern::triangles;
  double bears = stretched ? density : std::pow(density, 1.5);
  // what Gibson and Ashby leave the pattern of the plastic's stiffness: two directions in the plane and one up
  if (const auto infill = report.find("infill"); infill != report.end() && infill->contains("stiffness_percent")) {
    const auto& stiffness = (*infill)["stiffness_percent"];
    bears = (2 * stiffness.value("plane", 0.0) + stiffness.value("z", 0.0)) / 300;
  }
  return std::clamp(100 * (solid_mm3 + room_mm3 * bears) / outline_mm3, 0.0, 100.0);
}

void mark_best(std::vector<Trial>& trials) {
  // Compared as the page shows them: a hundredth of a second is no reason to prefer one.
  const auto figures = [](const Trial& t) {
    return std::array{std::round(t.time_s), std::round(t.material_g * 100), -std::round(t.strength * 10)};
  };
  for (auto& t : trials) {
    const auto mine = figures(t);
    t.best = t.ok && std::none_of(trials.begin(), trials.end(), [&](const Trial& other) {
               const auto theirs = figures(other);
               bool no_worse = other.ok, better = false;
               for (std::size_t i = 0; i < mine.size(); ++i)
                 no_worse &= theirs[i] <= mine[i], better |= theirs[i] < mine[i];
               return no_worse && better;
             });
  }
}

}  // namespace weft::jobs
