// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/tool.h"
#include "settings/groups/tools.h"

#include <cstddef>
#include <vector>

/// In which order the tools of each layer follow each other.
namespace weft::tools {

/// What it costs to go from one tool to another, a row for each that is unloaded; 0 on the diagonal.
using Costs = std::vector<std::vector<double>>;

/// The tools of each layer, ascending; none where any tool will do.
using ToolSets = std::vector<std::vector<ToolId>>;

/// The order of each layer's tools.
/// least: no order of all layers together costs less, as long as no layer has more than ten tools; a layer of more is
/// put in order by the nearest tool that is left, and that bettered as long as turning or moving a stretch does. Layer
/// by layer the best way through its tools from each to each is found, and over the layers the cheapest chain of those.
/// Cost: O(layers · 2ⁿ · n³) for n tools in a layer, once for each different set.
/// Source: M. Held, R. Karp, "A dynamic programming approach to sequencing problems", 1962.
/// Post: every layer's tools once each; an empty layer stays empty.
ToolSets ordered(const ToolSets& layers, const Costs& costs, ToolOrder order);

/// What a whole order costs: all changes between tools that follow each other. The first tool costs nothing.
double cost_of(const ToolSets& order, const Costs& costs);

}  // namespace weft::tools
