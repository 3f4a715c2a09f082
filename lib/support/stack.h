// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "support/support.h"

#include <cstdint>
#include <vector>

namespace weft::support {

/// Layers of support. What it holds lies at any height, and its layers end where most of that is to be held; what lies
/// between two of them stands on the lower one with a cap of its own, so the gap is what was asked for everywhere and
/// layers are as high as they may be.
struct Stack {
  static constexpr std::uint32_t none = 0xFFFFFFFF;
  struct Level {
    Um z = 0, height = 0;
    Um bottom() const { return z - height; }
  };
  std::vector<Level> levels;  ///< upwards; they fill the height from the floor

  /// What holds the underside of a layer of the object.
  struct Contact {
    std::uint32_t level = none;  ///< the level that ends below its gap
    Um cap = 0;                  ///< what is missing to the gap: the height of what lies on that level
  };
  std::vector<Contact> contacts;  ///< of each layer of the object that asks for support
};

/// Post: heights are between a quarter and three quarters of the nozzle, where the object's own are, and no more than
///       support_infill_sparse_thickness; caps are no less than a quarter, and where they are more than that they are
///       to be printed as two. On the bed the first level is as high as the object's first layer.
Stack stack_of(const SupportSettings& settings, const Object& object, const Demand& demand);

/// The greatest height of a layer of support.
Um most_height(const SupportSettings& settings, Um nozzle);

/// By level: the lowest cap of its contacts.
std::vector<Um> lowest_caps(const Stack& stack);

/// How many levels, from that one down, an interface of that height takes.
std::size_t interface_levels(const Stack& stack, std::size_t level, Um height);

/// How many levels, from that one down, a roof of that height takes with the strands that it lies on, which are its
/// lowest level: two, or one where a cap lies on it that is no less than half as high.
std::size_t roof_levels(const Stack& stack, std::size_t level, Um cap, Um height);

}  // namespace weft::support
