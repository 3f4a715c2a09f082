// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "gcode/writer.h"
#include "plate/plate.h"

#include <vector>

namespace weft::pipeline {

/// Pictures for the head of the file, in the sizes of the setting `thumbnails`.
std::vector<gcode::Thumbnail> thumbnails_of(const Settings& settings, const Plate& plate);

}  // namespace weft::pipeline
