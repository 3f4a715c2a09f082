// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "support/field.h"
#include "support/patches.h"
#include "support/room.h"
#include "tasks/spare.h"

#include <optional>
#include <vector>

namespace weft::support {

/// Contacts, by level, that branches hold and that columns hold.
struct Split {
  std::vector<Regions> for_branches, for_columns;
  std::optional<Field> field;        ///< around what branches might hold: where there is no such thing, none
  std::optional<Patches> patches{};  ///< of all contacts, where it was asked what they are
};

/// Of each patch of contacts what takes less plastic. Neither is planned for that: columns are looked at every two
/// millimetres, branches as lines; and thin strips that are not high are known to take columns.
/// @param spare  a large patch of strips takes as long as all others
Split cheaper(const Room& room, const Stack& stack, const std::vector<Regions>& contacts, tasks::Spare& spare);

}  // namespace weft::support
