// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "support/room.h"

#include <optional>
#include <utility>
#include <vector>

namespace weft::support {

/// Contacts that lie side by side or one above the other, seen from above: columns of two patches never meet.
struct Patch {
  std::vector<std::pair<std::size_t, Regions>> contacts;  ///< by level, upwards
};

/// How high its highest contact is above the object's floor; the highest level is, of one that has none.
/// Pre: there is a level
Um height_of(const Patch& patch, const Stack& stack, const Object& object);

/// Contacts taken apart by what they are seen from above.
class Patches {
 public:
  /// @param apart  what lies no further from each other is one patch
  Patches(const std::vector<Regions>& contacts, Um apart);

  const std::vector<Patch>& all() const { return patches_; }
  /// The patch that a point lies in or right beside.
  std::optional<std::size_t> at(Point p) const;

 private:
  geometry::SegmentIndex index_;       // of what is around each contact
  std::vector<std::size_t> patch_of_;  // beside its regions
  std::vector<Patch> patches_;
};

}  // namespace weft::support
