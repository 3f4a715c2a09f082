#pragma once
#include "core/polygon.h"
#include "model/statistics.h"

#include <cstddef>
#include <span>
#include <vector>

/// Layers that stand for others: an estimate of a print need not lay the beads of every one.
namespace weft::pipeline {

/// Which layers are computed. The first two are always: they are printed at speeds and widths of their own.
struct Sample {
  static constexpr std::size_t own_kind = 2;  ///< layers at the bottom that stand for themselves only
  std::size_t stride = 1;                     ///< of the others every so manieth; 1: all
  bool all() const { return stride <= 1; }
  bool has(std::size_t layer) const { return all() || layer < own_kind || (layer - own_kind) % stride == stride / 2; }
};

/// What is known of a layer without its beads, over the whole plate: what each kind of bead grows with.
struct LayerMeasure {
  double outline_mm = 0;                                              ///< perimeter of the slice
  double walls_mm3 = 0;                                               ///< about what walls take
  double solid_mm2 = 0, top_mm2 = 0, sparse_mm2 = 0, bridge_mm2 = 0;  ///< areas to be filled
  double height_mm = 0;
  void add(const LayerMeasure& other, double copies);
};

/// What the whole print takes, reckoned from the layers of the sample: each kind of bead in proportion to what it grows
/// with (a ratio estimator: Cochran 1977, "Sampling Techniques", ch. 6). What is not of the models, such as a skirt, is
/// taken as it is: it was planned on every layer.
/// @param layers   what each layer takes as planned: those outside the sample without the beads of the models
/// @param measures one a layer
Statistics extrapolated(const Sample& sample, std::span<const Statistics> layers,
                        std::span<const LayerMeasure> measures);

}  // namespace weft::pipeline
