// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "model/tool.h"

#include <cstdint>
#include <span>
#include <vector>

/// In which order a plate is printed. Objects are cut into layers of heights of their own; the sequence says which of
/// them rise together, and the timeline is what follows: all layers in the order of the file, each knowing where it
/// stands. What stages ask ("is this the first layer", "do other objects begin here") is asked here, never inferred
/// from an index or from a z that falls.
namespace weft {

/// One copy of one object: index into PrintPlan::objects.
using ObjectId = std::uint32_t;

/// Objects that are printed upwards together, from one height to another.
struct Pass {
  std::vector<ObjectId> objects;
  Um from = 0, to = max_coord;  ///< layers with their top above `from` and not above `to`
  std::uint32_t rise = 0;  ///< passes of equal rise follow each other upwards; the next rise begins on the bed again
  ToolId tool = any_tool;  ///< what it prints with
};

/// By layer: one pass. One object at a time: one pass and one rise an object. Each tool of a layer: one pass, all of
/// one rise. Pre: rises ascend, and within a rise heights do.
using Sequence = std::vector<Pass>;

/// Everything at once, layer by layer.
Sequence by_layer(std::size_t objects);

/// Where a layer stands in time.
struct Moment {
  std::uint32_t index = 0;   ///< of the layer in the file
  std::uint32_t pass = 0;    ///< index into the sequence
  std::uint32_t number = 0;  ///< of its height on the way up from the bed: the passes of one height share it
  bool comes_down = false;   ///< another rise begins: the head leaves the height of what stands already
  /// Does it lie on the bed?
  bool first() const { return number == 0; }
  friend bool operator==(const Moment&, const Moment&) = default;
};

/// What an object is cut into.
struct LayerHeight {
  Um z = 0;  ///< top
  Um height = 0;
  friend bool operator==(const LayerHeight&, const LayerHeight&) = default;
};

/// Objects that are cut at the same heights, as far up as each of them reaches. Support, a raft or a tower of other
/// heights is a stack of its own.
struct Stack {
  std::vector<LayerHeight> layers;  ///< upwards, of the tallest
  struct Member {
    ObjectId object = 0;
    std::uint32_t layers = 0;  ///< how many of them it has
  };
  std::vector<Member> objects;
};

/// All that is printed at one moment.
struct TimelineLayer {
  Moment time;
  Um z = 0;
  Um height = 0;  ///< the greatest of its parts
  struct Part {
    ObjectId object = 0;
    std::uint32_t layer = 0;  ///< of that object, from 0
    std::uint32_t stack = 0;
    friend bool operator==(const Part&, const Part&) = default;
  };
  std::vector<Part> parts;  ///< objects ascending
};
using Timeline = std::vector<TimelineLayer>;

/// Merges stacks by height and pass. Cost: O(n log n) in the layers of all copies.
/// Post: every layer of an object that is in a pass which holds its height is there once for each such pass.
Timeline timeline_of(const Sequence& sequence, std::span<const Stack> stacks);

}  // namespace weft
