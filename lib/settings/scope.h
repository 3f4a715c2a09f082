// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/table.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace weft {

/// Where the value of a setting may differ within one print, from coarse to fine: each level includes those before it.
enum class Scope : std::uint8_t {
  machine,  ///< a property of the printer
  plate,    ///< one value for everything that is printed together
  tool,     ///< each tool, or its filament, has its own
  object,   ///< each object as a whole
  region,   ///< each area of a layer: parts, modifiers
  layer,    ///< each layer as a whole too: what belongs to no bead, such as travels and fan
};

struct ScopeName {
  Scope scope;
  std::string_view name;
};
inline constexpr std::array scope_names{
    ScopeName{Scope::machine, "machine"}, ScopeName{Scope::plate, "plate"},   ScopeName{Scope::tool, "tool"},
    ScopeName{Scope::object, "object"},   ScopeName{Scope::region, "region"}, ScopeName{Scope::layer, "layer"},
};
static_assert(in_order(scope_names, &ScopeName::scope), "row i of scope_names is scope i");

constexpr std::string_view name_of(Scope scope) {
  return row_of(scope_names, scope).name;
}

}  // namespace weft
