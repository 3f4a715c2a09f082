// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/stages.h"
#include "slice/slice.h"
#include "tasks/spare.h"

#include <functional>
#include <string>
#include <vector>

namespace weft::pipeline {

/// What stands under one object, in the coordinates of its first copy.
struct SupportOf {
  Regions room;                                         ///< where its beads may lie; empty: nowhere
  bool bounded = false;                                 ///< whether `room` counts
  std::vector<Regions> enforced{}, blocked{}, given{};  ///< by layer of the object, or empty
  Um floor = 0;                                         ///< 0, or below it on a raft
  bool on_raft = false;
  PrintedLayers layers;           ///< made by support_object
  std::vector<Regions> over_air;  ///< of each layer of the object, what has nothing below; empty: nobody has asked yet
  std::vector<Regions> held;      ///< of each layer of the object, what rests on support; empty: nothing does
};

/// What of a layer has nothing below. Pre: i is one of the cuts.
Regions over_air_of(const std::vector<slice::Cut>& cuts, std::size_t i);

/// Where the support of each object may lie: on the bed with all of its copies, off no-go areas and off its neighbours.
std::vector<SupportOf> rooms_of(const Scopes& scopes, const Plate& plate);

/// What support is made from, and beside.
struct SupportFrom {
  const std::vector<slice::Cut>& cuts;
  const std::function<std::vector<std::string>()>& sliced_by;  ///< the keys of the object's slices, by volume
  tasks::Spare& spare;  ///< what threads may do that have nothing to do of support
};

/// Fills `out`, and tells in the report what was found.
void support_object(const Running& job, const Scopes& all, const ObjectScopes& scopes, const Object& object,
                    const SupportFrom& from, SupportOf& out);

/// Warns of what begins in the air where no support is asked for. Cost: next to nothing, since walls know what hangs.
void tell_missing_support(const Running& job, const Scopes& all, const ObjectScopes& scopes, const Object& object,
                          const std::vector<slice::Cut>& cuts, const std::vector<WallLayer>& walls);

/// Marks skin most of which lies on support. @param held what of the layer does
void mark_supported(const Regions& held, Beads& beads);

}  // namespace weft::pipeline
