// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace weft::prusaslicer {

/// A setting that OrcaSlicer and BambuStudio keep beside objects, in PrusaSlicer's words: key and value. Nothing when
/// PrusaSlicer has no such thing. Source: both programs' settings as their documentation and their projects name them.
std::optional<std::pair<std::string, std::string>> from_orca(std::string_view key, std::string_view value);

}  // namespace weft::prusaslicer
