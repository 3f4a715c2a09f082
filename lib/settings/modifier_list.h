// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace weft {

/// A mesh in which infill has a density of its own, and a pattern, unless that is empty.
struct DenseMesh {
  std::string file, density_percent, pattern;
};

/// `boss.stl:80, core.stl:5:gyroid`; empty of an empty text.
/// @throws std::invalid_argument that says what is wrong
std::vector<DenseMesh> parse_modifier_list(std::string_view text);

/// The same list; @ref parse_modifier_list reads it back.
std::string text_of(const std::vector<DenseMesh>& meshes);

}  // namespace weft
