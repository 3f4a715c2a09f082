// SPDX-License-Identifier: GPL-3.0-or-later
#include "slice/paint.h"

#include "core/polygon.h"
#include "geometry/boolean.h"

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

namespace {

/// Upright facets along an open or closed line, 4 mm high.
Mesh fence(const Ring& line, bool closed) {
  Mesh out;
  const auto n = static_cast<std::uint32_t>(line.size());
  for (const Point p : line)
    for (const Um z : {Um{0}, 4_mm}) out.vertices.push_back({p.x, p.y, z});
  for (std::uint32_t i = 0; i + (closed ? 0 : 1) < n; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % n);
    out.triangles.push_back({a, b, b + 1});
    out.triangles.push_back({a, b + 1, a + 1});
  }
  return out;
}

std::size_t corners_of(const Regions& regions) {
  std::size_t out = 0;
  for (const Ring& ring : geometry::rings_of(regions)) out += ring.size();
  return out;
}

}  // namespace

TEST_CASE("paint: round a reflex corner it is as deep as along walls") {
  const Ring ell{{0, 0}, {20_mm, 0}, {20_mm, 10_mm}, {10_mm, 10_mm}, {10_mm, 20_mm}, {0, 20_mm}};
  const std::vector<Mesh> painted{fence({{20_mm, 10_mm}, {10_mm, 10_mm}, {10_mm, 20_mm}}, false)};
  const auto at = planes();
  const slice::Paint paint(painted, at, {.depth = 3_mm});
  const auto areas = paint.areas(5, {{ell, {}}});
  REQUIRE(areas.size() == 1);
  // Two bands less the triangles at their ends, and a quarter of a circle.
  const double quarter = 3.14159265 * 9 / 4;
  CHECK(mm2(areas[0]) == Approx(2 * (10 * 3 - 4.5) + quarter).margin(0.03));
}

TEST_CASE("paint: what is painted all round is a ring as deep as asked for, with the outline's own corners") {
  Ring round;
  for (int i = 0; i < 120; ++i) {
    const double angle = i * 2 * 3.14159265358979 / 120;
    round.push_back({rounded(10000 * std::cos(angle)), rounded(10000 * std::sin(angle))});
  }
  const std::vector<Mesh> painted{fence(round, true)};
  const auto at = planes();
  const slice::Paint paint(painted, at, {.depth = 3_mm});
  const Regions outline{{round, {}}};
  const auto areas = paint.areas(5, outline);
  CHECK(mm2(areas[0]) == Approx(mm2(outline) * (1 - 0.7 * 0.7)).epsilon(0.002));
  // Nothing is left beside it but what is deeper: corners between the outline's own would leave slivers there.
  const auto rest = geometry::subtract(outline, areas[0]);
  REQUIRE(rest.size() == 1);
  CHECK(rest[0].holes.empty());
  CHECK(mm2(rest) == Approx(mm2(outline) * 0.7 * 0.7).epsilon(0.002));
  CHECK(corners_of(areas[0]) <= 2 * round.size() + 2);
}

TEST_CASE("paint: a thin part painted all round is painted throughout") {
  const Ring bar{{0, 0}, {20_mm, 0}, {20_mm, 4_mm}, {0, 4_mm}};
  const std::vector<Mesh> painted{fence(bar, true)};
  const auto at = planes();
  const slice::Paint paint(painted, at, {.depth = 3_mm});
  const auto areas = paint.areas(5, {{bar, {}}});
  REQUIRE(areas[0].size() == 1);
  CHECK(areas[0][0].outer.size() == 4);
  CHECK(mm2(areas[0]) == Approx(80));
}
