// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "support/room.h"
#include "support/tree.h"

#include <optional>
#include <vector>

namespace weft::support {

/// Contacts, by level, that branches hold and that columns hold.
struct Split {
  std::vector<Regions> for_branches, for_columns;
  std::optional<Tree> branches;  ///< of for_branches, where they are known already
};

/// Of each patch of contacts what takes less plastic: both are planned, and their beads reckoned.
Split cheaper(const SupportSettings& settings, const Object& object, const Stack& stack,
              const std::vector<KeepOut>& keep_out, const std::vector<Regions>& contacts);

}  // namespace weft::support
