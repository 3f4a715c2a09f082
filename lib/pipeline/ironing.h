// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/notice.h"
#include "model/plan.h"
#include "model/statistics.h"
#include "settings/scopes.h"

#include <span>

/// Ironing goes slowly with little plastic: what that does to the melt, and what is done about it.
namespace weft::pipeline {

/// Plastic that stands in the melt for minutes creeps upwards: clogs, and none at the next wall.
/// @param layers upwards, each with its z
struct IronedLayer {
  Um z = 0;
  Statistics::Feature ironing;
};
void tell_slow_ironing(std::span<const IronedLayer> layers, Notices& notices);

/// Does anything of it ask for ironing_prime?
bool primes_after_ironing(const Scopes& scopes);

/// Pushes ironing_prime forward where something else is printed after ironing: with what is pushed forward anyway, or
/// before it. @param owed mm³, from the layer before and to the next
void prime_after_ironing(const Scopes& scopes, LayerPlan& layer, double& owed_mm3);

}  // namespace weft::pipeline
