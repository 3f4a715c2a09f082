// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/figures.h"

#include <fmt/format.h>

namespace weft {

std::string short_duration(double seconds) {
  const auto s = static_cast<long long>(seconds + 0.5);
  return s < 60     ? fmt::format("{} s", s)
         : s < 3600 ? fmt::format("{}m {:02}s", s / 60, s % 60)
                    : fmt::format("{}h {:02}m", s / 3600, s / 60 % 60);
}

}  // namespace weft
