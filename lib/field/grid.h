// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <optional>
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

/// Symmetric tensors in the plane on a regular grid, of stress or of a direction (stretched along it).
struct TensorGrid {
  Grid xx, yy, xy;  ///< on the same nodes

  /// The direction of the larger principal value against X, −π/2 … π/2, of the tensor between the nodes; nothing
  /// where both are alike: σx = σy, τ = 0, all directions are principal there.
  /// Source: Mohr 1882; θ = ½ atan2(2τ, σx − σy).
  std::optional<double> direction_at(double x, double y, double z) const;
};

/// Most numbers of a grid.
inline constexpr std::size_t most_values = 256'000'000;

/// A picture's darkness, 0 white … 1 black, its lower edge first; nodes 1 apart from (0.5, 0.5).
/// @param bytes of a .png or .pgm  @param path as the user typed it, for messages
/// @throws Error{settings} for what is neither, or is cut short
Grid read_picture(std::string_view bytes, const std::string& path);

/// VTK's legacy STRUCTURED_POINTS with one SCALARS (ASCII or BINARY), VTK's .vti with one array (text, base64 or
/// appended, also compressed), or CSV of x, y, z, value on a lattice.
/// @param most  of a value, 1 or 100: a number beyond 0 … most is refused
/// @throws Error{settings} with path:line, or path
Grid read_grid(std::string_view bytes, const std::string& path, double most);

/// The same with VECTORS or TENSORS, with an array of 3, 6 or 9 components, or CSV of x, y, z and six stresses.
/// @throws Error{settings}, also for a tensor that is not symmetric
TensorGrid read_tensors(std::string_view bytes, const std::string& path);

}  // namespace weft::field
