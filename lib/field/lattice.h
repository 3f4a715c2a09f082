// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "field/words.h"

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace weft::field {

/// What a number of a file is.
enum class Kind { density, direction };

/// Nodes of a regular grid with as many numbers each: one, a density; three, a vector; six or nine, a tensor
/// (xx yy zz xy yz zx, or by rows). Lengths in mm.
struct Lattice {
  std::array<double, 3> size{1, 1, 1}, from{0, 0, 0}, step{1, 1, 1};
  std::size_t components = 1;
  std::vector<float> values;  ///< by slice, row, column, component
  std::vector<int> lines;     ///< of each node in the file, where that has lines

  std::size_t count() const { return static_cast<std::size_t>(size[0] * size[1] * size[2]); }
  /// `800 values, 1000 (10 × 10 × 10) expected`
  std::string expected(std::size_t found) const;
};

/// Checks that the numbers of nodes are whole, and not too many of them. @throws Error{settings}
void check_size(const Lattice& lattice, const Words& words);

/// As people write them: 4.1e9.
std::string round_number(double v);

/// Readers. @throws Error{settings} with path, and line where the format has lines
Lattice read_vtk(std::string_view bytes, const std::string& path, Kind kind);
Lattice read_vti(std::string_view bytes, const std::string& path, Kind kind);
Lattice read_csv(std::string_view bytes, const std::string& path, Kind kind);

}  // namespace weft::field
