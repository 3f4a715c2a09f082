// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/plan.h"
#include "plate/plate.h"

#include <vector>

namespace weft::pipeline {

/// What firmware is told of each copy, object by object: no two of them have one name.
std::vector<ObjectLabel> labels_of(const Plate& plate);

}  // namespace weft::pipeline
