// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/passes.h"

#include <span>
#include <vector>

/// Where objects are printed one after the other, tools change when the next begins on the bed: what is purged lies
/// side by side on the bed as well, in one section that is as high as the first layer, and no tower rises that the head
/// would have to pass.
namespace weft::pipeline {

/// Does another object begin on the bed once one is done?
bool one_at_a_time(std::span<const travel::LayerInput> layers);

/// Lays the pad where it is told to, else where neither what stands there nor the head is in the way of what has been
/// printed by then.
/// Post: passes.tower is one section, or none where nothing is purged
/// @throws Error{settings} where a tool changes above the first layer; Error{audit} where there is no room, or the head
/// hits what stands already
void lay_pad(const Settings& plate, const std::vector<Settings>& tools, std::span<const travel::LayerInput> layers,
             Passes& passes);

}  // namespace weft::pipeline
