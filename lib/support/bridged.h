// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

namespace weft::support {

/// What of an overhang strands of plastic can cross in the air, from rest to rest: all strands of the direction in
/// which most of them rest on `below` with both ends and are no longer than `longest`.
/// @param strand width of one
/// Post: within `gap`. Cost: 12 directions, each a cut of the gap by lines.
Regions bridged(const Region& gap, const Regions& below, Um longest, Um strand);

}  // namespace weft::support
