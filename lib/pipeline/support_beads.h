// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/bead.h"
#include "pipeline/layer_plastic.h"
#include "pipeline/near_below.h"
#include "settings/settings.h"
#include "support/support.h"

#include <vector>

namespace weft::pipeline {

/// The beads of a layer of support.
struct SupportBeads {
  Beads beads;
  std::vector<Point> hang_at;  ///< places where roofs have nothing below
};

/// A layer of support that is to be filled.
struct SupportToFill {
  const Settings& settings;
  const support::SupportLayer& layer;
  Point origin;  ///< where patterns are anchored: one point for all layers
};

/// A column without walls: hollow where it is narrow.
/// @param near  where it is how near below what it carries
Beads fill_column(const SupportToFill& what, const Region& column, const NearSteps& near);
/// A layer's columns, which have walls.
Beads fill_walled_columns(const SupportToFill& what, const NearSteps& near);
/// The strands across a layer's columns that a roof lies on.
Beads fill_under_roof(const SupportToFill& what);
/// What a layer's beads are told of the layers beside it.
struct BesideLayer {
  LayerPlastic below;  ///< what the layer lies on, where it has a roof
  LayerPlastic above;  ///< what lies on it, where it has feet
};
/// @param columns  what became of the layer's, with what a roof lies on
SupportBeads fill_support_layer(const SupportToFill& what, Beads columns, const BesideLayer& beside);

}  // namespace weft::pipeline
