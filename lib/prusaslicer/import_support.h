// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "prusaslicer/lines.h"

#include <functional>
#include <string>
#include <string_view>

namespace weft::prusaslicer {

/// What the arithmetic below reads besides the lines, mm.
struct SupportBasis {
  double nozzle = 0.4, layer_height = 0.2;
};

/// `set(key, text, line)` for each setting of support and raft that depends on several keys.
void import_support(Lines& lines, const SupportBasis& basis,
                    const std::function<void(std::string_view, std::string, const IniEntry&)>& set);

}  // namespace weft::prusaslicer
