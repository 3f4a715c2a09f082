// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <vector>

namespace weft::infill {

/// Chooses for each cell of a grid one of its two values, so that sums of cells near each other are what is asked for.
/// Cells by row.
struct Dithered {
  std::size_t columns = 0, rows = 0;
  std::vector<double> wanted, low, high;  ///< low ≤ wanted ≤ high
};

/// The error of each choice goes to neighbours that have none yet, 7, 3, 5 and 1 sixteenths of it; every second row is
/// walked backwards. @returns which cells take the high value
/// Source: Floyd & Steinberg 1976, "An adaptive algorithm for spatial greyscale"; serpentine: Ulichney 1987.
std::vector<bool> floyd_steinberg(const Dithered& cells);

/// A cell takes the high value where its share of it is more than a threshold, of a tile of 64 × 64 whose thresholds
/// are spread evenly, moved on by the golden ratio a layer.
/// @param first_column, first_row  of the cells, against where tiles begin
/// Source: Ulichney 1993, "Void-and-cluster method for dither array generation".
std::vector<bool> blue_noise(const Dithered& cells, long first_column, long first_row, std::size_t layer);

/// The tile's thresholds, by row, each of (k + ½) / 4096 once.
const std::vector<double>& blue_noise_tile();

}  // namespace weft::infill
