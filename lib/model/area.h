// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "core/scope_id.h"

#include <cstdint>
#include <vector>

namespace weft {

/// What of an area has sparse infill of other settings; walls and skins run through it.
struct InnerArea {
  ScopeId scope = 0;
  Regions regions{};
  friend bool operator==(const InnerArea&, const InnerArea&) = default;
};

/// A run of a layer's regions that are printed with the same settings.
struct Area {
  ScopeId scope = 0;
  std::uint32_t regions = 0;       ///< how many of the layer's, behind those of the areas before
  std::vector<InnerArea> inner{};  ///< they do not overlap
  friend bool operator==(const Area&, const Area&) = default;
};

/// All regions of a layer. No two have the same scope.
using Areas = std::vector<Area>;

}  // namespace weft
