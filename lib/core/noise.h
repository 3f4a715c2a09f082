// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>

/// Noise in space: the same everywhere and for everyone, from whole numbers alone.
namespace weft::noise {

struct Place {
  double x = 0, y = 0, z = 0;  ///< in sizes of what is to be seen
};

/// Waves between −1 and 1, about one in a unit. With `octaves` above 1 smaller ones lie over them, each half as large
/// and half as high as those before. Cost: 30 ns an octave. Source: K. Perlin 2002, "Improving noise"; the gradients
/// are chosen by an integer hash instead of a table.
double perlin(std::uint64_t seed, Place at, int octaves);

/// The same of |perlin|: cushions with seams between them, −1 … 1.
double billow(std::uint64_t seed, Place at, int octaves);

/// The same upside down, and squared: crests, −1 … 1. Source: F. K. Musgrave 1994, ridged multifractal, without the
/// weighting of an octave by that before it.
double ridged(std::uint64_t seed, Place at, int octaves);

/// Plates around points of chance, one in each unit, each as high as its point is told by chance, −1 … 1.
/// Source: S. Worley 1996, "A cellular texture basis function".
double voronoi(std::uint64_t seed, Place at);

}  // namespace weft::noise
