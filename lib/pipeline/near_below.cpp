// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/near_below.h"

#include "geometry/boolean.h"
#include "geometry/clip_lines.h"
#include "model/flow.h"
#include "support/column_steps.h"
#include "support/lengths.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::pipeline {
namespace {

Um floor_div(Um v, Um by) {
  return v >= 0 ? v / by : -((-v + by - 1) / by);
}

Regions turned(Regions regions, double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  const auto turn = [&](Ring& ring) {
    for (Point& p : ring) p = {rounded(p.x * c - p.y * s), rounded(p.x * s + p.y * c)};
  };
  for (Region& region : regions) {
    turn(region.outer);
    std::for_each(region.holes.begin(), region.holes.end(), turn);
  }
  return regions;
}

}  // namespace

ColumnShares shares_of_columns(const Settings& settings) {
  const Um nozzle = settings.machine.nozzle_diameter, line = support::line_width(settings.support, nozzle);
  const Um band = std::max<Um>(flow::band(line, settings.layers.layer_height), 1);
  return {support::column_shares(settings.support, nozzle, band), band};
}

Um NearBelow::Grid::row_of(Um y) const {
  return floor_div(y, apart);
}
Um NearBelow::Grid::column_of(Um x) const {
  return floor_div(x - first, wide);
}

/// The cells of which an area comes nearer than the margin: beside what is carried there is room for lines.
NearBelow::Cells NearBelow::Grid::met_by(const Regions& area) const {
  Cells out;
  if (area.empty()) return out;
  const Regions around = support::grown(turned(moved(area, -origin), -angle_rad), margin);
  const Box box = box_of(around);
  constexpr int lines_by_cell = 4;
  std::vector<Polyline> lines;
  for (Um row = row_of(box.min.y); row <= row_of(box.max.y); ++row)
    for (int i = 0; i < lines_by_cell; ++i) {
      const Um y = row * apart + (2 * i + 1) * apart / (2 * lines_by_cell);
      lines.push_back({{box.min.x - 1, y}, {box.max.x + 1, y}});
    }
  for (const auto& piece : geometry::clip_lines(lines, around)) {
    const auto [from, to] = std::minmax(piece.line.front().x, piece.line.back().x);
    for (Um column = column_of(from); column <= column_of(to); ++column)
      out.push_back({row_of(piece.line.front().y), column});
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

/// Wider by half a bead: beads along its edge, which keep half a bead off it, lie on the lines below along that.
Regions NearBelow::Grid::area_of(const Cells& cells) const {
  std::vector<Ring> rings;
  for (std::size_t i = 0; i < cells.size();) {
    std::size_t end = i + 1;  // of cells side by side
    while (end < cells.size() && cells[end] == Cell{cells[i].row, cells[end - 1].column + 1}) ++end;
    const Um low = cells[i].row * apart - half_band, high = (cells[i].row + 1) * apart + half_band;
    const Um left = first + cells[i].column * wide - 1, right = first + (cells[end - 1].column + 1) * wide + 1;
    rings.push_back({{left, low}, {right, low}, {right, high}, {left, high}});
    i = end;
  }
  if (rings.empty()) return {};
  return moved(turned(geometry::regions_from_rings(rings), angle_rad), origin);
}

NearBelow::NearBelow(const Settings& settings, const std::vector<support::SupportLayer>& layers,
                     const ColumnShares& of_columns, Point origin) {
  const auto& s = settings.support;
  const auto& [shares, band] = of_columns;
  if (shares.size() < 2 ||
      std::all_of(layers.begin(), layers.end(), [](const auto& layer) { return layer.carried.empty(); }))
    return;
  Um depth = support::first_step(s);
  for (std::size_t step = 1; step < shares.size(); ++step) {
    const Um above = support::line_distance(s.support_pattern, band, shares[step - 1]);
    const double turns = s.support_infill_angle / 180 + static_cast<double>(step) / 2;
    find({.angle_rad = turns * std::numbers::pi,
          .apart = support::line_distance(s.support_pattern, band, shares[step]),
          .wide = 2 * above,
          .first = above / 2,
          .origin = origin,
          .margin = support::hollow_column(band, shares[step - 1]),
          .half_band = band / 2},
         layers, depth);
    depth += s.gradual_support_infill_step_height;
  }
}

/// @param depth  that what is near lies below what is carried
void NearBelow::find(const Grid& grid, const std::vector<support::SupportLayer>& layers, Um depth) {
  const auto met = tasks::parallel_map(layers.size(), [&](std::size_t k) { return grid.met_by(layers[k].carried); });
  Step& step = steps_.emplace_back();
  std::vector<Cells> all;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    Cells near;
    for (std::size_t j = k; j < layers.size() && layers[j].z < layers[k].z + depth; ++j)
      near.insert(near.end(), met[j].begin(), met[j].end());
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    if (all.empty() || all.back() != near) all.push_back(std::move(near));
    step.of_layer.push_back(all.size() - 1);
  }
  step.areas = tasks::parallel_map(all.size(), [&](std::size_t i) { return grid.area_of(all[i]); });
}

NearSteps NearBelow::on(std::size_t layer) const {
  NearSteps out;
  for (const Step& step : steps_) out.push_back(step.areas[step.of_layer[layer]]);
  return out;
}

NearSteps NearBelow::around(std::size_t layer, const Region& column) const {
  NearSteps out;
  const Box box = box_of(column.outer);
  for (const Step& step : steps_) {
    Regions& near = out.emplace_back();
    for (const Region& region : step.areas[step.of_layer[layer]])
      if (box_of(region.outer).overlaps(box)) near.push_back(region);
  }
  return out;
}

bool NearBelow::are_alike(std::size_t layer, std::size_t other) const {
  return std::all_of(steps_.begin(), steps_.end(),
                     [&](const Step& step) { return step.of_layer[layer] == step.of_layer[other]; });
}

Regions NearBelow::begun(std::size_t layer, std::size_t other) const {
  Regions out;
  for (const Step& step : steps_)
    if (step.of_layer[layer] != step.of_layer[other])
      support::append(out, geometry::subtract(step.areas[step.of_layer[layer]], step.areas[step.of_layer[other]]));
  return out;
}

}  // namespace weft::pipeline
