// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace weft::mesh {

/// What somebody painted on a facet: nothing, or an enforcer or a blocker.
enum class Paint { none = 0, enforcer = 1, blocker = 2 };

struct PaintedFacet {
  Paint paint = Paint::none;
  std::array<Eigen::Vector3d, 3> corners;
};

/// A piece of a facet that is painted for an extruder.
struct TintedFacet {
  int state = 0;  ///< the extruder, counted from 1
  std::array<Eigen::Vector3d, 3> corners;
};

/// The painted pieces of a triangle, of the attribute `slic3rpe:mmu_segmentation` or `paint_color`, in the digits that
/// painted_facets explains. A leaf of state 3 or more says 3 in its digit; 15 for each F that follows and another digit
/// come on top of that.
/// @return nothing when the text ends inside of a split triangle, or holds what is no digit
std::optional<std::vector<TintedFacet>> tinted_facets(std::string_view text,
                                                      const std::array<Eigen::Vector3d, 3>& corners);

/// The painted pieces of a triangle, of the attribute `slic3rpe:custom_supports` or `paint_supports`: hexadecimal
/// digits read from the last to the first. The low two bits of a digit say how many sides are split, 0 a leaf, whose
/// paint is in the high two bits; of a split they name the corner that the pieces begin at, and one piece more than
/// sides split follows, the one listed last first.
/// @return nothing when the text ends inside of a split triangle, or holds what is no digit
std::optional<std::vector<PaintedFacet>> painted_facets(std::string_view text,
                                                        const std::array<Eigen::Vector3d, 3>& corners);

}  // namespace weft::mesh
