// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/passes.h"

#include <span>

/// A tower that has only the sections in which something is purged (prime_tower_sparse = false) is lower than what is
/// printed beside it: the nozzle goes down to it.
namespace weft::pipeline {

/// @throws Error{audit} where the head meets what is printed when the nozzle is down there, Error{settings} where
/// nothing is known of the head
void check_lag(const Settings& plate, const Passes& passes, std::span<const travel::LayerInput> layers);

/// Puts beads of the tower down by so much, and the ways to them and from them: straight down over where they begin,
/// straight up before they are left. @param plan of one pass
void lower_tower(Um lag, LayerPlan& plan);

}  // namespace weft::pipeline
