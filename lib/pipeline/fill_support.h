// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/stages.h"
#include "support/support.h"

namespace weft::pipeline {

/// The beads of a layer of support.
/// @param origin where patterns are anchored: one point for all layers
PrintedLayer fill_support(const Settings& settings, const support::SupportLayer& layer, Point origin);

}  // namespace weft::pipeline
