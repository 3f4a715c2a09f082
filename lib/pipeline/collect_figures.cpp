// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/collect_figures.h"

#include "slice/heights.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace weft::pipeline {
namespace {

constexpr std::size_t most_places = 20;

/// The most that lies within ± 5 % of one speed. Bins are of 1 %.
double most_within(const std::map<int, double>& by_speed) {
  constexpr int wide = 10;
  double most = 0;
  for (const auto& [from, mm] : by_speed) {
    double sum = 0;
    for (auto at = by_speed.lower_bound(from); at != by_speed.end() && at->first <= from + wide; ++at)
      sum += at->second;
    most = std::max(most, sum);
  }
  return most;
}

}  // namespace

double FigureSum::least_rest_s(const std::vector<motion::CellTime>& cells, double layer_s) {
  double least = 0;
  for (std::size_t i = 0, k = 0; i < cells.size() && k < below_.size();) {
    if (cells[i].cell < below_[k].cell) {
      ++i;
    } else if (below_[k].cell < cells[i].cell) {
      ++k;
    } else {
      const double rest = below_s_ - static_cast<double>(below_[k].last_s) + static_cast<double>(cells[i].first_s);
      if (least == 0 || rest < least) least = rest;
      ++i, ++k;
    }
  }
  below_s_ = layer_s;
  return least;
}

void FigureSum::add(Um z, FiguredLayer layer, const Statistics& statistics) {
  auto& m = layer.motion;
  const double s = statistics.print_time_s, below_s = below_s_;
  Figures::Layer out{to_mm(z), s, 1, 100 * m.fan, layer.unsupported_mm2, layer.longest_span_mm, 0};
  if (!out_.layers.empty() && below_s > 0) out.ratio = s / below_s;
  out.least_rest_s = least_rest_s(m.cells, s);
  out_.layers.push_back(out);
  below_ = std::move(m.cells);
  if (out_.flow_s.size() < m.flow_s.size()) out_.flow_s.resize(m.flow_s.size());
  for (std::size_t i = 0; i < m.flow_s.size(); ++i) out_.flow_s[i] += m.flow_s[i];
  for (const auto& [bin, mm] : m.outer_wall_mm) outer_wall_mm_[bin] += mm;
  for (const auto& place : m.thin) out_.thin.push_back({{to_mm(place.at.x), to_mm(place.at.y), to_mm(z)}, place.mm});
  const auto more = [](const Figures::Thin& a, const Figures::Thin& b) { return a.mm > b.mm; };
  std::stable_sort(out_.thin.begin(), out_.thin.end(), more);
  out_.thin.resize(std::min(out_.thin.size(), most_places));
  out_.thin_mm += m.thin_mm;
  printed_mm_ += m.printed_mm, moving_s_ += m.moving_s, accelerating_s_ += m.accelerating_s;
  at_limit_s_ += m.at_limit_s, speed_changes_ += m.speed_changes;
  const auto& ironing = statistics.features[static_cast<std::size_t>(Role::ironing)];
  if (ironing.s <= 0) return;
  const double mm3_s = ironing.mm3 / ironing.s;
  out_.longest_ironing_s = std::max(out_.longest_ironing_s, ironing.s);
  if (out_.least_ironing_mm3_s == 0 || mm3_s < out_.least_ironing_mm3_s) out_.least_ironing_mm3_s = mm3_s;
}

void FigureSum::finish() {
  const double printing_s = std::accumulate(out_.flow_s.begin(), out_.flow_s.end(), 0.0);
  if (printing_s > 0) out_.at_limit_percent = 100 * at_limit_s_ / printing_s;
  if (moving_s_ > 0) out_.accelerating_percent = 100 * accelerating_s_ / moving_s_;
  if (printed_mm_ > 0) out_.speed_changes_per_m = 1000 * static_cast<double>(speed_changes_) / printed_mm_;
  double outer_mm = 0;
  for (const auto& [bin, mm] : outer_wall_mm_) outer_mm += mm;
  if (outer_mm > 0) out_.even_outer_percent = 100 * most_within(outer_wall_mm_) / outer_mm;
}

void tell_surface(const Plate& plate, const std::vector<PrintedLayers>& layers, Figures& out) {
  slice::Surface all;
  for (std::size_t o = 0; o < plate.objects.size(); ++o) {
    std::vector<const Mesh*> meshes;
    for (const auto& volume : plate.objects[o].volumes)
      if (volume.kind == VolumeKind::model) meshes.push_back(&volume.mesh);
    std::vector<LayerHeight> heights;
    for (const auto& layer : layers[o]) heights.push_back({layer.z, layer.height});
    all.add(slice::surface_of(meshes, heights));
  }
  if (all.mm2 > 0) out.mean_cusp_um = all.cusp_um_mm2 / all.mm2;
  out.faces = all.faces;
  if (all.faces > 0) out.faces_missed_um = all.missed_um / static_cast<double>(all.faces);
}

}  // namespace weft::pipeline
