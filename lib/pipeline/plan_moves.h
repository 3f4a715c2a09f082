// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "contour/contour.h"
#include "gcode/digest.h"
#include "model/statistics.h"
#include "pipeline/collect_figures.h"
#include "pipeline/passes.h"
#include "pipeline/place_heat.h"
#include "pipeline/stages.h"
#include "pipeline/vase.h"
#include "travel/travel.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// From the order of beads to moves: ways, what hangs, what follows a surface, speeds and times.
namespace weft::pipeline {

/// A layer that is done with, until all are.
struct PackedLayer {
  LayerPlan bare;      ///< without steps
  std::string packed;  ///< with them
  gcode::LayerDigest digest;
  Statistics statistics;
  LayerTimes times{};
  std::optional<FiguredLayer> figures{};
};

/// Puts the steps back into a layer that is bare. What else it says is not written to: others read it meanwhile.
void unpack_steps(std::string_view packed, LayerPlan& bare);

/// What the moves of all layers hang on, beside the beads.
struct MovesOf {
  const Scopes& scopes;
  const ToolScopes& tools;
  const Passes& passes;
  const std::vector<std::vector<Pause>>& pauses;  ///< of each layer
  std::vector<Um> standing;                       ///< of each layer, how high what is printed before it reaches
  const Vases& vases;
  std::vector<contour::Standing> standing_on;  ///< what objects with labels look like; empty: nothing follows them
};

struct MovesFor {
  PlanFor use = PlanFor::writing;
  bool with_figures = false;  ///< those of a report
};

/// Ways, speeds and times. What a layer was made of is let go of as it goes.
std::vector<PackedLayer> plan_moves(const MovesOf& of, std::vector<travel::Prepared> prepared,
                                    std::vector<travel::Ordered> ordered, Notices& notices, MovesFor what);

}  // namespace weft::pipeline
