// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "support/field.h"
#include "support/room.h"

#include <vector>

namespace weft::support {

/// Contacts, by level, that branches hold and that columns hold.
struct Split {
  std::vector<Regions> for_branches, for_columns;
};

/// Of each patch of contacts what takes less plastic. Neither is planned for that: columns are looked at every two
/// millimetres, branches as lines.
Split cheaper(const Room& room, const Stack& stack, const Field& field, const std::vector<Regions>& contacts);

}  // namespace weft::support
