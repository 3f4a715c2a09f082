// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// What a program that embeds weft includes.
///
///   weft::Profile profile;
///   weft::apply_file(profile, "printer.ini");
///   weft::Job job{.models = {"part.stl"}, .settings = profile.settings};
///   weft::Report report;
///   if (auto gcode = weft::run(job, {}, report)) weft::write_gcode("part.gcode", *gcode);
///
/// Everything else below this folder may change without notice.

#include "pipeline/pipeline.h"
#include "profile/profile.h"
