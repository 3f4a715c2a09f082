// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/passes.h"

#include <optional>
#include <span>
#include <vector>

/// Where the tower stands.
namespace weft::pipeline {

/// Where the settings say so, and else for filaments that share a nozzle.
bool wants_tower(const Settings& plate, const ToolScopes& tools);

/// The least of those that may print a tower.
Um least_nozzle(const std::vector<Settings>& tools);

/// What a pass wants laid there before it: by the tool before, and by its own.
void add_strips(const std::vector<Settings>& tools, const ToolPass& pass, std::size_t p, tools::TowerLayer& section);

/// What is known before anything is sliced: a tower that is told to stand where not even the smallest has room. What is
/// told is the size of one that has to hold a change to each tool but one in the thinnest layer.
/// @param top of what is printed
/// @throws Error{audit}
void refuse_tower_outside(const Settings& plate, const ToolScopes& tools, Um top);

/// The boxes of what is printed, over all layers, with what lies around it on the bed.
std::vector<Box> standing_on(const Settings& plate, std::span<const travel::LayerInput> layers);

/// Where it is told to stand, else where there is room beside all of these.
/// Pre: its size is known
/// @throws Error{audit} where it leaves the print surface or has no room on it
void place_tower(const Settings& plate, std::vector<Box> standing, Passes& passes);

}  // namespace weft::pipeline
