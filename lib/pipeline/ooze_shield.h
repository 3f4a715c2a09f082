// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/passes.h"

/// A wall around everything that takes off what oozes from nozzles that wait.
namespace weft::pipeline {

/// What it encloses: the hull of all objects, ooze_shield_dist away. Empty where there is none: it is not asked for, or
/// the tool never changes.
/// @throws Error{audit} where it leaves the print surface
Regions ooze_shield(const Settings& plate, std::span<const travel::LayerInput> layers, const Passes& passes);

/// Puts its wall before the other beads of every layer up to the last change of the tool; on a brim that reaches below
/// it from the second on.
void add_ooze_shield(const Settings& plate, const Regions& shield, const Passes& passes,
                     std::span<travel::LayerInput> layers);

}  // namespace weft::pipeline
