// SPDX-License-Identifier: GPL-3.0-or-later
#include "slice/paint.h"

#include "core/polygon.h"

#include <cmath>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::literals;

namespace {

/// The facets of a 20 × 20 × 4 mm block at the origin that `wanted` says of their normal.
Mesh facets_facing(int axis, int sign) {
  Mesh block;
  for (int i = 0; i < 8; ++i)
    block.vertices.push_back({(i & 1) != 0 ? 20_mm : 0, (i & 2) != 0 ? 20_mm : 0, (i & 4) != 0 ? 4_mm : 0});
  block.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                     {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  std::erase_if(block.triangles, [&](const Triangle& t) {
    const auto on = [&](std::uint32_t v) {
      const Point3 p = block.vertices[v];
      const Um at = axis == 0 ? p.x : axis == 1 ? p.y : p.z;
      return sign > 0 ? at > 0 : at == 0;
    };
    return !(on(t[0]) && on(t[1]) && on(t[2]));
  });
  return block;
}

std::vector<slice::Plane> planes() {
  std::vector<slice::Plane> out;
  for (Um z = 200; z <= 4_mm; z += 200) out.push_back({z, 200, z - 100});
  return out;
}

double mm2(const Regions& regions) {
  double sum = 0;
  for (const auto& region : regions) {
    sum += static_cast<double>(double_area(region.outer)) / 2e6;
    for (const auto& hole : region.holes) sum += static_cast<double>(double_area(hole)) / 2e6;
  }
  return sum;
}

const Regions square{{{{0, 0}, {20_mm, 0}, {20_mm, 20_mm}, {0, 20_mm}}, {}}};

/// By paint and layer.
std::vector<std::vector<Regions>> areas_of(const std::vector<Mesh>& painted, const std::vector<slice::Plane>& at,
                                           slice::PaintReach reach) {
  const slice::Paint paint(painted, at, reach);
  std::vector<std::vector<Regions>> out(painted.size());
  for (std::size_t i = 0; i < at.size(); ++i) {
    auto areas = paint.areas(i, square);
    for (std::size_t k = 0; k < areas.size(); ++k) out[k].push_back(std::move(areas[k]));
  }
  return out;
}

}  // namespace

TEST_CASE("paint: a painted wall reaches as deep as is asked for, and its ends run along the bisectors") {
  const std::vector<Mesh> painted{facets_facing(0, 1)};  // x = 20
  const auto at = planes();
  const auto areas = areas_of(painted, at, {.depth = 3_mm});
  REQUIRE(areas.size() == 1);
  for (const auto& layer : areas[0]) {
    // A band of 3 mm less a triangle of 3 × 3 mm at each end.
    CHECK(mm2(layer) == Approx(20 * 3 - 2 * 4.5).margin(0.01));
    for (const auto& region : layer) CHECK(box_of(region.outer).min.x == Approx(17_mm).margin(5));
  }
}

TEST_CASE("paint: two paints meet on the bisector, and share nothing") {
  const std::vector<Mesh> painted{facets_facing(0, 1), facets_facing(1, 1)};
  const auto at = planes();
  const auto areas = areas_of(painted, at, {.depth = 3_mm});
  REQUIRE(areas.size() == 2);
  CHECK(mm2(areas[0][5]) == Approx(mm2(areas[1][5])).margin(0.01));
  CHECK(mm2(areas[0][5]) == Approx(20 * 3 - 2 * 4.5).margin(0.01));
}

TEST_CASE("paint: a painted roof reaches down through the shells, a floor up, and no further") {
  const auto at = planes();
  for (const int sign : {1, -1}) {
    const std::vector<Mesh> painted{facets_facing(2, sign)};
    const auto areas = areas_of(painted, at, {.depth = 3_mm, .roof = 800, .floor = 800});
    std::size_t covered = 0;
    for (std::size_t i = 0; i < at.size(); ++i) {
      const bool near = sign > 0 ? at[i].z > 4_mm - 800 : at[i].z <= 800;
      INFO(at[i].z);
      if (near) CHECK(mm2(areas[0][i]) == Approx(400).margin(0.5));
      if (!near) CHECK(mm2(areas[0][i]) == Approx(0).margin(0.01));
      covered += mm2(areas[0][i]) > 1;
    }
    CHECK(covered == 4);
  }
}
