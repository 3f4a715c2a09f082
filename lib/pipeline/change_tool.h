// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/passes.h"

#include <optional>
#include <vector>

/// What is done between two passes.
namespace weft::pipeline {

/// Does what the file says draw filament out of the nozzle, and push other in?
bool swaps_filament(const std::vector<Settings>& tools, const ToolPass& pass);

/// What is laid on the tower by the tool before, at a pace of its own: the tip of its filament is shaped, or a nozzle
/// that is put away is emptied of what has been hot for long. mm³; 0: nothing
double rammed_mm3(const std::vector<Settings>& tools, const ToolPass& pass);

/// The tool is changed over the tower (or infill that is purged into), where what oozes does no harm: the nozzle goes
/// there, lays what is to be rammed, is drawn back, changed, and waited for. A nozzle that firmware puts other filament
/// in is not drawn back: it loads as far as the tip.
/// @param index of the pass
/// @param layer that it is of; its steps are not looked at
/// @param from where the nozzle is; nothing: that is not known, and the layer begins
std::vector<Step> change_before(const Passes& passes, std::size_t index, const ToolScopes& tools,
                                const LayerPlan& layer, const std::optional<Point3>& from);

/// Where the steps of a layer end; nothing: there are none that go anywhere.
std::optional<Point3> place_behind(const LayerPlan& layer);

}  // namespace weft::pipeline
