// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "walls/beading.h"
#include "walls/skeleton.h"

#include <cstdint>
#include <optional>
#include <vector>

/// Private to walls: which beads lie on each piece of the skeleton, and where.
namespace weft::walls {

/// Beads along one edge of the skeleton, the same on both its sides.
struct Span {
  bool core = false;     ///< beads follow the thickness; else the edge runs into a corner where they turn back
  bool middle = false;   ///< a bead on the axis itself
  bool open = false;     ///< the axis lies in what is left for infill, from bounds[pairs] inwards
  bool narrows = false;  ///< the innermost wall gets narrower towards a sharp corner
  bool mouth = false;    ///< climbs from a thin part, whose beads end below it, into a thick one
  int pairs = 0;         ///< beads on either side, each between bounds[i] and bounds[i + 1]
  std::uint32_t at_start = 0, at_end = 0;  ///< where the bounds begin in Laying::bounds, for the ends of the even half
};

/// How inner walls bend around the foot of a rib that stands in a corner which points into the part.
struct Mitre {
  double out = 1;   ///< so many times as far from it as they were if they bent round
  double axis = 0;  ///< how far from it the middle between the walls of both sides is; 0: where the axis is
  /// That they bend before the next rib.
  struct Bend {
    Place way;      ///< where a wall 1 µm from the sides of the corner does, from its foot
    double middle;  ///< so far from them is the middle
  };
  std::optional<Bend> bend{};
};

struct Laying {
  std::vector<Span> spans;  ///< by edge
  std::vector<double> bounds;
  std::vector<std::uint32_t> dots;  ///< a half that leaves a node which is all there is of a bead
  /// By half, of the rib at its start.
  std::vector<Mitre> mitres;
  /// Bounds at the start (end) of a half.
  const double* start(std::uint32_t half) const {
    const Span& s = spans[Skeleton::edge_of(half)];
    return &bounds[half % 2 == 0 ? s.at_start : s.at_end];
  }
  const double* end(std::uint32_t half) const { return start(Skeleton::twin(half)); }
};

struct LayingOptions {
  double steep = 0.22;         ///< |d clearance / d length| above which an edge runs into a corner, unless it leads on
  double steep_tip = 0.38;     ///< … where there is room for a single bead only: it is led into the tip
  double ramp = 400;           ///< length of a transition, µm
  double filter = 1000;        ///< a change of count undone within this length is left out, µm
  double corner_width = 0.75;  ///< share of its width that a wall keeps where it bends around a sharp corner
  double narrowest = 200;      ///< … if that is not less than this, µm
  double filter_deviation = 100;  ///< … where the thickness is no further than this from the change, µm
};

/// Decides the beads. Adds nodes to the skeleton where their number changes.
Laying lay(Skeleton& skeleton, const Widths& widths, const LayingOptions& options);

}  // namespace weft::walls
