// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/notice.h"
#include "model/plan.h"
#include "model/sequence.h"
#include "settings/groups/machine.h"
#include "settings/groups/tools.h"

#include <span>
#include <vector>

/// What the user wants at heights: pauses and filament that is changed by hand.
namespace weft::pipeline {

/// What happens before layers begin, beside them; each mark once in every rise.
/// @param notices told of marks above everything that is printed
std::vector<std::vector<Pause>> pauses_of(const ToolSettings& settings, std::span<const TimelineLayer> layers,
                                          Notices& notices);

/// Puts steps before a layer's own, after which the nozzle may be elsewhere and filament drawn back: the way to the
/// first bead and what pushes the filament forward again follow.
void put_before(LayerPlan& layer, std::vector<Step> steps);

/// Filament is drawn back, the printer waits.
void pause_before(LayerPlan& layer, const std::vector<Pause>& pauses);

/// Of each layer, how high what is printed before it reaches.
std::vector<Um> heights_before(const Timeline& timeline, Um z_offset);

/// One object after the other: up over all that stands, and across, before the way down to the next.
/// @param from where the nozzle is  @param standing how high what is printed reaches
void go_over(const MachineSettings& machine, Um standing, Point3 from, LayerPlan& layer);

/// The same from what is purged beside the objects to what follows it: they may stand in between.
void leave_over(const MachineSettings& machine, Um standing, LayerPlan& layer);

}  // namespace weft::pipeline
