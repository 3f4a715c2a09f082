// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "support/support.h"

#include <cstdint>
#include <vector>

namespace weft::support {

/// Layers of support: each contact has a layer that ends exactly below it, so the gap is what was asked for.
struct Stack {
  static constexpr std::uint32_t none = 0xFFFFFFFF;
  struct Level {
    Um z = 0, height = 0;
    Um bottom() const { return z - height; }
  };
  std::vector<Level> levels;           ///< upwards; they fill the height from the floor
  std::vector<std::uint32_t> contact;  ///< of each layer of the object: the level that ends below its gap, or none
};

/// Post: heights are between a quarter and three quarters of the nozzle, where the object's own are, and no more than
///       support_infill_sparse_thickness. On the bed the first level is as high as the object's first layer.
Stack stack_of(const SupportSettings& settings, const Object& object, const Demand& demand);

/// How many levels, from that one down, an interface of that height takes.
std::size_t interface_levels(const Stack& stack, std::size_t level, Um height);

}  // namespace weft::support
