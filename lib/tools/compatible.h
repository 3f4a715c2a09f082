// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/notice.h"
#include "model/tool.h"
#include "settings/settings.h"

#include <string>
#include <vector>

/// Whether what is printed together goes together.
namespace weft::tools {

/// A tool that prints something.
struct ToolInUse {
  ToolId tool = 0;
  Um highest = 0;  ///< of its beads; 0: not known
};

/// How messages call a tool: `T1 (PETG)`.
std::string name_of(const std::vector<Settings>& tools, std::size_t tool);

/// Doubts about the filaments and nozzles of a print. Only tools in use count: a printer may hold more.
/// Doubts are: a nozzle that gets hotter or stays colder for one of its filaments than another of them stands, beds
/// that are to be more than 15 °C apart, filament that is harder than its nozzle, and filament that does not hold on
/// the bed's plate.
/// @throws Error{settings} where a nozzle's filaments differ in diameter by more than a tenth, and where a layer is
/// higher than the nozzle that prints it is wide
Notices compatibility(const std::vector<Settings>& tools, const std::vector<ToolInUse>& in_use);

}  // namespace weft::tools
