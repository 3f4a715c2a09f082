// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/statistics.h"
#include "motion/figures.h"
#include "pipeline/figures.h"
#include "pipeline/stages.h"

#include <map>
#include <span>
#include <vector>

namespace weft::pipeline {

/// A layer of a plan, as figures see it.
struct FiguredLayer {
  motion::LayerFigures motion{};
  double unsupported_mm2 = 0, longest_span_mm = 0;
};

/// Puts layers together, upwards.
class FigureSum {
 public:
  explicit FigureSum(Figures& out) : out_(out) {}
  /// @param statistics of the layer alone
  void add(Um z, FiguredLayer layer, const Statistics& statistics);
  void finish();

 private:
  double least_rest_s(const std::vector<motion::CellTime>& cells, double layer_s);

  Figures& out_;
  std::map<int, double> outer_wall_mm_;
  double printed_mm_ = 0, moving_s_ = 0, accelerating_s_ = 0, at_limit_s_ = 0;
  std::size_t speed_changes_ = 0;
  std::vector<motion::CellTime> below_;
  double below_s_ = 0;
};

/// How well the layers of objects meet their surfaces. Pre: the meshes are still there.
void tell_surface(const Plate& plate, const std::vector<PrintedLayers>& layers, Figures& out);

}  // namespace weft::pipeline
