// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

namespace weft {

/// Odd but printable: part of a stage's result. Reaches standard error and the report's "warnings".
struct Notice {
  std::string code;     ///< stable, snake_case: "open_contour_closed"
  std::string message;  ///< a sentence with place and size: "layer 12 (z 2.500): a gap of 0.03 mm was closed"
  friend bool operator==(const Notice&, const Notice&) = default;
};
using Notices = std::vector<Notice>;

}  // namespace weft
