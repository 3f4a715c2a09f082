// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/tool_scopes.h"
#include "tools/tower.h"
#include "travel/travel.h"

#include <optional>
#include <span>
#include <vector>

/// A layer is printed in passes, one a tool. With one tool each layer is its only pass, as it was.
namespace weft::pipeline {

/// What is printed without a change of the tool.
struct ToolPass {
  std::size_t layer = 0;
  ToolId tool = any_tool;
  bool changes = false;        ///< the tool is loaded before it
  std::optional<ToolId> from;  ///< … when this one is; none: the first of the print
  bool last_of_from = false;   ///< which prints nothing after that
};

/// All layers of a plate.
struct Passes {
  std::vector<ToolPass> passes;          ///< in the order they are printed
  std::vector<std::size_t> begin;        ///< of each layer its first pass, and one more for the end
  std::vector<tools::TowerLayer> tower;  ///< sections of the tower, upwards; empty: there is none
  std::vector<std::size_t> section_of;   ///< layer of each section
  tools::TowerSize size;
  Point corner;

  bool has_tower() const { return !tower.empty(); }
};

/// Which tools print when. Beads of any tool go with the first of their layer; those above a height of
/// tool_change_at_heights with its tool.
/// @param layers their beads are given their tools
/// @throws Error{audit} where the tower leaves the print surface or has no room on it
Passes passes_of(const Settings& plate, ToolScopes& tools, Scopes& scopes, std::span<travel::LayerInput> layers,
                 Notices& notices);

/// The layers as they are printed: one input a pass, the tower's beads before the others.
std::vector<travel::LayerInput> split(const Passes& passes, const Settings& plate, ToolScopes& tools, Scopes& scopes,
                                      std::vector<travel::LayerInput> layers);

/// What is done before a pass: the tool is changed, and its nozzle heated.
/// @param first_layer of the print
std::vector<Step> change_before(const ToolPass& pass, const ToolScopes& tools, bool first_layer);

}  // namespace weft::pipeline
