// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/stages.h"
#include "support/support.h"

namespace weft::pipeline {

/// The beads of layers of support. Columns that are the same on several layers are filled once.
/// @param origin where patterns are anchored: one point for all layers
std::vector<PrintedLayer> fill_support(const Settings& settings, const std::vector<support::SupportLayer>& layers,
                                       Point origin);

}  // namespace weft::pipeline
