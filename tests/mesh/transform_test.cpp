// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/transform.h"

#include "fixtures.h"
#include "mesh/facings.h"
#include "mesh/repair.h"

#include <cmath>
#include <random>

#include <catch2/catch.hpp>

using namespace weft;
using fixtures::box;

namespace {

Mesh mesh_of(const fixtures::Facets& facets) {
  return fixtures::read(fixtures::binary_stl(facets)).objects.front().mesh;
}

bool closed(const Mesh& mesh) {
  return mesh::repair(mesh).repairs.watertight();
}

/// An L of 20 × 10 × 20 mm, 5 mm thick, with a hole of 4 × 4 mm from below through its foot.
Mesh angle() {
  auto facets = box({0, 0, 0}, {20, 10, 5}) + box({0, 0, 5}, {5, 10, 20});
  return mesh_of(facets + fixtures::reversed(box({10, 3, -1}, {14, 7, 6})));
}

std::array<double, 3> unit(double x, double y, double z) {
  const double d = std::hypot(x, y, z);
  return {x / d, y / d, z / d};
}

}  // namespace

TEST_CASE("transform: quarter turns are exact, and four of them are none") {
  const Mesh mesh = mesh_of(box({1, 2, 3}, {11, 22, 33}));
  for (const int axis : {0, 1, 2}) {
    Mesh turned = mesh;
    for (int i = 0; i < 4; ++i) turned = mesh::transformed(std::move(turned), mesh::turned_about(axis, 90), {});
    CHECK(turned == mesh);
    CHECK(mesh::turned_about(axis, 450) == mesh::turned_about(axis, 90));
  }
  const auto up = box_of(mesh::transformed(mesh, mesh::turned_about(0, 90), {}));  // y becomes z
  CHECK((up.min.z == 2000 && up.max.z == 22000 && up.min.y == -33000 && up.max.y == -3000));
}

TEST_CASE("transform: a mirrored mesh has the same volume, and its outside is outside") {
  const Mesh mesh = angle();
  for (const std::array<double, 3> by : {std::array<double, 3>{-1, 1, 1}, {1, -1, 1}, {-1, -1, -1}, {-1, -1, 1}}) {
    const Mesh mirrored = mesh::transformed(mesh, mesh::stretched_along(by), {5000, 5000, 5000});
    CHECK(volume_mm3(mirrored) == Approx(volume_mm3(mesh)).epsilon(1e-9));
    CHECK(mirrored.triangles.size() == mesh.triangles.size());
  }
  const Mesh flat = mesh::transformed(mesh, mesh::stretched_along({2, 1, 0.5}), {});
  CHECK(box_of(flat).size() == Point3{40000, 10000, box_of(mesh).size().z / 2});
}

TEST_CASE("transform: laid on a direction it points down, and lengths stay") {
  std::mt19937 random(3);  // any
  const auto number = [&] { return static_cast<double>(random() % 2001) / 1000 - 1; };
  for (int i = 0; i < 50; ++i) {
    const auto d = i == 0 ? unit(0, 0, 1) : i == 1 ? unit(0, 0, -1) : unit(number(), number(), number() + 1e-3);
    const auto m = mesh::laid_on({d[0] * 7, d[1] * 7, d[2] * 7});
    for (std::size_t r = 0; r < 3; ++r)
      CHECK(m[r][0] * d[0] + m[r][1] * d[1] + m[r][2] * d[2] == Approx(r == 2 ? -1 : 0).margin(1e-9));
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b)
        CHECK(m[a][0] * m[b][0] + m[a][1] * m[b][1] + m[a][2] * m[b][2] == Approx(a == b ? 1 : 0).margin(1e-9));
  }
}

