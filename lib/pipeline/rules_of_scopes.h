// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "contour/contour.h"
#include "motion/motion.h"
#include "overhangs/overhangs.h"
#include "settings/scopes.h"

#include <vector>

/// What passes over the steps of a layer read of the settings: one value a scope, by its number.
namespace weft::pipeline {

std::vector<motion::Rules> rules_of(const Scopes& scopes);
std::vector<overhangs::Strand> strands_of(const Scopes& scopes);
std::vector<contour::Rules> contours_of(const Scopes& scopes);

}  // namespace weft::pipeline
