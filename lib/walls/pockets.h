#pragma once
#include "core/polygon.h"
#include "walls/trace.h"

#include <vector>

/// Private to walls: what lines leave of a part.
namespace weft::walls {

struct Pocket {
  std::vector<Place> ring;  ///< what lies within holes of it counts as part of it
  double area = 0;          ///< µm²
};

/// Largest first; slivers are none. Open lines only.
std::vector<Pocket> pockets_of(const Region& region, Point origin, const std::vector<Line>& lines);

}  // namespace weft::walls
