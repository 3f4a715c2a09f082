// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "prusaslicer/import.h"
#include "prusaslicer/import_single.h"
#include "settings/ini.h"

#include <cstddef>
#include <vector>

/// Printers of several extruders. A configuration of theirs holds lists, an element an extruder; a list that is too
/// short says its first element again.
namespace weft::prusaslicer {

/// As many as nozzle_diameter lists; 1 where it is not given.
std::size_t extruders_in(const std::vector<IniEntry>& entries);

/// The configuration as the extruder of that number, from 0, has it: lists of extruders and filaments say its element.
std::vector<IniEntry> of_extruder(std::vector<IniEntry> entries, std::size_t extruder);

/// Tools, what prints what, the tower and what is purged into it, and how a filament is changed.
/// @param lines of one extruder
/// @param whole the configuration with all of its lists
/// @throws Error{settings} with path:line
void import_tools(Lines& lines, const Lines& whole, std::size_t count, const Outlet& out);

/// Adds what another extruder than the first has otherwise, as `tool.1.key`; what holds for all tools is remarked.
void add_differences(std::size_t tool, const Translation& own, Translation& out);

}  // namespace weft::prusaslicer
