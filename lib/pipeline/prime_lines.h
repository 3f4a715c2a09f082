// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/passes.h"

#include <span>

/// Lines at the front of the bed that nozzles are primed with.
namespace weft::pipeline {

/// Gives every tool that prints a line to and fro, before all else that it lays down in the first layer: as far in
/// front as there is room beside what stands on the bed, skirt and brim too. Where there is none, that is told. Pre:
/// the first layer has a pass of each of them (passes_of sees to that)
void add_prime_lines(const Settings& plate, ToolScopes& tools, Scopes& scopes, const Passes& passes,
                     std::span<travel::LayerInput> layers, Notices& notices);

}  // namespace weft::pipeline
