// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/clipper_door.h"

#include <cstddef>
#include <vector>

/// What of a sweep's input can be swept by itself; private to geometry/.
namespace weft::geometry::clipper {

/// The box of a ring, on the fine grid.
struct FineBox {
  FinePoint min, max;
};

/// Rings that meet none of other heaps.
struct Heap {
  struct Item {
    FineBox box;
    const FineRing* ring;
    bool clip;
  };
  std::vector<Item> items;
  FineBox box;
  int around_subject = 0, around_clip = 0;  ///< how often rings of other heaps go round all of this one

  /// Its rings, those around it as frames: rectangles around its box, none on another one.
  struct Input {
    FineRings subject, clip;
  };
  Input input() const;
  /// Whether a ring of what was made of the input is one of the frames.
  bool is_frame(const Ring& ring, Point origin) const;
};

/// A sweep over all rings at once would take rings^1.5 steps. Cuts between boxes, across and along in turn, as long as
/// there is a gap to cut in; where few rings go round all others, as a plate's does round its holes, these are cut by
/// themselves. Cost: n log n.
std::vector<Heap> heaps_of(const FineRings& subject, const FineRings& clip);

}  // namespace weft::geometry::clipper
