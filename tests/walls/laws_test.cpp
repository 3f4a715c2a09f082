#include "geometry/boolean.h"
#include "walls/shapes.h"
#include "walls/walls.h"

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::test;

namespace {

WallLayer walls_of(const Regions& regions) {
  WallSettings settings;
  settings.wall_line_count = 4;
  settings.min_feature_size = 0.001_mm;
  settings.min_wall_length = 0;
  settings.flow_compensation = false;
  const SlicedLayer layer = layer_of(regions);
  return walls::build(settings, {.layer = layer, .index = 1});
}

/// How far p lies outside, µm; 0 inside.
double outside(const Regions& regions, Point p) {
  double best = 1e9;
  for (const Region& region : regions) {
    bool in = side_of(region.outer, p) != Side::outside;
    std::vector<const Ring*> rings{&region.outer};
    for (const Ring& hole : region.holes) {
      if (side_of(hole, p) == Side::inside) in = false;
      rings.push_back(&hole);
    }
    if (in) return 0;
    for (const Ring* ring : rings)
      for (std::size_t i = 0; i < ring->size(); ++i) {
        const Point a = (*ring)[i], b = (*ring)[(i + 1) % ring->size()];
        const double d2 = static_cast<double>(distance2(a, b));
        const double t = d2 > 0 ? std::clamp(static_cast<double>(dot(p - a, b - a)) / d2, 0.0, 1.0) : 0;
        best = std::min(best, std::hypot(p.x - a.x - t * (b.x - a.x), p.y - a.y - t * (b.y - a.y)));
      }
  }
  return best;
}

}  // namespace

TEST_CASE("walls: on 1,000 random polygons beads and inside together have the area of the region", "[walls][law]") {
  std::mt19937 random(20'240'601);
  double worst = 0, mean = 0;
  int off = 0, count = 0, astray = 0;
  for (int i = 0; i < 1000; ++i) {
    const Regions regions = geometry::regions_from_rings(std::vector<Ring>{random_ring(random)});
    const double area = area_mm2(regions);
    if (area < 0.05) continue;
    const auto walls = walls_of(regions);
    const double error = std::abs(area_mm2(walls.inside) + bead_area_mm2(walls) - area) / area;
    worst = std::max(worst, error);
    mean += error;
    ++count;
    if (error > 0.005) ++off;
    bool inside = true;
    for (const Bead& bead : walls.beads)
      for (const Junction& j : bead.path) inside = inside && outside(regions, j.at) <= 2;
    if (!inside) ++astray;
  }
  mean /= count;
  INFO("mean " << 100 * mean << " %, worst " << 100 * worst << " %, over 0.5 %: " << off << ", astray: " << astray
               << " of " << count);
  CHECK(count > 900);
  CHECK(mean < 0.01);
  // What is left are parts hardly larger than a bead with several branches: known, and to become fewer.
  CHECK(off <= 70);
  CHECK(astray <= 5);
}

TEST_CASE("walls: moving a part by whole microns moves every bead and changes nothing else", "[walls][law]") {
  std::mt19937 random(3);
  for (int i = 0; i < 50; ++i) {
    const Regions regions = geometry::regions_from_rings(std::vector<Ring>{random_ring(random)});
    const Point by{-7, 90'001};
    auto here = walls_of(regions), there = walls_of(moved(regions, by));
    for (Bead& bead : here.beads)
      for (Junction& j : bead.path) j.at = j.at + by;
    CHECK(here.beads == there.beads);
  }
}
