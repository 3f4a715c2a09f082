// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "profile/profile.h"

#include <cstdint>
#include <string_view>

/// When a file is made is no input, so that the same input gives the same bytes: custom G-code that names the time of
/// day has none, but where somebody says which one is meant.
namespace weft::pipeline {

/// Seconds since 1970, UTC, up to the end of the year 9999.
/// Source: reproducible-builds.org, "SOURCE_DATE_EPOCH specification".
/// @throws Error{usage} for anything else
std::int64_t parse_epoch(std::string_view text);

/// Adds to `gcode_variables` what custom G-code and output_filename_format name of that time and no line gives yet:
/// timestamp (20261127-041800, as PrusaSlicer writes it), year, month, day, hour, minute, second; UTC. As a setting the
/// file holds it, and is made again from that byte for byte, at any time.
/// Pre: the settings are consistent
/// @throws Error{settings} for custom G-code that cannot be read
void tell_time(Profile& profile, std::int64_t epoch_s);

}  // namespace weft::pipeline
