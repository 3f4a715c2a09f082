// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/notice.h"
#include "core/overloaded.h"
#include "model/bead.h"
#include "model/sequence.h"

#include <string>
#include <variant>
#include <vector>

namespace weft {

/// A run of a bead's pieces that is written as one arc, in the plane of the layer.
struct Arc {
  std::uint32_t first = 0, last = 0;  ///< junctions that it begins and ends at
  Point centre;
  bool ccw = false;  ///< it turns left
  friend bool operator==(const Arc&, const Arc&) = default;
};

/// Lays a bead down from its first junction to its last (a closed bead has its first junction repeated at the end
/// here).
struct Extrude {
  std::vector<Junction> path;
  Role role = Role::outer_wall;
  ToolId tool = any_tool;  ///< what it is printed with: the tool that a ToolChange before it loaded
  ScopeId scope = 0;       ///< what settings it is printed with
  Um height = 0;           ///< of the layer at this place
  double speed_mm_s = 0;   ///< set by motion; 0 before
  std::vector<float>
      segment_speed_mm_s{};       ///< set by motion where speed varies along the path: one a segment; else empty
  double acceleration_mm_s2 = 0;  ///< set by motion; 0: whatever the firmware has
  /// Of a ramp, or of what follows a surface: how far below the layer's z each junction lies (above it: less than 0),
  /// one a junction; else empty. Flow is the band's share that is laid there, so that volume is as for any bead. Such a
  /// bead is not resampled.
  std::vector<Um> below{};
  bool follows_surface = false;  ///< it is as much lower, or higher, than its layer as it lies below or above its z
  /// Of walls and skin: how much of the width lies over air, in quarters rounded up; 0 where it is less than a tenth.
  std::uint8_t air_quarters = 0;
  /// Of a piece that was cut out of a closed bead: the length of all of it; 0: the path is the whole bead.
  Um loop_length = 0;
  bool on_support = false;  ///< skin that rests on support
  /// Set by motion: in order, without overlap. The path stays what is meant; an arc is how it is told.
  std::vector<Arc> arcs{};
};

/// Where junction i of a bead lies, on a layer at z.
inline Point3 place_of(const Extrude& bead, std::size_t i, Um z) {
  return {bead.path[i].at.x, bead.path[i].at.y, bead.below.empty() ? z : z - bead.below[i]};
}

/// Moves without extruding, through the points in order; starts where the last step ended.
struct Travel {
  std::vector<Point3> path;
  double speed_mm_s = 0;          ///< set by motion
  bool crosses_wall = false;      ///< leaves the part it was in; such a travel is retracted
  double z_speed_mm_s = 0;        ///< set by motion: what the vertical share of speed_mm_s may be
  double acceleration_mm_s2 = 0;  ///< set by motion; 0: whatever the firmware has
};

/// Draws filament back; `wipe` retraces that path while doing so.
struct Retract {
  Polyline wipe;
  double wipe_speed_mm_s = 0;  ///< set by motion
  double before_wipe = 1;  ///< set by motion: share drawn back before the wipe begins, so that the extruder keeps up
  bool to_change = false;  ///< another tool follows: drawn back by switch_extruder_retraction_amount
  friend bool operator==(const Retract&, const Retract&) = default;
};
/// Pushes it forward again.
struct Prime {
  double extra_mm3 = 0;  ///< beside what was drawn back
};

/// Part-cooling fan, 0 … 1.
struct SetFan {
  double share = 0;
};

/// How much further than moves ask for the extruder goes while they gain speed: mm of filament a mm/s of it.
struct SetPressureAdvance {
  double seconds = 0;
};

/// Everything until the next ObjectEnd belongs to that object (index into PrintPlan::objects).
struct ObjectStart {
  std::uint32_t object = 0;
};
struct ObjectEnd {
  std::uint32_t object = 0;
};

/// From here on another tool prints. It brings its own filament: what was drawn back of the one before stays so.
/// Where the nozzle is afterwards is not known to who reads the file: firmware may have gone to a rack.
/// Pre: filament is drawn back, or both tools stand still anyway.
struct ToolChange {
  ToolId tool = 0;
  friend bool operator==(const ToolChange&, const ToolChange&) = default;
};

/// What a heater is to reach.
struct SetTemperature {
  enum class Heater : std::uint8_t { nozzle, bed, chamber };
  Heater heater = Heater::nozzle;
  ToolId tool = any_tool;  ///< of a nozzle
  int celsius = 0;         ///< 0: off
  bool wait = false;       ///< until it is reached
  friend bool operator==(const SetTemperature&, const SetTemperature&) = default;
};

/// Moves filament at a pace of its own, in which a tool is changed: shapes its tip, draws it out, pushes it in.
/// Nothing that was drawn back by a Retract is meant. Pre: the extruder follows; motion does not change it.
struct Feed {
  double mm = 0;       ///< of filament; below 0: out of the nozzle
  double seconds = 0;  ///< that it takes; without filament the printer waits so long
  bool moves = false;  ///< the nozzle goes on meanwhile
  Point to{};          ///< … there
  Um width = 0;        ///< … and lays a line as wide as this
  friend bool operator==(const Feed&, const Feed&) = default;
};

/// The printer waits for somebody to let it go on. Firmware may park the nozzle meanwhile.
struct Pause {
  std::string text;             ///< what to do, for the display; one line
  bool swaps_filament = false;  ///< other filament goes on
  friend bool operator==(const Pause&, const Pause&) = default;
};

using Step = std::variant<Extrude, Travel, Retract, Prime, SetFan, ObjectStart, ObjectEnd, ToolChange, SetTemperature,
                          Pause, Feed, SetPressureAdvance>;

/// One layer of the whole plate, in the order it is printed.
struct LayerPlan {
  Um z = 0, height = 0;
  Moment time{};
  ScopeId scope = 0;  ///< the settings of what belongs to no bead: travels, fan
  std::vector<Step> steps{};
};

/// What firmware calls an object: one copy of one model.
struct ObjectLabel {
  std::string name;
  Point centre;
  Ring outline;  ///< convex hull on the bed
};

struct PrintPlan {
  std::vector<LayerPlan> layers;
  std::vector<ObjectLabel> objects;
  Notices notices;
};

/// Speed of a travel from a to b: its own, lowered so that the vertical share stays within z_speed_mm_s.
double speed_between(const Travel& travel, Point3 a, Point3 b);

/// Where the nozzle is after the layer, when it was at `before` when the layer began.
Point3 end_of(const LayerPlan& layer, Point3 before);

}  // namespace weft
