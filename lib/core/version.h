// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string_view>

namespace weft {

/// The one place where the version stands; CMake reads it from here.
inline constexpr std::string_view version = "0.1.0";

}  // namespace weft
