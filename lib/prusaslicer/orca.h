// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace weft::prusaslicer {

/// A setting that OrcaSlicer and BambuStudio keep beside objects, in PrusaSlicer's words: key and value. Nothing when
/// PrusaSlicer has no such thing. Source: both programs' settings as their documentation and their projects name them.
std::optional<std::pair<std::string, std::string>> from_orca(std::string_view key, std::string_view value);

/// A setting of theirs that PrusaSlicer has no word for, in weft's: keys and values. Empty when weft has no such thing.
std::vector<std::pair<std::string, std::string>> ours_of_orca(std::string_view key, std::string_view value);

/// A whole configuration of theirs as an ini of PrusaSlicer's: what a project says of the plate.
struct OrcaConfiguration {
  std::string ini;
  std::vector<std::pair<std::string, std::string>> ours;  ///< in weft's words
  std::vector<std::string> left_out;                      ///< keys that neither has
};
/// @param values key and value; of lists the elements between commas, of texts in quotes between semicolons
OrcaConfiguration orca_configuration(const std::vector<std::pair<std::string, std::string>>& values);

}  // namespace weft::prusaslicer
