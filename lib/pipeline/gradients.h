// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/tool_scopes.h"
#include "travel/travel.h"

#include <span>

/// Objects whose filament changes along an axis.
namespace weft::pipeline {

/// Gives the beads of objects with gradient_tools one of the two. By lines: in every twentieth of the gradient the
/// volume that the second tool is short of, or has had too much, is carried from bead to bead and from layer to layer;
/// a bead that is shorter than 5 mm goes with the one before. Along x and y beads are cut to pieces of 5 to 10 mm
/// first. By layers: likewise, a layer at a time. By stripes: beads are cut at the borders (pipeline/stripes.h).
/// Source: error diffusion, R. W. Floyd, L. Steinberg, "An adaptive algorithm for spatial greyscale", 1976.
/// @param layers in the order of the print
/// Post: the second tool's volume is off its share by no more than half a bead, or layer, in each twentieth.
void apply_gradients(ToolScopes& tools, Scopes& scopes, std::span<travel::LayerInput> layers);

}  // namespace weft::pipeline
