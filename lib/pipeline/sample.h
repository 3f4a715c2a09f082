// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "model/statistics.h"

#include <array>
#include <cstddef>

/// Layers that stand for others: an estimate of a print need not lay the beads of every one.
namespace weft::pipeline {

/// Which layers are computed. The first two are always: they are printed at speeds and widths of their own. Of the
/// others one of each `stride` that follow each other, now this one, now that: what alternates from layer to layer
/// (directions of infill, combined infill) is met in each of its forms.
struct Sample {
  static constexpr std::size_t own_kind = 2;  ///< layers at the bottom that stand for themselves only
  std::size_t stride = 1;                     ///< 1: all
  bool all() const { return stride <= 1; }
  bool has(std::size_t layer) const;
};

/// What beads grow with.
enum class Growth : std::uint8_t { walls, sparse, solid, top, bridge, layers };
inline constexpr std::size_t growths = 6;

/// What is known of layers without their beads.
struct LayerMeasure {
  struct Amount {
    double length = 0;  ///< that lengths and times grow with
    double volume = 0;
  };
  std::array<Amount, growths> amounts{};  ///< by Growth
  Amount& operator[](Growth g) { return amounts[static_cast<std::size_t>(g)]; }
  const Amount& operator[](Growth g) const { return amounts[static_cast<std::size_t>(g)]; }
  void add(const LayerMeasure& other, double copies);
};

/// Of all layers above the bottom ones: those that were planned, and those they stand for.
struct SampleMeasure {
  LayerMeasure planned, left_out;
};

/// Has it beads of models?
bool has_beads(const Statistics& layer);

/// What the whole print takes, reckoned from the layers of the sample: each kind of bead in proportion to what it grows
/// with (a ratio estimator: Cochran 1977, "Sampling Techniques", 5.1 and 6.1). What is not of the models, a skirt or
/// support, is taken as it is: it was planned on every layer.
/// @param bottom what the layers that stand for themselves take
/// @param above  what the others take as planned: those outside the sample without the beads of the models
Statistics extrapolated(const Statistics& bottom, const Statistics& above, const SampleMeasure& measure);

}  // namespace weft::pipeline
