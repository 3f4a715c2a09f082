// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "gcode/writer.h"
#include "pipeline/stages.h"

#include <string>
#include <vector>

namespace weft::pipeline {

/// Pictures of the toolpaths for the head of the file, in the sizes of the setting `thumbnails`; none unless
/// `thumbnail_content` asks for them. They show the G-code itself, which is written for them once more.
/// @param job     without pictures
/// @param packed  the plan's layers with their steps
/// Post: the plan is as it was.
std::vector<gcode::Thumbnail> pictures_of_toolpaths(const gcode::Job& job, PrintPlan& plan,
                                                    const std::vector<std::string>& packed);

}  // namespace weft::pipeline
