// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <optional>

/// Areas that are narrow and long.
namespace weft::infill {

/// The direction (against X) that an edge has on the mean, weighted by the square of its parts' lengths: ends that
/// slant do not turn it. And the share of its length that runs one way, less what runs across.
struct EdgeDirection {
  double angle_rad = 0, share = 0;
};
EdgeDirection direction_of_edge(const Region& region);

/// The direction (against X) of a straight strip no wider than some lines: across it they would be dabs with a turn
/// between each two, on every second layer.
std::optional<double> angle_along_strip(const Region& region, Um band);

/// Whether an area is a strip everywhere no wider than some lines, and long.
bool is_strip(const Region& region, Um band);

}  // namespace weft::infill
