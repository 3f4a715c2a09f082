// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "mesh/mesh.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

/// Models put close together on the bed by their true outlines.
namespace weft::pipeline {

/// What the mesh covers seen from above. The edges between triangles that face up and those that do not enclose, by
/// winding number, just what some triangle that faces up covers. Of an open mesh: about. Cost: a union of those edges.
Regions silhouette_of(std::span<const Mesh> meshes);

/// One kind of thing to be placed.
struct NestKind {
  Regions outline;         ///< around (0, 0)
  std::size_t copies = 1;  ///< 0: as many as there is room for, in turns with others of 0
};

struct NestBed {
  Ring surface{};                ///< simple, counter-clockwise, maybe concave
  std::vector<Ring> keep_out{};  ///< that nothing may lie in
  Point middle{};                ///< what everything is near to
  Um spacing = 0;                ///< between outlines, at least
  Um beside = 0;                 ///< what lies around an outline, as a brim: on the bed, too
};

/// No-fit polygon: where `b` may not be, so as not to meet `a` in more than their edges. Convex ones are the sums of
/// corners; of others, the edges of one are swept along those of the other, and what that encloses counts as not free.
/// Source: Art, "An approach to the two dimensional irregular cutting stock problem"; Milenkovic, Daniels and Li.
Regions no_fit(const Ring& a, const Ring& b);

/// Places of each kind, as many as fit and are asked for; larger ones come first, and each stands at the corner of
/// what is free for it that is nearest to the middle; where not all fit so, the lowest, then leftmost is tried.
/// Deterministic. Law: outlines are at least `spacing` apart, and lie on the surface and off what is kept out.
/// Cost: a Boolean a kind and placed thing.
std::vector<std::vector<Point>> nest(std::span<const NestKind> kinds, const NestBed& bed);

}  // namespace weft::pipeline
