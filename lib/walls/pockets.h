// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "walls/trace.h"

#include <vector>

/// Private to walls: what lines leave of a part.
namespace weft::walls {

struct Pocket {
  std::vector<Place> ring;
  double area = 0;  ///< µm²
};

/// Largest first; slivers thinner than 2 µm are none, nor is what surrounds a line. Pre: open lines, whose places count
/// from `origin`, µm.
std::vector<Pocket> pockets_of(const Region& region, Point origin, const std::vector<Line>& lines);

}  // namespace weft::walls
