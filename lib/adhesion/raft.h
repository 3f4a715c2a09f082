// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "settings/groups/raft.h"

#include <cstdint>
#include <vector>

namespace weft::adhesion {

/// Which of its layers a raft is.
enum class RaftPart : std::uint8_t { base, between, surface };

struct RaftLayer {
  RaftPart part = RaftPart::base;
  Um z = 0, height = 0;
  Um spacing = 0;       ///< of lines; 0: they lie side by side
  Um open_spacing = 0;  ///< … where support alone stands on it
};

/// The layers of a raft, upwards from the bed. Post: not empty.
std::vector<RaftLayer> raft_layers(const RaftSettings& settings, Um nozzle, Um layer_height);

/// What of the plane the raft covers: raft_margin around what stands on it, with its corners filled up to
/// raft_smoothing, within the room.
Regions raft_area(const RaftSettings& settings, const Regions& standing, const Regions& room);

}  // namespace weft::adhesion
