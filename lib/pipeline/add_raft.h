// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/stages.h"

namespace weft::pipeline {

/// What settings the layers of a raft are printed with.
struct RaftScopes {
  ScopeId base = 0, between = 0, surface = 0;
};

/// Outlines of what stands on a raft, on the plate.
struct OnRaft {
  Regions parts, support;
};

/// The layers of the raft under what stands on the plate, with their beads. Under support, which nothing has to come
/// off and whose underside nobody sees, its surface is as open as the layers between, and no larger than what stands
/// there.
PrintedLayers make_raft(const Settings& settings, const RaftScopes& scopes, const OnRaft& standing);

/// How far it lifts the parts: its height and the gap on it; 0 without a raft.
Um raft_lift(const Settings& settings);

/// Skirt and brim as adhesion_type has them.
AdhesionSettings adhesion_of(const AdhesionSettings& settings);

}  // namespace weft::pipeline
