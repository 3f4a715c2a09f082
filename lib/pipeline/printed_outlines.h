// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/area.h"
#include "pipeline/handed_to.h"
#include "pipeline/stages.h"

#include <vector>

namespace weft::pipeline {

/// Moves outlines to where walls end, where xy_offset and its kin say so: skirt, brim, raft and travels go by what is
/// printed.
/// Post: where nothing moves them they are as they were; in layers of several areas what an offset divides stands
/// behind
///       the others, so that each part keeps its number.
void move_outlines(const HandedTo<Stage::walls>& handed, const Scopes& scopes, const std::vector<Areas>& areas,
                   ResultOf<Stage::slice>& cuts);

}  // namespace weft::pipeline
