// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "support/patches.h"
#include "support/room.h"
#include "tasks/spare.h"

#include <vector>

namespace weft::support {

/// Where columns stand on each level for the contacts of each level.
/// @param contacts  by level: what is to be held from there
/// @param given     by level: what stands there in any case
/// @param spare     what other threads do while one follows the highest patch down
/// @param known     the patches of these contacts, `apart` from each other, where they are known
/// Post: every area lies outside of what is kept out and in the object's room, and rests.
std::vector<Regions> columns(const Room& room, const Stack& stack, const std::vector<Regions>& contacts,
                             const std::vector<Regions>& given, tasks::Spare& spare, const Patches* known = nullptr);

/// Lets columns get narrower downwards, but none narrower than an eighth of its height: it would tip over.
class Lean {
 public:
  /// @param line    width of a bead
  /// @param height  of the column
  Lean(const SupportSettings& settings, Um line, Um height);

  /// On levels of that height together, the next ones down: what lies above still rests. @return whether anything was
  /// done
  bool narrow(Um height, Regions& falling, int levels = 1);

 private:
  /// By that much at each side; wider below 0. What lines fill gets narrower along them only, or those at its side
  /// would have nothing below.
  Regions narrower(const Regions& falling, Um by) const;

  const SupportSettings& s_;
  Um line_, least_;
  double left_ = 0;  ///< how much narrower, µm, than has been done
};

/// Columns of contacts that are further from each other than that, seen from above, never meet.
Um apart(const SupportSettings& settings, Um nozzle);

}  // namespace weft::support
