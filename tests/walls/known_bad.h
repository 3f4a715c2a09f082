// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <functional>
#include <string>

namespace weft::test {

/// A law, and how many random polygons of each seed it is held against.
struct Law {
  std::string name;
  int polygons = 500;
};

/// Runs a law over random polygons of each of eight seeds. Those for which it is known not to hold are listed one
/// by one in tests/data/walls/known_bad.txt, and the test fails when another one misses it, or one of them no longer
/// does. WEFT_KNOWN_BAD=write test_walls "[law]" writes the list anew if it gets no longer than it was.
/// @param missed_by how far a polygon misses what is asked, in the law's own unit
void check_law(const Law& law, double most, const std::function<double(const Regions&)>& missed_by);

}  // namespace weft::test
