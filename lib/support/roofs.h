// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "support/joists.h"
#include "support/room.h"
#include "support/support.h"

#include <vector>

namespace weft::support {

/// Interfaces that lie on branches: few thick branches under a roof hold what many thin ones would, and the part lies
/// on strands side by side. The lowest level of a roof is joists from branch to branch, or strands between rows of
/// branches would hang. What is too narrow for a roof is held by tips themselves.
class Roofs {
 public:
  enum class Use { laid, reckoned };
  /// @param contacts  by level; they outlive this
  /// @param use       roofs that are only reckoned take all of a slope for what lies beside a level of it, which is
  /// found once
  Roofs(const Room& room, const Stack& stack, const std::vector<Regions>& contacts, Use use);

  /// What tips that end on this level hold by themselves.
  const Regions& bare(std::size_t level) const { return bare_[level]; }
  /// The underside of what lies right above this level.
  const Regions& begins_above(std::size_t level) const { return begins_[level]; }
  /// The same with what begins nearby, a little higher or lower; empty where nothing does.
  const Regions& around(std::size_t level) const { return around_[level]; }

  /// Branches on a level, and how far from them a roof may lie: of those that come from above it is not yet known which
  /// way they lean.
  struct Branches {
    std::vector<Point> tips, passing;
  };
  struct Spans {
    Um of_tips, of_passing;
  };
  /// Lays the roofs that begin above that level where they rest on branches.
  void rest(std::size_t level, const Branches& branches, Spans spans);

  /// By level, within the room, and where there is something left of branches in their room.
  struct Laid {
    std::vector<Regions> areas;
    std::vector<Joists> joists;
  };
  Laid laid(const std::vector<Regions>& branches) &&;

 private:
  /// A roof on branches of a level, up to a contact.
  struct Resting {
    std::size_t level, contact;
    Regions area;
  };
  void lay(const std::vector<Regions>& branches);
  struct OfLevel {
    Regions area;
    Joists joists;
  };
  OfLevel of_level(std::size_t level, const std::vector<Regions>& branches) const;
  JoistPlace place_on(std::size_t level, const std::vector<Regions>& branches, const Regions& dense) const;
  Regions shaped(const Regions& area, std::size_t level) const;
  struct Floor;
  std::vector<Floor> floors(Um least, std::vector<std::size_t>& floor_of) const;
  struct Beside {
    Regions around, wide;
  };
  std::vector<Beside> beside_contacts(Use use) const;
  void begin_roofs(Use use);

  const Room& room_;
  const SupportSettings& s_;
  const Object& o_;
  const Stack& stack_;
  const std::vector<Regions>& contacts_;
  std::vector<Regions> bare_, begins_, around_, laid_;
  std::vector<std::vector<std::size_t>> held_from_;  ///< of each level: the contacts whose roofs begin above it
  std::vector<Regions> wide_;                        ///< of each contact, what gets a roof
  std::vector<Resting> resting_;
  std::vector<Regions> lowest_;           ///< of each level, the roofs' that begin there
  std::vector<std::vector<Point>> tips_;  ///< of each level, what those lie on
};

}  // namespace weft::support
