// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

namespace weft {

/// What tells one build of the running program from another: its version, and the linker's build id where there is one.
/// Results kept from another build are not taken for this one's.
const std::string& build_id();

}  // namespace weft
