// SPDX-License-Identifier: GPL-3.0-or-later
#include "contour/contour.h"

#include "contour/ascend.h"

#include <array>
#include <cmath>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::contour;

namespace {

/// A wedge 40 × 20 mm whose top rises along x from 1 mm by that tangent.
Mesh wedge(double slope) {
  const Um low = 1'000, high = low + rounded(40'000 * slope);
  Mesh mesh;
  mesh.vertices = {{0, 0, 0},   {40'000, 0, 0},    {40'000, 20'000, 0},    {0, 20'000, 0},
                   {0, 0, low}, {40'000, 0, high}, {40'000, 20'000, high}, {0, 20'000, low}};
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                    {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  return mesh;
}

LayerPlan top_line(Um z, Point a, Point b) {
  LayerPlan layer{.z = z, .height = 200, .time = {.index = 9, .number = 9}};
  layer.steps.emplace_back(ObjectStart{0});
  layer.steps.emplace_back(Travel{{{a.x, a.y, z}}});
  layer.steps.emplace_back(Extrude{.path = {{a, 400, 1.F}, {b, 400, 1.F}}, .role = Role::top_skin, .height = 200});
  layer.steps.emplace_back(ObjectEnd{0});
  return layer;
}
const Extrude& bead_of(const LayerPlan& layer) {
  for (const Step& step : layer.steps)
    if (const auto* bead = std::get_if<Extrude>(&step)) return *bead;
  throw std::logic_error("no bead");
}

}  // namespace

