// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>

namespace weft {

/// A tool is one filament in one nozzle, counted from 0 as firmware does: `T0`.
using ToolId = std::uint8_t;

/// Whatever is loaded.
inline constexpr ToolId any_tool = 255;

}  // namespace weft
