// SPDX-License-Identifier: GPL-3.0-or-later
#include "slice/heights.h"

#include "solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::slice;

namespace {

/// Layers above a first one of 0.2 mm, of the heights that the surface asks for.
std::vector<Plane> fitted(const Mesh& mesh, const HeightRules& rules = {}, Um error = 80) {
  const std::array meshes{&mesh};
  const Um top = box_of(mesh).max.z;
  std::vector<Plane> out{{200, 200, 100}};
  const auto rest = fitted_planes(relief_of(meshes, top, error), rules, 200, top, 200);
  out.insert(out.end(), rest.begin(), rest.end());
  return out;
}

/// A cone or a cylinder about the z axis.
Mesh cone(Um r0, Um r1, Um height, int sides = 60) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {0, 0, height}};
  for (const auto& [r, z] : {std::pair(r0, Um{0}), {r1, height}})
    for (int i = 0; i < sides; ++i) {
      const double a = 2 * std::numbers::pi * i / sides;
      mesh.vertices.push_back({rounded(r * std::cos(a)), rounded(r * std::sin(a)), z});
    }
  for (int i = 0; i < sides; ++i) {
    const auto a = static_cast<std::uint32_t>(2 + i), b = static_cast<std::uint32_t>(2 + (i + 1) % sides),
               c = a + static_cast<std::uint32_t>(sides), d = b + static_cast<std::uint32_t>(sides);
    for (const Triangle& t : {Triangle{a, b, d}, Triangle{a, d, c}, Triangle{0, b, a}, Triangle{1, c, d}})
      mesh.triangles.push_back(t);
  }
  return mesh;
}

Um off(const std::vector<Plane>& planes, Um z) {
  Um least = max_coord;
  for (const Plane& plane : planes) least = std::min(least, std::abs(plane.z - z));
  return least;
}

void check_stack(const std::vector<Plane>& planes) {
  Um below = 0;
  for (const Plane& plane : planes) {
    CHECK(plane.z - plane.height == below);
    CHECK(plane.below > below);
    CHECK(plane.below < plane.z);
    below = plane.z;
  }
}

}  // namespace

TEST_CASE("heights: layers lie on each other, keep to their bounds and end on top") {
  for (const Um top : {5'000, 12'345, 20'001}) {
    const auto planes = fitted(solids::box({0, 0, 0}, {10'000, 10'000, top}));
    check_stack(planes);
    CHECK(planes.back().z == top);
    for (std::size_t i = 1; i < planes.size(); ++i) {
      CHECK(planes[i].height >= 65);
      CHECK(planes[i].height <= 305);
    }
    // As few as there can be.
    CHECK(planes.size() == 1 + static_cast<std::size_t>(std::ceil((top - 200 - 5) / 300.0)));
  }
}

TEST_CASE("heights: a cylinder stays even") {
  const auto planes = fitted(cone(10'000, 10'000, 20'000));
  for (std::size_t i = 2; i < planes.size(); ++i) CHECK(std::abs(planes[i].height - planes[i - 1].height) <= 10);
}

TEST_CASE("heights: steps of a block are ends of layers") {
  Mesh steps;
  std::vector<Um> heights{1'230, 3'333, 5'870, 9'999};
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const auto x = static_cast<Um>(10'000 * i);
    solids::add_box(steps, {x, 0, 0}, {x + 9'000, 10'000, heights[i]});
  }
  const auto planes = fitted(steps);
  check_stack(planes);
  for (const Um z : heights) CHECK(off(planes, z) == 0);
  // Without meeting them, they are missed.
  const auto blind = fitted(steps, {.flats = false});
  Um missed = 0;
  for (const Um z : heights) missed += off(blind, z);
  CHECK(missed > 0);
}

TEST_CASE("heights: gentle slopes get thin layers, by the bound that their cusp sets") {
  for (const double degrees : {30.0, 60.0, 85.0}) {
    const Um height = 10'000, run = rounded(height * std::tan(degrees * std::numbers::pi / 180));
    const auto planes = fitted(cone(run + 2'000, 2'000, height), {}, 60);
    // Above the middle no edge is near; the normal rises by the sine of the slope against the upright.
    const double most = 60 / (0.184 + std::sin(degrees * std::numbers::pi / 180) / 2);
    INFO(degrees << "°: " << most);
    std::vector<Um> middle;
    for (const Plane& plane : planes)
      if (plane.z > 3'000 && plane.z < 7'000) middle.push_back(plane.height);
    CHECK(*std::max_element(middle.begin(), middle.end()) <= most);
    CHECK(*std::max_element(middle.begin(), middle.end()) > most - 12);
  }
}

TEST_CASE("heights: specks ask for nothing") {
  Mesh mesh = solids::box({0, 0, 0}, {20'000, 20'000, 10'000});
  const Mesh speck = cone(300, 100, 10'300, 8);  // stands on the box by 0.3 mm, steep and small
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Point3 v : speck.vertices) mesh.vertices.push_back({v.x + 10'000, v.y + 10'000, v.z});
  for (const Triangle& t : speck.triangles) mesh.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  const std::array meshes{&mesh};
  const auto relief = relief_of(meshes, 10'300, 80);
  for (const Um most : relief.most) CHECK(most > 300);
}

TEST_CASE("heights: even layers are stretched by up to a tenth to meet faces") {
  Mesh steps;
  for (const auto& [x, z] : {std::pair(0, 4'070), {10'000, 7'950}, {20'000, 12'130}})
    solids::add_box(steps, {x, 0, 0}, {x + 9'000, 10'000, z});
  const auto planes = fitted(steps, {.least = 180, .most = 220, .wanted = 200});
  check_stack(planes);
  for (const Um z : {4'070, 7'950, 12'130}) CHECK(off(planes, z) == 0);
  std::size_t usual = 0;
  for (const Plane& plane : planes) {
    CHECK(plane.height >= 175);
    CHECK(plane.height <= 225);
    usual += plane.height == 200;
  }
  CHECK(usual > planes.size() / 2);
}

TEST_CASE("heights: a profile is read as it was written: linear, looked up half a least height above each layer") {
  const std::vector<mesh::HeightAt> profile{{0, 200}, {2'000, 200}, {4'000, 100}, {10'000, 100}};
  const auto planes = profile_planes(profile, 250, 70, 10'000);
  check_stack(planes);
  CHECK(planes.front().height == 250);
  CHECK(planes[1].height == 200);
  for (std::size_t i = 1; i < planes.size(); ++i) {
    const Um at = planes[i].z - planes[i].height + 35;
    const double wanted = at < 2'000 ? 200 : at < 4'000 ? 200 - (at - 2'000) / 20.0 : 100;
    CHECK(planes[i].height == Approx(wanted).margin(1));
  }
  CHECK(std::abs(planes.back().z - 10'000) <= 50);
}

TEST_CASE("heights: how well layers meet a surface is told") {
  const Mesh slope = cone(20'000, 10'000, 10'000);
  const std::array meshes{&slope};
  std::vector<LayerHeight> layers;
  for (Um z = 200; z <= 10'000; z += 200) layers.push_back({z, 200});
  const auto surface = surface_of(meshes, layers);
  CHECK(surface.cusp_um_mm2 / surface.mm2 == Approx(200 * std::sqrt(0.5)).epsilon(0.01));
  CHECK(surface.faces == 1);
  CHECK(surface.missed_um == 0);
  layers.pop_back();
  CHECK(surface_of(meshes, layers).missed_um == 200);
}