TEST_CASE("contour: the surface is found from above, on edges too, and not where the model goes on above") {
  const Mesh mesh = wedge(0.1);
  const std::array meshes{&mesh};
  const Surface surface(meshes);
  for (const Point at : {Point{10'000, 5'000}, {20'000, 10'000}, {40'000 / 3, 20'000 / 3}}) {  // two on the diagonal
    const auto found = surface.between(at, 0, 10'000);
    REQUIRE(found);
    CHECK(found->z_um == Approx(1'000 + 0.1 * at.x));
    CHECK(found->slope == Approx(0.1));
    CHECK_FALSE(surface.between(at, found->z_um + 1, 10'000));
    CHECK_FALSE(surface.between(at, 0, found->z_um - 1));
  }
  CHECK_FALSE(surface.between({-1, 5'000}, 0, 10'000));
  Mesh block = wedge(0);  // it covers the slope
  for (auto& v : block.vertices) v.z = v.z == 0 ? 900 : 5'000;
  const std::array<const Mesh*, 2> both{&mesh, &block};
  CHECK_FALSE(Surface(both).between({10'000, 5'000}, 0, 4'500));
  CHECK(Surface(both).between({10'000, 5'000}, 0, 6'000)->z_um == Approx(5'000));
  for (auto& v : block.vertices) v.z += 3'000;  // air lies between
  CHECK(Surface(both).between({10'000, 5'000}, 0, 3'000)->z_um == Approx(2'000));
}

TEST_CASE("contour: a bead on a gentle slope lies on it, and holds what its height asks for") {
  const Mesh mesh = wedge(0.08);
  const std::array meshes{&mesh};
  const Surface surface(meshes);
  const Standing standing{&surface, {}, 0};
  const Rules rules{true, 60, 500};
  // The layer whose middle is at 2 mm: its surface reaches from x = 12.5 to 15 mm.
  auto layer = top_line(2'100, {12'600, 10'000}, {14'900, 10'000});
  follow(std::span(&rules, 1), std::span(&standing, 1), layer);
  const Extrude& bead = bead_of(layer);
  REQUIRE(bead.below.size() == bead.path.size());
  CHECK(bead.follows_surface);
  double volume = 0, meant = 0;
  for (std::size_t i = 0; i < bead.path.size(); ++i) {
    const double surface_um = 1'000 + 0.08 * bead.path[i].at.x;
    CHECK(2'100 - bead.below[i] == Approx(surface_um).margin(6));
    CHECK(static_cast<double>(bead.path[i].flow) == Approx((200.0 - bead.below[i]) / 200).margin(0.03));
    if (i == 0) continue;
    const double mm = distance(bead.path[i - 1].at, bead.path[i].at) / 1000;
    volume += mm * mean_area_mm2(bead.path[i - 1], bead.path[i], 0.2);
    meant += mm * 0.4 * ((1'000 + 0.08 * (bead.path[i - 1].at.x + bead.path[i].at.x) / 2.0) - 1'900) / 1000;
  }
  CHECK(volume == Approx(meant).epsilon(0.03));
  // Ways go over what was raised.
  for (const Step& step : layer.steps)
    if (const auto* travel = std::get_if<Travel>(&step))
      for (const Point3 p : travel->path) CHECK(p.z >= 2'100 + 80);
}

TEST_CASE("contour: steep slopes, first layers, covered beads and other roles stay") {
  const Mesh gentle = wedge(0.08), steep = wedge(0.3);
  const Rules rules{true, 60, 500};
  const auto stays = [&](const Mesh& mesh, LayerPlan layer, Um lift = 0) {
    const std::array meshes{&mesh};
    const Surface surface(meshes);
    const Standing standing{&surface, {}, lift};
    follow(std::span(&rules, 1), std::span(&standing, 1), layer);
    return bead_of(layer).below.empty();
  };
  const auto line = top_line(2'100, {12'600, 10'000}, {14'900, 10'000});
  CHECK_FALSE(stays(gentle, line));
  CHECK(stays(steep, top_line(2'100, {3'400, 10'000}, {3'900, 10'000})));
  auto first = line;
  first.time.number = 0;
  CHECK(stays(gentle, first));
  CHECK(stays(gentle, top_line(1'100, {12'600, 10'000}, {14'900, 10'000})));  // far below the surface
  auto infill = line;
  std::get<Extrude>(infill.steps[2]).role = Role::infill;
  CHECK(stays(gentle, infill));
  // On a raft the object stands higher.
  CHECK(stays(gentle, line, 900));
  CHECK_FALSE(stays(gentle, top_line(3'000, {12'600, 10'000}, {14'900, 10'000}), 900));
}

TEST_CASE("contour: beads keep a least height") {
  const Mesh mesh = wedge(0.08);
  const std::array meshes{&mesh};
  const Surface surface(meshes);
  const Standing standing{&surface, {}, 0};
  const Rules rules{true, 150, 500};
  auto layer = top_line(2'100, {12'600, 10'000}, {14'900, 10'000});
  follow(std::span(&rules, 1), std::span(&standing, 1), layer);
  for (const Um below : bead_of(layer).below) CHECK(below <= 50);
}

TEST_CASE("contour: lines on a slope ascend, on a level top they stay as they are") {
  const Mesh slope = wedge(0.08), flat = wedge(0);
  // A zigzag along y that begins at the upper end.
  Bead zigzag;
  zigzag.role = Role::top_skin, zigzag.sequence = 3;
  for (int i = 0; i < 5; ++i) {
    const Um x = 14'800 - 400 * i;
    const Um from = i % 2 == 0 ? 2'000 : 18'000, to = i % 2 == 0 ? 18'000 : 2'000;
    zigzag.path.push_back({{x, from}, 400, 1.F});
    zigzag.path.push_back({{x, to}, 400, 1.F});
  }
  Bead wall;
  wall.path = {{{0, 0}, 400, 1.F}, {{9'000, 0}, 400, 1.F}};
  const std::array<const Mesh*, 1> sloping{&slope}, level{&flat};
  Beads beads{wall, zigzag};
  ascend(Surface(sloping), {2'100, 200}, beads);
  REQUIRE(beads.size() == 6);
  CHECK(beads[0] == wall);
  for (std::size_t i = 2; i < beads.size(); ++i) {
    CHECK(beads[i].path.front().at.x >= beads[i - 1].path.front().at.x);
    CHECK(beads[i].sequence == 3);
  }
  double before = 0, after = 0;
  before = length_mm(zigzag);
  for (std::size_t i = 1; i < beads.size(); ++i) after += length_mm(beads[i]);
  CHECK(after == Approx(before));
  Beads same{zigzag};
  ascend(Surface(level), {1'000, 200}, same);
  CHECK(same == Beads{zigzag});
}
