// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/notice.h"
#include "settings/scopes.h"
#include "travel/travel.h"

#include <span>
#include <vector>

namespace weft::pipeline {

/// Skirt and brim around everything that rises together, put before the other beads of their layers. Copies may have
/// brims of their own.
/// @param feet  the settings of what each copy stands on; empty: all are as the plate has it
/// @param others what tower, ooze shield and raft cover
void add_adhesion(const Scopes& scopes, const std::vector<ScopeId>& feet, std::span<travel::LayerInput> layers,
                  const Regions& others, Notices& notices);

}  // namespace weft::pipeline
