// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/plastic.h"

#include "geometry/offset.h"
#include "geometry/outline_length.h"
#include "model/flow.h"
#include "support/column_steps.h"
#include "support/lengths.h"
#include "support/stack.h"

#include <algorithm>

namespace weft::support {
namespace {

/// Loops along rims, as far as there is room for them.
double loops_mm2(const Regions& regions, Um band) {
  double mm2 = 0;
  for (const Region& region : regions) mm2 += std::min(area_mm2(region), geometry::outline_mm(region) * to_mm(band));
  return mm2;
}

}  // namespace

Um usual_band(const SupportSettings& settings, Um nozzle) {
  return flow::band(line_width(settings, nozzle), most_height(settings, nozzle));
}

std::vector<double> column_mm3(const SupportSettings& settings, Um nozzle, const std::vector<double>& shares,
                               const Region& area, Um height) {
  const double mm2 = area_mm2(area);
  const Um line = line_width(settings, nozzle);
  const Point size = box_of(area.outer).size();
  const auto narrow = [&](std::size_t step) {
    const Um half = least_half(settings.support_pattern, line, shares, step);
    return std::min(size.x, size.y) <= 2 * half || geometry::offset({area}, {.by = -half}).empty();
  };
  if (narrow(0)) {
    const double loop_mm2 = std::min(mm2, geometry::outline_mm(area) * to_mm(usual_band(settings, nozzle)));
    return std::vector<double>(shares.size(), to_mm(height) * loop_mm2);
  }
  std::vector<double> out{to_mm(height) * mm2 * shares.front()};
  for (std::size_t step = 1; step < shares.size(); ++step)
    out.push_back(narrow(step) ? out.back() : to_mm(height) * mm2 * shares[step]);
  return out;
}

NearMm2::NearMm2(const SupportSettings& settings, Um nozzle, const std::vector<double>& shares,
                 const std::vector<std::pair<Um, const Regions*>>& carried) {
  const Um line = line_width(settings, nozzle);
  Um depth = first_step(settings);
  for (std::size_t step = 1; step < shares.size(); ++step, depth += settings.gradual_support_infill_step_height)
    steps_.push_back({depth, to_mm(hollow_column(line, shares[step - 1])) +
                                 to_mm(line_distance(settings.support_pattern, line, shares[step])) / 2});
  if (steps_.empty()) return;
  for (const auto& [z, regions] : carried) carried_.push_back({z, area_mm2(*regions), geometry::outline_mm(*regions)});
}

/// What is near under a slope is a strip, and wider by what cells reach beyond it on the side of what is higher.
std::vector<double> NearMm2::at(Um z) const {
  std::vector<double> out;
  for (const Step& step : steps_) {
    double mm2 = 0, round_mm = 0;
    for (const Carried& one : carried_)
      if (one.z >= z && one.z < z + step.depth) mm2 += one.mm2, round_mm = one.round_mm;
    out.push_back(mm2 + round_mm / 2 * step.beside_mm);
  }
  return out;
}

double taken_mm3(const std::vector<double>& by_step, const std::vector<double>& near_mm2, double mm2) {
  double mm3 = by_step.back();
  for (std::size_t step = 0; step + 1 < by_step.size(); ++step)
    mm3 += (by_step[step] - by_step[step + 1]) * std::min(1.0, near_mm2[step] / std::max(mm2, 1e-9));
  return mm3;
}

double plastic_mm3(const SupportSettings& settings, Um nozzle, const Plan& plan) {
  const Um band = usual_band(settings, nozzle);
  const auto shares = column_shares(settings, nozzle, band);
  std::vector<std::pair<Um, const Regions*>> carried;
  for (const SupportLayer& layer : plan.layers)
    if (!layer.carried.empty()) carried.push_back({layer.z, &layer.carried});
  const NearMm2 near(settings, nozzle, shares, carried);
  double mm3 = 0;
  for (const SupportLayer& layer : plan.layers) {
    std::vector<double> by_step(shares.size(), 0);
    for (const Region& column : layer.columns) {
      if (layer.first) {
        mm3 += area_mm2(column) * to_mm(layer.height) * settings.support_initial_layer_density / 100;
        continue;
      }
      const auto own = column_mm3(settings, nozzle, shares, column, layer.height);
      for (std::size_t step = 0; step < own.size(); ++step) by_step[step] += own[step];
    }
    mm3 += taken_mm3(by_step, near.at(layer.z), area_mm2(layer.columns));
    double mm2 =
        area_mm2(layer.roof) + area_mm2(layer.under_roof) * under_roof_share(settings) + area_mm2(layer.bottom);
    mm2 += loops_mm2(layer.branches, band) + loops_mm2(layer.joists.rimmed, band);
    for (const auto* lines : {&layer.joists.lines, &layer.joists.after})
      for (const Polyline& joist : *lines) mm2 += length_of(joist) / 1000 * to_mm(band);
    mm3 += mm2 * to_mm(layer.height);
  }
  return mm3;
}

}  // namespace weft::support
