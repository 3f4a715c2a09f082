// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "support/lengths.h"
#include "support/support.h"

#include <array>

namespace weft::support {

/// The kinds of areas of a layer of support that are filled as a whole.
inline constexpr std::array kinds{&SupportLayer::columns, &SupportLayer::branches, &SupportLayer::roof,
                                  &SupportLayer::under_roof, &SupportLayer::bottom};

/// All that a layer of support covers; neighbours may touch.
inline Regions all_areas(const SupportLayer& layer) {
  Regions out;
  for (const auto kind : kinds) append(out, layer.*kind);
  append(out, layer.joists.area);
  return out;
}

}  // namespace weft::support
