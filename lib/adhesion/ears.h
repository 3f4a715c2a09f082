// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <vector>

namespace weft::adhesion {

/// The tips of parts: corners sharper than that, rounded ones too, and the ends of what is thin. What a disc of 2 mm
/// does not reach into is a tip where the two places at which the disc touches its sides say so: they are 2 · 2 mm ·
/// cos(θ/2) apart in a corner of angle θ, however round it is. Of what is thinner than that disc, and sticks out
/// further than a corner does, smaller discs tell.
/// Source: opening (J. Serra 1982), instead of vertices, at which rounded corners have none that is sharp.
std::vector<Point> tips_of(const Regions& outlines, double sharper_than_deg);

}  // namespace weft::adhesion
