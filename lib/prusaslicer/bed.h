// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace weft::prusaslicer {

/// What PrusaSlicer's `bed_shape`, points in mm, is in weft's settings: key and value. Nothing when it is no list of
/// points.
std::optional<std::vector<std::pair<std::string_view, std::string>>> bed_of(std::string_view points);

}  // namespace weft::prusaslicer
