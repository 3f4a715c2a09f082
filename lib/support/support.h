// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/notice.h"
#include "core/polygon.h"
#include "model/layer.h"
#include "settings/groups/support.h"
#include "tasks/spare.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

/// What stands under a part while it is printed. Two steps: `demand` finds what of each layer cannot hang by itself,
/// `plan` puts columns and branches below it. Both know outlines only: how areas become beads is the filler's.
namespace weft::support {

/// An object from the bed upwards, in the coordinates of its first copy.
struct Object {
  std::span<const SlicedLayer* const> layers;
  Um nozzle = 400;      ///< diameter
  Um outer_line = 450;  ///< width of an outermost wall
  Um floor = 0;         ///< where support may begin: 0, or below it on a raft
  bool on_raft = false;
  const Regions* room = nullptr;                   ///< where beads of support may lie; null: anywhere
  std::span<const Regions> enforced{}, blocked{};  ///< by layer, where somebody marked it; or empty
  std::span<const Regions> given{};                ///< by layer, what somebody drew as support; or empty
  /// By layer: what of it has nothing below, where that is known; or empty.
  std::span<const Regions* const> over_air{};
};

/// What of the underside of a layer must be held.
struct LayerDemand {
  Regions wanted;
  std::size_t islands = 0;  ///< so many of its regions begin in the air
  double bridged_mm2 = 0;   ///< left out, because strands cross it
};
using Demand = std::vector<LayerDemand>;

/// What of each layer of the object reaches too far into the air (settings: support_angle and what follows it).
/// Post: wanted[i] lies in layer i and not over layer i − 1; wanted[0] is empty.
/// Cost: one offset and three Booleans a layer, one less where it is known what has nothing below.
Demand demand(const SupportSettings& settings, const Object& object);

/// Where something begins in the air: what is asked for also when support is off. Cost: a Boolean a layer.
struct Island {
  std::size_t layer = 0;
  Point at;
};
std::vector<Island> islands(const Object& object);

/// The lowest layer of a roof over branches: what its strands lie on.
struct Joists {
  Regions area;
  Regions rimmed;               ///< what of it has a loop along its rim
  std::vector<Polyline> lines;  ///< from branch to branch, and what of other rims lies on something
  std::vector<Polyline> after;  ///< rims that lie on ends of these: printed after them
};

/// One layer of support. Areas do not overlap.
struct SupportLayer {
  Um z = 0, height = 0;
  Regions columns;       ///< filled sparsely
  Regions branches;      ///< hollow, with a wall
  Regions roof;          ///< the interface under the part
  Regions bottom;        ///< the interface over the part
  bool first = false;    ///< it lies on the bed
  Joists joists{};       ///< between branches and the roof above them
  Regions under_roof{};  ///< strands across what fills columns, on which a roof's strands lie
  Regions feet{};        ///< where what stands on the part touches it by feet only
};

struct Figures {
  double needed_mm2 = 0, bridged_mm2 = 0;
  double left_mm2 = 0;          ///< what could not be reached
  Point3 left_at{};             ///< the first place of it
  double left_to_part_mm2 = 0;  ///< of it, what could be held if support might stand on the part
  double contact_mm2 = 0;       ///< right below the part, a gap away
  double on_part_mm2 = 0;       ///< of what stands on the part; feet touch less of it
  std::size_t islands = 0;      ///< places that begin in the air
  std::size_t tips = 0, trunks = 0;
  double trapped_mm3 = 0;  ///< plastic that no tool gets to; whoever makes the beads knows it
  double slenderest = 0;   ///< of trunks: height by width where they stand, without what spreads on the bed
};

struct Plan {
  std::vector<SupportLayer> layers;  ///< upwards; empty: nothing is needed
  std::vector<Regions> held;         ///< of each layer of the object, what rests on support
  std::vector<double> trapped{};     ///< of each layer of support, the share that no tool gets to; empty: none
  Figures figures;
};

/// Columns and branches for the demand.
/// Post: tops of support lie support_top_distance below what they hold (more where layers are synchronised, or under
///       the first layers); beside the part there is support_xy_distance; every area rests on the bed, on the part or
///       on what is below.
Plan plan(const SupportSettings& settings, const Object& object, const Demand& demand);
/// The same, while threads that wait do other work: columns fall level by level. `spare` changes nothing of the plan.
Plan plan(const SupportSettings& settings, const Object& object, const Demand& demand, tasks::Spare& spare);

}  // namespace weft::support
