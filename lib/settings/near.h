// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// Levenshtein distance. Source: Wagner & Fischer 1974, two rows.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// "did you mean 'a' or 'b'?": the names nearest to a wrong one, those that it is a part of first, at most three; when
/// nothing is near, the first few names.
std::string did_you_mean(std::string_view wrong, const std::vector<std::string>& names);

}  // namespace weft
