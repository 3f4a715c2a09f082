// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/plan.h"
#include "model/statistics.h"
#include "settings/settings.h"

#include <concepts>
#include <optional>
#include <span>

namespace weft::motion {

/// The settings that motion reads, of one scope.
struct Rules {
  MachineSettings machine;
  MaterialSettings material;
  LayerSettings layers;
  WallSettings walls;
  RetractionSettings retraction;
  SpeedSettings speeds;
  CoolingSettings cooling;
  /// Of travels above the first layer, mm/s: beads that follow their width get no faster. Absent: as in speeds.
  std::optional<double> speed_travel_above{};
  double tool_change_s = 0;                 ///< to load this tool
  Um amount_to_change = 0;                  ///< drawn back before another one is
  Um extra_prime_to_change = 0;             ///< pushed forward beyond that
  std::optional<Um> arc_tolerance{};        ///< curves are told as arcs (motion/arcs.h); absent: they are not
  std::optional<MachineSettings> silent{};  ///< the machine in its silent mode; absent: it has none
  std::optional<Um> arc_segment{};          ///< pieces that firmware cuts arcs into; absent: as its documents say
  std::optional<LengthOrShare> infill_line_width{};  ///< of sparse infill; absent: automatic
};

/// @param above what holds above the first layer: a bead's nominal width is that of the others. Null: the same
Rules rules_of(const Settings& settings, const Settings* above = nullptr);

/// A layer with speeds, accelerations and fan, and what it takes.
struct PlannedLayer {
  LayerPlan plan;
  Statistics statistics;  ///< of this layer alone: layer_s has one value
  /// How long each step of the plan takes, s. Empty where there is one tool: nothing is placed in the plan afterwards.
  std::vector<float> step_s{};
};

/// Rules by scope: of the layer (LayerPlan::scope) and of its beads. A scope that is not there has the first's.
struct AllRules {
  std::span<const Rules> scopes;
  std::span<const Rules> tools{};  ///< by tool; empty where there is one
  ToolId loaded = any_tool;        ///< when the layer begins

  AllRules(std::span<const Rules> of_scopes, std::span<const Rules> of_tools = {}, ToolId tool = any_tool)
      : scopes(of_scopes), tools(of_tools), loaded(tool) {}
  template <class Several>
  requires std::convertible_to<const Several&, std::span<const Rules>> AllRules(const Several& of_scopes)
      : scopes(of_scopes) {}
  std::size_t size() const { return scopes.size(); }
  const Rules& operator[](std::size_t i) const { return scopes[i]; }
};

/// Gives every step of a layer its speed and acceleration, slows the layer down to cool_min_layer_time, sets the fan.
/// Beads are cut where their width changes, so that each segment may be printed at one width; mm³/s stay below
/// material_max_volumetric_speed at every junction.
/// @param start where the nozzle is when the layer begins (model/plan.h, end_of); nothing: unknown
/// Pre:  speeds of `layer` are not set.  Post: all speeds > 0.
/// Cost: O(junctions); a few passes more where the layer is slowed down. Layers do not depend on each other: the
/// estimate of
///       time lets each begin and end at rest, which costs a fraction of a second a layer.
PlannedLayer plan_layer(AllRules rules, LayerPlan layer, std::optional<Point3> start);
inline PlannedLayer plan_layer(const Rules& rules, LayerPlan layer, std::optional<Point3> start) {
  return plan_layer(AllRules(std::span(&rules, 1)), std::move(layer), start);
}

/// Where the nozzle is when a layer is done that began at `start`; nothing as long as no layer has moved.
std::optional<Point3> start_after(const LayerPlan& layer, std::optional<Point3> start);

/// Where the nozzle is when each layer begins; nothing where no layer before has moved.
std::vector<std::optional<Point3>> starts_of(const PrintPlan& print);

/// All layers, one after the other.
struct Planned {
  PrintPlan plan;
  Statistics statistics;
};
Planned plan(AllRules rules, PrintPlan print);
inline Planned plan(const Rules& rules, PrintPlan print) {
  return plan(AllRules(std::span(&rules, 1)), std::move(print));
}

}  // namespace weft::motion
