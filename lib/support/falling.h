// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "support/lengths.h"
#include "support/patches.h"
#include "support/room.h"

#include <vector>

namespace weft::support {

class ContactsAbove;

/// Where columns fall.
struct Air {
  const Room& room;
  const Stack& stack;
  const std::vector<Regions>& shadow;  ///< by level: what is not to be entered; or empty

  bool shaded(std::size_t level) const { return !shadow.empty() && !shadow[level].empty(); }
  Um line() const { return line_width(room.settings(), room.object().nozzle); }
  /// What of an area has room on a level. @param cut  set where that may be less
  Regions free_part(const Regions& area, std::size_t level, const ContactsAbove& held, bool& cut) const;
};

/// The contacts right above a level. What is held as near beside the part as contacts are must come from further away:
/// it leans towards it in two steps, on the last levels and where the roof above them begins. What rests reaches about
/// half a line further on each.
class ContactsAbove {
 public:
  explicit ContactsAbove(const Air& air) : air_(air) {}

  /// From the highest level down; with those of the level itself.
  void go_to(std::size_t level, const Regions& contacts);
  /// Of the last levels, and of the roof above them.
  const Regions& close() const { return close_; }
  const Regions& above() const { return above_; }

 private:
  struct Held {
    std::size_t level = 0, leaning = 0;  ///< from theirs down, so many lean towards them
    Regions contacts;
  };
  const Air& air_;
  std::vector<Held> held_;
  Regions close_, above_;
};

/// Columns of one patch.
struct Fallen {
  struct Step {
    Regions whole, left;  ///< where the part cut them: before, and what was left, with its thin ends
    Regions cleared;      ///< what is left, whether it rests or not
    bool less = false;    ///< it is not all of what lies above it
  };
  std::vector<Step> steps;      ///< by level
  std::vector<Regions> levels;  ///< what rests of them
  Regions lost;                 ///< what had nothing below, seen from above
};

/// Columns that are too slender get wider, where nothing else is set of how wide they are.
bool may_get_steadier(const SupportSettings& settings);

/// From the highest level of a patch down.
/// @param given   by level: what stands there in any case; or null
/// @param height  of the highest column
Fallen fall(const Air& air, const Patch& patch, const std::vector<Regions>* given, Um height);

/// Columns that fell, where what they lost had nothing below, seen from above, slide down beside the slopes that took
/// it: what slides falls beside the others.
/// @return by level, what rests of all
std::vector<Regions> slid(const Air& air, const Patch& patch, const Fallen& first);

}  // namespace weft::support
