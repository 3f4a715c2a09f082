// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "support/field.h"

#include <vector>

namespace weft::support {

/// Where branches begin under a contact so that no place of it is further than `covers` from one.
/// @param standing  where branches already are on that level: they hold what lies near them
/// Post: none nearer to another than half of it, but where the contact is narrow.
std::vector<Point> tips_under(const Regions& contact, const std::vector<Point>& standing, Um covers, const Field& field,
                              std::size_t slab, Um radius);

}  // namespace weft::support
