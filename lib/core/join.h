// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <string_view>

namespace weft {

/// The words with the separator between them. (fmt::join does the same, and GCC 12 warns of it at -O3.)
template <class Words>
std::string joined(const Words& words, std::string_view separator = ", ") {
  std::string out;
  bool first = true;
  for (const auto& word : words) {
    if (!first) out += separator;
    out += word;
    first = false;
  }
  return out;
}

}  // namespace weft
