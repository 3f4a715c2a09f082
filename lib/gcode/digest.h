// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "model/plan.h"
#include "settings/settings.h"

#include <bitset>
#include <optional>
#include <vector>

/// What the rest of a file must know of a layer, so that its steps need not be there until they are written.
namespace weft::gcode {

/// The machine as the commands up to some place have left it.
struct MachineState {
  std::optional<Point3> at;
  double fan = -1;                                         ///< −1: not said yet
  double print_acceleration = 0, travel_acceleration = 0;  ///< mm/s²; 0: not said yet
  std::optional<double> pressure_advance_s{};              ///< of the tool that is loaded; nothing: not said yet
  ToolId tool = 0;                                         ///< that is loaded
  std::bitset<any_tool + 1U> drawn_back{};                 ///< by tool: is its filament?
  std::bitset<any_tool + 1U> drawn_to_change{};            ///< … so far as for a change
  static constexpr Um from_above = max_coord;              ///< for `z`: at some height over what is printed
  std::optional<Um> z{};             ///< where the nozzle is, as far as that is known before `at` is
  std::optional<double> drawn_mm{};  ///< of filament by start G-code, while it is drawn back; else as the settings say

  bool retracted() const { return drawn_back[tool]; }
  void set_retracted(bool drawn, bool to_change = false) {
    drawn_back[tool] = drawn;
    drawn_to_change[tool] = drawn && (to_change || drawn_to_change[tool]);
  }
};

/// Where the nozzle goes.
struct Extents {
  Point3 least{max_coord, max_coord, max_coord}, most{-max_coord, -max_coord, -max_coord};
  bool empty() const { return least.x > most.x; }
  void add(Point3 p);
  void unite(const Extents& other);
};

struct LayerDigest {
  Extents extents;        ///< over all moves
  Box covered;            ///< by its beads, their width included
  Ring hull;              ///< … of a first layer: convex
  std::size_t bytes = 0;  ///< of its text, at most about

  // What it changes of the machine's state; where it says nothing: nothing.
  std::optional<Point3> at;       ///< the end of its last bead or travel
  std::optional<Point> wiped_to;  ///< after that, at the same height
  bool place_lost = false;        ///< by a tool change or a pause; `at` and `wiped_to` are of moves after the last one
  std::optional<bool> retracted;  ///< the tool that it begins with
  struct Change {
    ToolId tool = 0;
    std::optional<bool> retracted;  ///< that tool, until the next change
    bool to_change = false;         ///< … as another one follows
  };
  bool to_change = false;  ///< … as another one follows
  std::vector<Change> changes;
  std::vector<Pause> pauses;  ///< in the order of the steps
  std::optional<double> fan;
  std::optional<double> pressure_advance_s;                ///< of the tool that it ends with
  double print_acceleration = 0, travel_acceleration = 0;  ///< mm/s²; 0: not said
};

LayerDigest digest_of(const Settings& settings, const LayerPlan& layer);

/// The state of the machine after a layer that began in `state`.
void advance(MachineState& state, const LayerDigest& layer);

}  // namespace weft::gcode
