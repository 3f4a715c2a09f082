// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/settings.h"

#include <string>
#include <vector>

namespace weft::prusaslicer {

/// Settings as PrusaSlicer's config.ini, and what of them it has no words for.
struct Exported {
  std::string text;
  std::vector<std::string>
      lost;  ///< `key = value` of settings that are not weft's default and have no counterpart there
};

/// Law: what this writes says the same to `translate` as it was made from, as far as it is mapped; automatic widths and
/// first-layer values become the numbers that they stand for. Placeholders in custom G-code take PrusaSlicer's names.
Exported exported(const Settings& settings);

}  // namespace weft::prusaslicer
