// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "walls/laying.h"

#include <vector>

/// Private to walls: joins the beads of the pieces to lines.
namespace weft::walls {

struct Line {
  struct Vertex {
    Place at;
    double width = 0;  ///< band, µm
  };
  std::vector<Vertex> path;
  bool closed = false;
  int inset = 0;
  bool first_meets = false, last_meets = false;  ///< the part goes on beyond the end: it meets a wall there
};

inline Line::Vertex lerp(const Line::Vertex& a, const Line::Vertex& b, double t) {
  return {lerp(a.at, b.at, t), a.width + t * (b.width - a.width)};
}

double length_of(const std::vector<Line::Vertex>& path);
/// What a bead covers on its way from one vertex to another, µm².
inline double area_between(const Line::Vertex& a, const Line::Vertex& b) {
  return distance(a.at, b.at) * (a.width + b.width) / 2;
}
/// … and on all of an open path.
double area_of(const std::vector<Line::Vertex>& path);
/// Takes `by` from the end of a path; a point is left at least.
void cut_end(std::vector<Line::Vertex>& path, double by);

/// Walls on both sides of the axis: closed without exception, because what joins pieces is a permutation of them.
std::vector<Line> trace_pairs(const Skeleton& skeleton, const Laying& laying);
/// Beads on the axis, led on to the ends of the part.
std::vector<Line> trace_middles(const Skeleton& skeleton, const Laying& laying);
/// Outlines of what is left for infill, material on the left.
std::vector<std::vector<Place>> trace_rest(const Skeleton& skeleton, const Laying& laying);

}  // namespace weft::walls
