// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/spatial_index.h"
#include "support/stack.h"

#include <span>
#include <vector>

namespace weft::support {

/// The layers of the object [from, to) that share height with (low, high).
struct LayerRun {
  std::size_t from = 0, to = 0;
};
LayerRun layers_between(const Object& object, Um low, Um high);

/// What blockers mark there.
Regions blocked_between(const Object& object, Um low, Um high);

/// Distance to the part beside, µm.
Um beside(const SupportSettings& settings, const Object& object);

/// The part as support sees it, and where support may be. It is asked for what lies near a box, so that its outlines
/// cost no more than what is close by.
class Room {
 public:
  Room(const SupportSettings& settings, const Object& object);

  /// The part's outlines in that height, near the box. They may overlap.
  Regions part(Um low, Um high, const Box& near) const;
  /// What the part beside keeps out of a level, near the box.
  Regions kept_off_beside(const Stack::Level& level, const Box& near) const;
  /// What of an area is not kept out of a level: beside contacts the smaller distance holds, and what is right below
  /// contacts comes half as near, so that nothing hangs beside it.
  /// Post: what lies free of the part is returned as it was.
  /// @param changed  if given, whether anything was taken away
  /// @param above    if given, the contacts of levels right above
  Regions free_part(const Regions& area, const Stack::Level& level, const Regions& contacts, bool* changed = nullptr,
                    const Regions* above = nullptr) const;

  /// Whether nothing is kept out of an area on a level, so that no more than a hair would be taken from its rim. What
  /// is beside contacts needs more than that.
  /// @param edge   the area's
  /// @param above  the level right above, if the same area stands free there: what is in the gap is not asked for again
  /// Cost: the corners of the part beside.
  bool stands_free(const Regions& area, const geometry::SegmentIndex& edge, const Stack::Level& level,
                   const Stack::Level* above = nullptr) const;

  /// Whether the part in that height comes as near to an area.
  /// @param edge  the area's
  /// Cost: the corners of the part beside.
  bool comes_near(Um low, Um high, const Regions& area, const geometry::SegmentIndex& edge, Um within) const;

  const SupportSettings& settings() const { return s_; }
  const Object& object() const { return o_; }

 private:
  struct Outlines {
    Regions regions;
    std::vector<Box> boxes;
  };
  Regions within_bounds(const Region& region, const Box& box, bool& cut) const;
  /// An area that something may be kept out of.
  struct Place {
    Box box;
    const Regions& area;
    geometry::SegmentIndex edge;
  };
  /// The part in that height, as far as it comes as near to a place.
  Regions part_near(Um low, Um high, const Place& place, Um within) const;
  /// The part less than a gap above or below, and what else is not to be entered.
  Regions kept_out(const Stack::Level& level, const Place& place, const Regions& part_beside) const;
  /// Where no support may be on a level, near a place: what is further from contacts than a nozzle keeps
  /// support_xy_distance, what is beside them support_xy_distance_overhang.
  Regions barred(const Stack::Level& level, const Place& place, const Regions& contacts, const Regions* above) const;
  Regions stair(const Stack::Level& level, const Box& near) const;

  const SupportSettings& s_;
  const Object& o_;
  Um beside_, close_;
  std::vector<Outlines> outlines_;  ///< of the object's layers, with no more corners than support can tell
  geometry::SegmentIndex bounds_;   ///< of the object's room
};

/// Of each level, what of the plane has something of the object anywhere below: what cannot stand on the plate.
std::vector<Regions> shadows(const Room& room, const Stack& stack);

}  // namespace weft::support
