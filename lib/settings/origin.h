// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

namespace weft {

/// Where a value came from.
struct Origin {
  std::string where;   ///< "farm.ini:12" or "--set"
  std::string text;    ///< the value as it stood there
  std::string source;  ///< what was translated, "[print:*common*] perimeter_speed = 45", or what it follows from
};

}  // namespace weft
