// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "support/field.h"
#include "support/patches.h"
#include "support/support.h"

#include <span>
#include <vector>

namespace weft::support {

/// Branches for contacts.
struct Tree {
  std::vector<Regions> areas;  ///< by level
  std::vector<Regions> roofs;  ///< by level: interfaces that lie on branches
  std::vector<Joists> joists;  ///< by level: the lowest of them
  std::vector<Point3> tips_at;
  std::size_t trunks = 0;
  double slenderest = 0;  ///< height by diameter where a trunk stands
};

/// Tips stand so near that no place of a contact is further than support_tree_branch_distance from one; branches lean
/// no more than support_tree_angle, meet where that is no long way, and get down to the plate, or else to the part.
/// Source: Vanek, Galicia, Benes 2014, "Clever support"; Schmidt & Umetani 2014, "Branching support structures".
Tree tree(const Room& room, const Stack& stack, const Field& field, const std::vector<Regions>& contacts);

/// What branches for the contacts of each patch would take, mm³: those that patches share count for each by its tips,
/// and what no branch gets to as columns. Points only: cheap beside the areas of branches.
/// @param enough  of each patch: what takes more need be reckoned no further, once all do
std::vector<double> branches_mm3(const Room& room, const Stack& stack, const Field& field,
                                 const std::vector<Regions>& contacts, const Patches& patches,
                                 std::span<const double> enough);

}  // namespace weft::support
