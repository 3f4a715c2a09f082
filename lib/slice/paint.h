// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "mesh/mesh.h"
#include "slice/slice.h"

#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace weft::slice {

/// How far what is painted on a surface reaches into the part.
struct PaintReach {
  Um depth = 0;  ///< from walls, across a layer; above 0
  Um roof = 0;   ///< down from what faces up
  Um floor = 0;  ///< up from what faces down
  Um least = 0;  ///< what is narrower everywhere goes with what is beside it: no bead fits in
};

/// What of each layer belongs to which paint: what lies no deeper than that below painted outline and nearer to it than
/// to any other, and what lies below painted roofs and above painted floors.
class Paint {
 public:
  /// @param painted facets of the surface, a mesh a paint
  /// Pre: planes ascend, and outlive this, as the meshes do not have to
  Paint(std::span<const Mesh> painted, std::span<const Plane> planes, PaintReach reach);

  /// Is anything of layer i painted?
  bool touches(std::size_t i) const;
  /// The regions of each paint on layer i. Borders run along the bisectors of the outline (its Voronoi diagram).
  /// Post: regions of paints do not overlap.  Cost: that of the outline's medial axis, 4 µs a vertex.
  std::vector<Regions> areas(std::size_t i, const Regions& outline) const;

 private:
  /// Where a painted facet crosses a plane.
  struct Segment {
    Point a, b;
  };
  std::vector<std::vector<Segment>> crossings(const Mesh& facets) const;
  std::vector<Regions> reached(const Mesh& facets, Um reach, bool up) const;

  void add_near(const Region& region, std::span<const Point> borders, const std::function<int(Point)>& kind_at,
                std::vector<Regions>& own) const;
  void add_flat(std::size_t i, const Regions& outline, std::vector<Regions>& own) const;
  bool is_narrow(const Region& region) const;

  std::span<const Plane> planes_;
  PaintReach reach_;
  std::vector<std::vector<std::vector<Segment>>> cuts_;  ///< by paint and layer
  std::vector<std::vector<Regions>> flats_;              ///< below roofs and above floors, likewise
};

}  // namespace weft::slice
