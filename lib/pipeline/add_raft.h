// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/stages.h"

namespace weft::pipeline {

/// What settings the layers of a raft are printed with.
struct RaftScopes {
  ScopeId base = 0, between = 0, surface = 0;
};

/// The layers of the raft under what stands on the plate, with their beads.
/// @param standing outlines of what stands on it, on the plate
PrintedLayers make_raft(const Settings& settings, const RaftScopes& scopes, const Regions& standing);

/// How far it lifts the parts: its height and the gap on it; 0 without a raft.
Um raft_lift(const Settings& settings);

/// Skirt and brim as adhesion_type has them.
AdhesionSettings adhesion_of(const AdhesionSettings& settings);

}  // namespace weft::pipeline
