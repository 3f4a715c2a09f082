// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/rgb.h"
#include "settings/settings.h"
#include "tools/order.h"

#include <vector>

/// How much is purged at a change of the tool.
namespace weft::tools {

/// mm³ until what is left of one filament shows in the other no longer: a melt zone that is mixed through, of which a
/// share exp(−V / mix) is left after V mm³, and colours that mix as pigments do.
/// Sources: P. Kubelka, F. Munk, "Ein Beitrag zur Optik der Farbanstriche", 1931, one constant a channel of linear
/// sRGB; CIE 1976 L*a*b*.
/// @param tolerance ΔE 1976 that may be left; @param mix_mm3 of the melt zone
double purge_volume_mm3(Rgb from, Rgb to, double tolerance, double mix_mm3);

/// Difference of colour, ΔE 1976.
double difference(Rgb a, Rgb b);

/// mm³ from each tool to each.
/// Pre: purge_volumes holds n × n numbers or is auto (profile/profile.h checks that)
Costs purge_volumes(const std::vector<Settings>& tools);
/// The same row by row; empty where there are no tools.
std::vector<double> purge_matrix(const std::vector<Settings>& tools);

}  // namespace weft::tools
