// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes broken in every way that exports break them, with the area that a person would expect of each layer.
#include "mesh/repair.h"
#include "mesh/weld.h"
#include "slice/slice.h"
#include "solids.h"

#include <functional>

#include <catch2/catch.hpp>

namespace {
using namespace weft;
using solids::add_box;

constexpr Um side = 20'000, top = 10'000;

/// A triangle by its corners.
void add(Mesh& mesh, Point3 a, Point3 b, Point3 c) {
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {a, b, c});
  mesh.triangles.push_back({base, base + 1, base + 2});
}

Mesh cube() {
  return solids::box({0, 0, 0}, {side, side, top});
}

/// The cube with its wall at x = side made of two rows of triangles whose corners do not meet: T-junctions.
Mesh with_t_junctions() {
  Mesh mesh = cube();
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    return std::all_of(t.begin(), t.end(), [&](auto v) { return mesh.vertices[v].x == side; });
  });
  const auto quad = [&](Um y0, Um y1, Um z0, Um z1) {
    add(mesh, {side, y0, z0}, {side, y1, z0}, {side, y1, z1});
    add(mesh, {side, y0, z0}, {side, y1, z1}, {side, y0, z1});
  };
  quad(0, side, 0, top / 2);
  for (Um y = 0; y < side; y += side / 5) quad(y, y + side / 5, top / 2, top);
  return mesh;
}

/// As a reader hands meshes on: every place once.
Mesh welded(const Mesh& mesh) {
  mesh::Weld weld(mesh.vertices.size());
  Mesh out;
  for (auto t : mesh.triangles) {
    for (auto& corner : t) corner = weld.index(mesh.vertices[corner]);
    out.triangles.push_back(t);
  }
  out.vertices = weld.take_vertices();
  return out;
}

struct Broken {
  const char* what;
  std::function<Mesh()> make;
  std::vector<double> area_mm2;  ///< of layers at 1, 5 and 9 mm
};

const std::vector<Broken> series{
    {"sound", cube, {400, 400, 400}},
    {"a triangle missing",
     [] {
       Mesh m = cube();
       m.triangles.erase(m.triangles.begin() + 4);
       return m;
     },
     {400, 400, 400}},
    {"no top",
     [] {
       Mesh m = cube();
       m.triangles.erase(m.triangles.begin() + 2, m.triangles.begin() + 4);
       return m;
     },
     {400, 400, 400}},
    {"T-junctions", with_t_junctions, {400, 400, 400}},
    {"some triangles flipped",
     [] {
       Mesh m = cube();
       for (const std::size_t i : {1U, 6U, 7U}) std::swap(m.triangles[i][0], m.triangles[i][1]);
       return m;
     },
     {400, 400, 400}},
    {"the whole shell flipped",
     [] {
       Mesh m;
       add_box(m, {0, 0, 0}, {side, side, top}, true);
       return m;
     },
     {400, 400, 400}},
    {"one shell of two flipped",
     [] {
       Mesh m = cube();
       add_box(m, {30'000, 0, 0}, {40'000, 10'000, top}, true);
       return m;
     },
     {500, 500, 500}},
    {"overlapping solids",
     [] {
       Mesh m = cube();
       add_box(m, {10'000, 10'000, 0}, {30'000, 30'000, 5'000});
       return m;
     },
     {700, 400, 400}},
    {"a solid nested in a solid",
     [] {
       Mesh m = cube();
       add_box(m, {5'000, 5'000, 2'000}, {15'000, 15'000, 8'000});
       return m;
     },
     {400, 400, 400}},
    {"a void",
     [] {
       Mesh m = cube();
       add_box(m, {5'000, 5'000, 2'000}, {15'000, 15'000, 8'000}, true);
       return m;
     },
     {400, 300, 400}},
    {"a solid in a void",
     [] {
       Mesh m = cube();
       add_box(m, {5'000, 5'000, 2'000}, {15'000, 15'000, 8'000}, true);
       add_box(m, {8'000, 8'000, 4'000}, {12'000, 12'000, 6'000});
       return m;
     },
     {400, 316, 400}},
    {"an inner wall of one sheet",
     [] {
       Mesh m = cube();
       add(m, {10'000, 0, 0}, {10'000, side, 0}, {10'000, side, top});
       add(m, {10'000, 0, 0}, {10'000, side, top}, {10'000, 0, top});
       return m;
     },
     {400, 400, 400}},
    {"solids that share a wall",
     [] {
       Mesh m = cube();
       add_box(m, {side, 0, 0}, {2 * side, side, top});
       return m;
     },
     {800, 800, 800}},
    {"a fin without thickness",
     [] {
       Mesh m = cube();
       for (const bool back : {false, true}) {
         const Point3 a{side, 10'000, 0}, b{30'000, 10'000, 0}, c{30'000, 10'000, top};
         back ? add(m, a, c, b) : add(m, a, b, c);
       }
       return m;
     },
     {400, 400, 400}},
    {"every shell twice",
     [] {
       Mesh m = cube();
       add_box(m, {0, 0, 0}, {side, side, top});
       return m;
     },
     {400, 400, 400}},
    {"every shell twice, a hair apart",
     [] {
       Mesh m = cube();
       add_box(m, {3, 3, 3}, {side + 3, side + 3, top + 3});
       return m;
     },
     {400, 400, 400}},
    {"crossing bars",
     [] {
       Mesh m = solids::box({0, 5'000, 0}, {side, 15'000, top});
       add_box(m, {5'000, 0, 0}, {15'000, side, top});
       return m;
     },
     {300, 300, 300}},
};

}  // namespace

TEST_CASE("broken: every mesh of the series has the area that a person would expect, layer by layer", "[law]") {
  for (const auto& broken : series) {
    CAPTURE(broken.what);
    const auto repaired = mesh::repair(welded(broken.make()));
    const std::vector<slice::Plane> planes{{1'100, 200, 1'000}, {5'100, 200, 5'000}, {9'100, 200, 9'000}};
    const slice::Cutter cutter(repaired.mesh, planes);
    LayerSettings fine;
    fine.resolution = 13;
    for (std::size_t i = 0; i < planes.size(); ++i) {
      CAPTURE(i);
      double area = 0;
      for (const auto& region : cutter.cut(i, fine).layer.regions) area += area_mm2(region);
      CHECK(area == Approx(broken.area_mm2[i]).margin(0.5));
    }
  }
}
