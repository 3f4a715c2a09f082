// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/overlay.h"

namespace weft {

/// What the first layer has of its own, as an overlay over what holds above it: height, line widths, outlines, speeds,
/// accelerations and temperatures. It follows from settings such as initial_layer_height and speed_layer_0, so it is
/// made of the settings that hold at the place, and laid last.
Overlay first_layer_of(const Settings& settings);

/// What the first layer of a part has of its own that lies on a raft: speeds and accelerations. Height, widths and
/// outlines are those of other layers: what they make up for is the bed's.
Overlay first_layer_on_raft_of(const Settings& settings);

/// The settings with what the first layer has of its own.
Settings on_first_layer(Settings settings);

}  // namespace weft
