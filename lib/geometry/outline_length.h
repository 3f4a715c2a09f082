// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

namespace weft::geometry {

/// Length of outlines, those of holes too, mm.
inline double outline_mm(const Region& region) {
  double um = perimeter_of(region.outer);
  for (const Ring& hole : region.holes) um += perimeter_of(hole);
  return um / 1000;
}
inline double outline_mm(const Regions& regions) {
  double mm = 0;
  for (const Region& region : regions) mm += outline_mm(region);
  return mm;
}

}  // namespace weft::geometry
