// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/notice.h"
#include "model/area.h"
#include "plate/plate.h"
#include "settings/groups/layers.h"
#include "slice/slice.h"

#include <vector>

namespace weft::pipeline {

/// Layers where holes begin over wider ones are changed so that nothing of them hangs (slice/counterbore.h).
/// @param layers, areas of the object, beside each other; parts that touch have no hole between them
/// @param line what hangs, where so much has nothing below
/// @param notices get "counterbore_holes_closed" where holes are to be drilled out, with the first one's place
void bridge_counterbores(CounterboreHoleBridging how, Um line, const Object& object, std::vector<slice::Cut>& layers,
                         std::vector<Areas>& areas, Notices& notices);

}  // namespace weft::pipeline