TEST_CASE("cut: both halves of a closed mesh are closed and have its volume together") {
  const Mesh tube = mesh_of(box({0, 0, 0}, {20, 20, 30}) + fixtures::reversed(box({5, 5, 5}, {15, 15, 25})));
  for (const Um z : {1, 4999, 5000, 5001, 12345, 25000, 29999}) {
    const auto halves = mesh::cut_at(tube, z);
    INFO(z);
    CHECK(box_of(halves.lower).max.z == z);
    CHECK(box_of(halves.upper).min.z == z);
    CHECK(volume_mm3(halves.lower) + volume_mm3(halves.upper) == Approx(volume_mm3(tube)).epsilon(1e-9));
    CHECK(closed(halves.lower));
    CHECK(closed(halves.upper));
  }
  CHECK(volume_mm3(mesh::cut_at(tube, 10000).lower) == Approx(20 * 20 * 10 - 10 * 10 * 5));
}

TEST_CASE("cut: of a slanted mesh halves are closed too, and nothing is where nothing was") {
  const Mesh mesh = mesh::transformed(mesh_of(box({0, 0, 0}, {20, 10, 30})),
                                      mesh::product(mesh::turned_about(1, 33), mesh::turned_about(0, 21)), {});
  const Box3 whole = box_of(mesh);
  for (const Um z : {whole.min.z + 700, 0, 5000, whole.max.z - 700}) {
    const auto halves = mesh::cut_at(mesh, z);
    CHECK(closed(halves.lower));
    CHECK(closed(halves.upper));
    CHECK(volume_mm3(halves.lower) + volume_mm3(halves.upper) == Approx(6000).epsilon(1e-4));
  }
  CHECK(mesh::cut_at(mesh, whole.min.z).lower.triangles.empty());
  CHECK(mesh::cut_at(mesh, whole.max.z + 1).upper.triangles.empty());
}

TEST_CASE("split: bodies that share no edge come apart, and a void stays in its body") {
  const auto facets = box({0, 0, 0}, {10, 10, 10}) + box({20, 0, 0}, {30, 10, 10}) +
                      fixtures::reversed(box({22, 2, 2}, {28, 8, 8})) + box({24, 4, 4}, {26, 6, 6});
  const auto bodies = mesh::split(mesh_of(facets));
  REQUIRE(bodies.size() == 3);
  CHECK(volume_mm3(bodies[0]) == Approx(1000));
  CHECK(volume_mm3(bodies[1]) == Approx(1000 - 216));
  CHECK(volume_mm3(bodies[2]) == Approx(8));
  const Mesh one = mesh_of(box({0, 0, 0}, {10, 10, 10}));
  REQUIRE(mesh::split(one).size() == 1);
  CHECK(mesh::split(one).front() == one);
}

TEST_CASE("facings: a box may be laid on each of its faces, the largest first") {
  const Mesh mesh = mesh_of(box({0, 0, 0}, {30, 20, 10}));
  const auto hull = mesh::hull_of(mesh);
  CHECK(hull.corners.size() == 8);
  const auto facings = mesh::facings_of(mesh, hull, 40, 24);
  REQUIRE(facings.size() == 6);
  CHECK(facings[0].down == std::array<double, 3>{0, 0, -1});  // as it is
  CHECK(facings[1].mm2 == Approx(600));
  CHECK(facings[1].down[2] == Approx(1));
  CHECK(facings[5].mm2 == Approx(200));
}

TEST_CASE("facings: what leans out, its height and the foot are those of the facets") {
  const Mesh mesh = mesh_of(box({0, 0, 0}, {4, 4, 20}) + box({-8, -8, 20}, {12, 12, 24}));  // a table on one leg
  const mesh::Facets facets(mesh, mesh::hull_of(mesh));
  const auto standing = facets.laid({0, 0, -1}, 50), lying = facets.laid({0, 0, 1}, 50);
  CHECK(standing.foot_mm2 == Approx(16));
  CHECK(standing.steep_mm2 == Approx(400));
  CHECK(standing.steep_mm3 == Approx(400 * 20));
  CHECK(standing.height_mm == Approx(24));
  CHECK(lying.foot_mm2 == Approx(400));
  CHECK(lying.steep_mm2 == Approx(16));  // the leg's top, which lies on the plate
}
