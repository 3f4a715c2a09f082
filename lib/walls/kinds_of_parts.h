// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "walls/part.h"

#include <cstdint>
#include <optional>
#include <vector>

/// Private to walls: parts of a layer that are alike.
namespace weft::walls {

/// The last parts of a layer that differed by more than their place: a plate of pins has one kind of them, and walls
/// move with their region by whole microns.
class KindsOfParts {
 public:
  /// What `region`, the part of that number, gets if one of them is like it.
  std::optional<Part> again(const Region& region, std::uint32_t part) const;
  /// Remembers a part, unless it is large. `region` must stay where it is.
  void add(const Region& region, const Part& made);

 private:
  struct Kind {
    const Region* region = nullptr;
    Part made;
  };
  std::vector<Kind> kinds_;
  std::size_t next_ = 0;
};

}  // namespace weft::walls
