// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>

namespace weft {

/// Which settings hold at a place: index into the scopes of the plate (settings/scopes.h). 0: the plate's own.
using ScopeId = std::uint16_t;

}  // namespace weft
