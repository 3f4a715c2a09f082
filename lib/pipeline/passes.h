// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/report.h"
#include "pipeline/tool_scopes.h"
#include "tools/tower.h"
#include "travel/travel.h"

#include <array>
#include <map>
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
  double purge_mm3 = 0;        ///< wanted at the change, less what goes into the print (purge_into.h)
};

/// All layers of a plate.
struct Passes {
  std::vector<ToolPass> passes;          ///< in the order they are printed
  std::vector<std::size_t> begin;        ///< of each layer its first pass, and one more for the end
  std::vector<tools::TowerLayer> tower;  ///< sections of the tower, upwards; empty: there is none
  bool pad = false;                      ///< it is one section on the bed (purge_pad.h)
  std::vector<std::size_t> section_of;   ///< of each section the layer that it ends with
  std::map<std::size_t, Um> lag;         ///< by layer: how far below it its section lies
  tools::TowerSize size;
  Point corner;
  Regions shield;  ///< what the ooze shield encloses; empty: there is none
  Report::Purged purged;
  std::map<std::size_t, Beads> into;  ///< by pass: beads that are printed with what is purged before it
  struct Ram {
    Bead line;
    Um height = 0;
  };
  std::map<std::size_t, Ram> ram;  ///< by pass: what the tool before lays something on, at a pace of its own
  std::map<std::size_t, std::array<Point, 2>>
      entry;  ///< by pass: the first piece that is purged, over which tools change

  bool has_tower() const { return !tower.empty(); }
  Um lag_of(std::size_t layer) const {
    const auto at = lag.find(layer);
    return at == lag.end() ? 0 : at->second;
  }
};

/// Which tools print when. Beads of any tool go with the first of their layer; those above a height of
/// tool_change_at_heights with its tool.
/// @param layers their beads are given their tools
/// @param notices told what does not go together (tools/compatible.h)
/// @throws Error{settings} for tools that cannot print together, Error{audit} where the tower leaves the print surface
/// or has no room on it
Passes passes_of(const Settings& plate, ToolScopes& tools, Scopes& scopes, std::span<travel::LayerInput> layers,
                 Notices& notices);

/// The tower and the shield, which skirt and brim go round.
Regions beside_objects(const Settings& plate, const Passes& passes);

/// Skirt and brim, once they are made, are printed with adhesion_extruder_nr.
void give_adhesion(const Settings& plate, ToolScopes& tools, Scopes& scopes, std::span<travel::LayerInput> layers);

/// The layers as they are printed: one input a pass, what is purged before the others.
/// Post: `passes.into` is empty, `passes.ram`, `entry` and `lag` are full.
std::vector<travel::LayerInput> split(Passes& passes, const Settings& plate, ToolScopes& tools, Scopes& scopes,
                                      std::vector<travel::LayerInput> layers);

}  // namespace weft::pipeline
