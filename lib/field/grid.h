// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace weft::field {

/// Numbers on a regular grid; a number stands at its node. Lengths in mm.
struct Grid {
  std::size_t columns = 0, rows = 0, slices = 1;
  double x0 = 0, y0 = 0, z0 = 0, dx = 1, dy = 1, dz = 1;
  std::vector<float> values;  ///< by slice, then by row, then by column

  /// Linear between nodes, constant beyond. Pre: not empty
  double at(double x, double y, double z = 0) const;
};

/// Most numbers of a grid.
inline constexpr std::size_t most_values = std::size_t{1} << 28;

/// A picture's darkness, 0 white … 1 black, its lower edge first; nodes 1 apart from (0.5, 0.5).
/// @param bytes of a .png or .pgm  @param path as the user typed it, for messages
/// @throws Error{settings} for what is neither, or is cut short
Grid read_picture(std::string_view bytes, const std::string& path);

/// VTK's legacy STRUCTURED_POINTS with one SCALARS (ASCII or BINARY), or CSV of x, y, z, value on a lattice.
/// @param most  of a value, 1 or 100: a number beyond 0 … most is refused
/// @throws Error{settings} with path:line
Grid read_grid(std::string_view bytes, const std::string& path, double most);

}  // namespace weft::field
