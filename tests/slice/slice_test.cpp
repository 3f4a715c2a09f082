// SPDX-License-Identifier: GPL-3.0-or-later
#include "slice/slice.h"

#include "corpus.h"
#include "geometry/spatial_index.h"
#include "mesh/fixtures.h"
#include "mesh/read.h"
#include "solids.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::slice;

namespace {
std::vector<Cut> cut_all(const Mesh& mesh, const LayerSettings& settings = {}) {
  const Cutter cutter(mesh, planes(settings, box_of(mesh).max.z));
  std::vector<Cut> cuts;
  for (std::size_t i = 0; i < cutter.size(); ++i) cuts.push_back(cutter.cut(i, settings));
  return cuts;
}

double volume_mm3(const std::vector<Cut>& cuts) {
  double sum = 0;
  for (const auto& cut : cuts) sum += area_mm2(cut.layer.regions) * to_mm(cut.layer.height);
  return sum;
}

/// A ball with facets of all directions, radius and centre in µm.
Mesh ball(Point3 centre, Um radius, int segments) {
  Mesh mesh;
  const auto vertex = [&](int ring, int k) {
    const double theta = std::numbers::pi * ring / segments, phi = std::numbers::pi * k / segments;
    mesh.vertices.push_back({centre.x + rounded(radius * std::sin(theta) * std::cos(phi)),
                             centre.y + rounded(radius * std::sin(theta) * std::sin(phi)),
                             centre.z + rounded(radius * std::cos(theta))});
  };
  vertex(0, 0);
  for (int r = 1; r < segments; ++r)
    for (int k = 0; k < 2 * segments; ++k) vertex(r, k);
  vertex(segments, 0);
  const auto id = [&](int r, int k) {
    return static_cast<std::uint32_t>(1 + (r - 1) * 2 * segments + k % (2 * segments));
  };
  const auto south = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  for (int k = 0; k < 2 * segments; ++k) {
    mesh.triangles.push_back({0, id(1, k), id(1, k + 1)});
    for (int r = 1; r + 1 < segments; ++r) {
      mesh.triangles.push_back({id(r, k), id(r + 1, k), id(r + 1, k + 1)});
      mesh.triangles.push_back({id(r, k), id(r + 1, k + 1), id(r, k + 1)});
    }
    mesh.triangles.push_back({id(segments - 1, k), south, id(segments - 1, k + 1)});
  }
  return mesh;
}

void check_proper(const std::vector<Cut>& cuts) {
  for (const auto& cut : cuts)
    for (const auto& region : cut.layer.regions) {
      CHECK(region.outer.size() >= 3);
      CHECK(double_area(region.outer) > 0);
      for (const auto& hole : region.holes) CHECK(double_area(hole) < 0);
    }
}
}  // namespace

TEST_CASE("slice: layers stand on each other, cut in their middle, the first of its own height") {
  LayerSettings settings;
  settings.layer_height = 0.2_mm;
  settings.initial_layer_height = 0.3_mm;
  const auto layers = planes(settings, 1.1_mm);
  REQUIRE(layers.size() == 5);
  CHECK(layers[0] == Plane{300, 300, 150});
  CHECK(layers[1] == Plane{500, 200, 400});
  CHECK(layers[4] == Plane{1100, 200, 1000});
}

TEST_CASE("slice: what remains at the top is a layer when it is at least half of one") {
  CHECK(planes(LayerSettings{}, 1000).size() == 5);
  CHECK(planes(LayerSettings{}, 1099).size() == 5);
  CHECK(planes(LayerSettings{}, 1100).size() == 6);
  CHECK(planes(LayerSettings{}, 22500).size() == 113);
  CHECK(planes(LayerSettings{}, 48000).size() == 240);
  CHECK(planes(LayerSettings{}, 0).empty());
}

TEST_CASE("slice: a layer that the model ends in the middle of is printed") {
  const auto cuts = cut_all(solids::box({0, 0, 0}, {20000, 20000, 22500}));
  REQUIRE(cuts.size() == 113);
  REQUIRE(cuts.back().layer.regions.size() == 1);
  CHECK(area_mm2(cuts.back().layer.regions) == Approx(400));
}

TEST_CASE("slice: a cube is a stack of squares") {
  const auto cuts = cut_all(solids::box({0, 0, 0}, {20000, 20000, 20000}));
  REQUIRE(cuts.size() == 100);
  for (const auto& cut : cuts) {
    REQUIRE(cut.layer.regions.size() == 1);
    CHECK(cut.layer.regions[0].outer.size() == 4);
    CHECK(cut.layer.regions[0].holes.empty());
    CHECK(area_mm2(cut.layer.regions) == 400);
    CHECK(cut.layer.height == 200);
  }
  CHECK(cuts.back().layer.z == 20000);
  CHECK(notices_of(cuts, "cube").empty());
}

TEST_CASE("slice: a void is a hole, and a solid in the void an island") {
  Mesh mesh = solids::box({0, 0, 0}, {20000, 20000, 4000});
  solids::add_box(mesh, {4000, 4000, 1000}, {16000, 16000, 3000}, true);
  solids::add_box(mesh, {8000, 8000, 1500}, {12000, 12000, 2500});
  const auto cuts = cut_all(mesh);
  CHECK(area_mm2(cuts[0].layer.regions) == 400);
  REQUIRE(cuts[5].layer.regions.size() == 1);
  CHECK(cuts[5].layer.regions[0].holes.size() == 1);
  CHECK(cuts[10].layer.regions.size() == 2);
  CHECK(area_mm2(cuts[10].layer.regions) == 400 - 144 + 16);
}

TEST_CASE("slice: solids that overlap or touch are one") {
  Mesh mesh = solids::box({0, 0, 0}, {10000, 10000, 2000});
  SECTION("overlap") {
    solids::add_box(mesh, {5000, 5000, 0}, {15000, 15000, 2000});
    for (const auto& cut : cut_all(mesh)) {
      CHECK(cut.layer.regions.size() == 1);
      CHECK(area_mm2(cut.layer.regions) == 175);
    }
  }
  SECTION("one in the other") {
    solids::add_box(mesh, {2000, 2000, 0}, {8000, 8000, 2000});
    for (const auto& cut : cut_all(mesh)) {
      REQUIRE(cut.layer.regions.size() == 1);
      CHECK(cut.layer.regions[0].holes.empty());
      CHECK(area_mm2(cut.layer.regions) == 100);
    }
  }
  SECTION("face on face") {
    solids::add_box(mesh, {10000, 0, 0}, {20000, 10000, 2000});
    for (const auto& cut : cut_all(mesh)) {
      REQUIRE(cut.layer.regions.size() == 1);
      CHECK(cut.layer.regions[0].outer.size() == 4);
      CHECK(area_mm2(cut.layer.regions) == 200);
    }
  }
}

namespace {
/// Adds a body between two quadrangles, each of its sides cut into n × n pairs of triangles.
void add_leaning(Mesh& mesh, const std::array<Point3, 4>& low, const std::array<Point3, 4>& high, int n) {
  std::map<std::array<Um, 3>, std::uint32_t> known;
  const auto vertex = [&](Point3 p) {
    const auto [at, added] = known.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(mesh.vertices.size()));
    if (added) mesh.vertices.push_back(p);
    return at->second;
  };
  const auto face = [&](Point3 a, Point3 b, Point3 c, Point3 d, int cuts) {
    const auto at = [&](int i, int j) {
      const double u = double(i) / cuts, v = double(j) / cuts;
      const auto along = [&](Um p, Um q, Um r, Um s) {
        return rounded((1 - v) * ((1 - u) * p + u * q) + v * ((1 - u) * s + u * r));
      };
      return vertex({along(a.x, b.x, c.x, d.x), along(a.y, b.y, c.y, d.y), along(a.z, b.z, c.z, d.z)});
    };
    for (int i = 0; i < cuts; ++i)
      for (int j = 0; j < cuts; ++j) {
        mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      }
  };
  for (std::size_t k = 0; k < 4; ++k) face(low[k], low[(k + 1) % 4], high[(k + 1) % 4], high[k], n);
  face(low[3], low[2], low[1], low[0], n);
  face(high[0], high[1], high[2], high[3], n);
}

/// How long the outlines are, mm.
double outlines_mm(const Regions& regions) {
  double um = 0;
  for (const Region& region : regions) {
    um += perimeter_of(region.outer);
    for (const Ring& hole : region.holes) um += perimeter_of(hole);
  }
  return um / 1000;
}
}  // namespace

TEST_CASE("slice: between bodies that touch on a leaning face, cut into triangles differently, there is no crack") {
  const Point3 a{13'100, 370, 0}, b{17'300, 20'110, 0}, up_a{14'400, 1'070, 15'000}, up_b{18'600, 20'810, 15'000};
  Mesh mesh;
  add_leaning(mesh, {Point3{-2'000, 0, 0}, a, b, {-1'000, 20'000, 0}},
              {Point3{-2'000, 0, 15'000}, up_a, up_b, {-1'000, 20'000, 15'000}}, 3);
  add_leaning(mesh, {a, {35'000, 0, 0}, {35'000, 20'000, 0}, b},
              {up_a, {35'000, 0, 15'000}, {35'000, 20'000, 15'000}, up_b}, 4);
  for (const Um resolution : {0, 13}) {
    LayerSettings settings;
    settings.resolution = resolution;
    for (const auto& cut : cut_all(mesh, settings)) {
      INFO(cut.layer.z);
      CHECK(cut.layer.regions.size() == 1);
      CHECK(outlines_mm(cut.layer.regions) < 116);  // 40 mm more where both sides of a crack are outlines
    }
  }
}

namespace {
/// Adds an upright prism over a ring; a hole's runs clockwise. Ends are left open: no cut goes through them.
void add_upright(Mesh& mesh, const Ring& ring, Um height) {
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size()), n = static_cast<std::uint32_t>(ring.size());
  for (const Point p : ring) mesh.vertices.push_back({p.x, p.y, 0});
  for (const Point p : ring) mesh.vertices.push_back({p.x, p.y, height});
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t a = base + i, b = base + (i + 1) % n;
    mesh.triangles.push_back({a, b, b + n});
    mesh.triangles.push_back({a, b + n, a + n});
  }
}

Ring polygon(double radius_um, int corners, double turned, bool clockwise) {
  Ring out;
  for (int i = 0; i < corners; ++i) {
    const double t = 2 * std::numbers::pi * (i + turned) / corners * (clockwise ? -1 : 1);
    out.push_back({rounded(radius_um * std::cos(t)), rounded(radius_um * std::sin(t))});
  }
  return out;
}

/// Outlines of a plate of 20 mm with a round hole of 24 corners and, in it, a plug of 17 with that much more radius,
/// mm: 80 when both are one, 38 more with a gap between them.
double plug_outlines_mm(double more_um, Um closing_radius) {
  Mesh mesh;
  add_upright(mesh, {{-10'000, -10'000}, {10'000, -10'000}, {10'000, 10'000}, {-10'000, 10'000}}, 1'000);
  add_upright(mesh, polygon(3'000, 24, 0, true), 1'000);
  add_upright(mesh, polygon(3'000 + more_um, 17, 0.3, false), 1'000);
  LayerSettings settings;
  settings.slice_closing_radius = closing_radius;
  double most_mm = 0;
  for (const auto& cut : cut_all(mesh, settings)) most_mm = std::max(most_mm, outlines_mm(cut.layer.regions));
  return most_mm;
}
}  // namespace

TEST_CASE("slice: a body in a hole of other facets is one with what is around it, unless the gap is wider") {
  // sagittas of 26 and 51 um: between bodies of the same radius both cross, and up to 51 um stay open
  CHECK(plug_outlines_mm(0, 49) == Approx(80).epsilon(0.01));
  CHECK(plug_outlines_mm(-20, 49) == Approx(80).epsilon(0.01));
  CHECK(plug_outlines_mm(0, 0) > 90);
  CHECK(plug_outlines_mm(-150, 49) == Approx(80 + 18.7 + 17.8).epsilon(0.01));
  CHECK(plug_outlines_mm(-150, 120) == Approx(80).epsilon(0.01));
}

TEST_CASE("slice: a gap between bodies is filled, and a notch of one of them stays as sharp as it is") {
  Mesh mesh;
  add_upright(mesh, {{0, 0}, {10'000, 0}, {10'000, 10'000}, {0, 10'000}, {0, 5'400}, {3'000, 5'000}, {0, 4'600}},
              1'000);
  add_upright(mesh, {{10'050, 0}, {20'000, 0}, {20'000, 10'000}, {10'050, 10'000}}, 1'000);
  LayerSettings settings;
  settings.slice_closing_radius = 49;
  const double notch_mm2 = 1.2, of_its_tip = 0.018;  // where it is narrower than 98 um
  for (const auto& cut : cut_all(mesh, settings)) {
    CHECK(cut.layer.regions.size() == 1);
    CHECK(area_mm2(cut.layer.regions) == Approx(200 - notch_mm2).margin(of_its_tip / 3));
  }
}

TEST_CASE("slice: missing triangles are bridged, said, and cost no other outline") {
  Mesh mesh = solids::box({0, 0, 0}, {10000, 10000, 2000});
  mesh.triangles.erase(mesh.triangles.begin() + 4, mesh.triangles.begin() + 6);  // the wall at y = 0
  solids::add_box(mesh, {20000, 0, 0}, {30000, 10000, 2000});
  const auto cuts = cut_all(mesh);
  for (const auto& cut : cuts) {
    CHECK(cut.layer.regions.size() == 2);
    CHECK(area_mm2(cut.layer.regions) == 200);
    CHECK(cut.bridged.count == 1);
    CHECK(cut.bridged.widest_um == 10000);
    CHECK(cut.closed.count == 0);
  }
  const auto notices = notices_of(cuts, "part.stl");
  REQUIRE(notices.size() == 1);
  CHECK(notices[0].code == "open_contour_bridged");
  CHECK(notices[0].message ==
        "part.stl: the mesh has holes; gaps in outlines were closed with straight lines: 10 on 10 layers; the widest, "
        "10.000 mm, is on layer 0 (z 0.200)");
  CHECK(notices[0].at == Point{5000, 0});
}

TEST_CASE("slice: walls that miss each other by a little are closed as small gaps") {
  Mesh mesh;  // four sheets, 50 µm apart at the corners
  const auto sheet = [&](Point a, Point b) {
    const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {{a.x, a.y, 0}, {b.x, b.y, 0}, {b.x, b.y, 1000}, {a.x, a.y, 1000}});
    mesh.triangles.push_back({base, base + 1, base + 2});
    mesh.triangles.push_back({base, base + 2, base + 3});
  };
  sheet({50, 0}, {10000, 0}), sheet({10000, 50}, {10000, 10000}), sheet({9950, 10000}, {0, 10000}),
      sheet({0, 9950}, {0, 0});
  for (const auto& cut : cut_all(mesh)) {
    REQUIRE(cut.layer.regions.size() == 1);
    CHECK(area_mm2(cut.layer.regions) == Approx(100).margin(0.02));
    CHECK(cut.closed.count == 4);
    CHECK(cut.closed.widest_um == 50);
    CHECK(cut.bridged.count == 0);
  }
}

TEST_CASE("slice: an inside-out solid is a solid") {
  Mesh mesh;
  solids::add_box(mesh, {0, 0, 0}, {10000, 10000, 1000}, true);
  for (const auto& cut : cut_all(mesh)) CHECK(area_mm2(cut.layer.regions) == 100);
}

TEST_CASE("slice: boxes that share an edge give closed outlines") {
  Mesh mesh = solids::box({0, 0, 0}, {10000, 10000, 2000});
  solids::add_box(mesh, {10000, 10000, 0}, {20000, 20000, 2000});
  for (auto& t : mesh.triangles)  // weld corners 3 and 7 of the first to 0 and 4 of the second: four faces at one edge
    for (auto& corner : t) corner = corner == 8 ? 3 : corner == 12 ? 7 : corner;
  for (const auto& cut : cut_all(mesh)) {
    CHECK(area_mm2(cut.layer.regions) == 200);
    CHECK(cut.closed.count + cut.bridged.count == 0);
  }
}

TEST_CASE("slice: a soup of loose triangles neither hangs nor throws") {
  std::mt19937 dice(5);
  const auto at = [&] { return static_cast<Um>(dice() % 20000); };
  Mesh mesh;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    for (int k = 0; k < 3; ++k) mesh.vertices.push_back({at(), at(), at()});
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  LayerSettings settings;
  settings.layer_height = 2_mm;
  const auto cuts = cut_all(mesh, settings);
  CHECK(cuts.size() == 10);
  check_proper(cuts);
  CHECK(cuts[5].bridged.count > 0);
}

TEST_CASE("slice: a mesh of nothing, flat triangles, a mesh below the bed") {
  CHECK(cut_all({}).empty());
  const Mesh flat{{{0, 0, 500}, {1000, 0, 500}, {0, 1000, 500}}, {{0, 1, 2}}};
  for (const auto& cut : cut_all(flat)) CHECK(cut.layer.regions.empty());
  const auto sunk = cut_all(solids::box({0, 0, -3000}, {10000, 10000, 1000}));
  REQUIRE(sunk.size() == 5);
  for (const auto& cut : sunk) CHECK(area_mm2(cut.layer.regions) == 100);
}

TEST_CASE("slice: moving a mesh by whole microns moves its layers and changes nothing else", "[law]") {
  const Point by = GENERATE(Point{1, 0}, Point{-7, 90'001}, Point{12'345'677, -3'000'001});
  Mesh mesh = ball({0, 0, 10000}, 10000, 20);
  const Mesh other = ball({7003, 5001, 9001}, 8000, 13);
  for (Triangle t : other.triangles) {
    for (auto& corner : t) corner += static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.triangles.push_back(t);
  }
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  const auto here = cut_all(mesh), there = cut_all(solids::moved(mesh, {by.x, by.y, 0}));
  REQUIRE(here.size() == there.size());
  for (std::size_t i = 0; i < here.size(); ++i) CHECK(there[i].layer.regions == moved(here[i].layer.regions, by));
}

TEST_CASE("slice: simplification keeps the outline within the resolution") {
  LayerSettings exact, coarse;
  exact.resolution = 0;
  coarse.resolution = 50_um;
  const Mesh mesh = ball({0, 0, 10000}, 10000, 150);
  const auto fine = cut_all(mesh, exact), simple = cut_all(mesh, coarse);
  for (std::size_t i = 0; i < fine.size(); ++i) {
    const geometry::SegmentIndex index(simple[i].layer.regions);
    for (const auto& region : fine[i].layer.regions)
      for (const Point p : region.outer) CHECK(index.nearest(p)->distance_um <= 50.0);
  }
  CHECK(simple[50].layer.regions[0].outer.size() * 3 < fine[50].layer.regions[0].outer.size());
}

TEST_CASE("slice: chords of a round outline lie in the middle of it") {
  const LayerSettings settings;
  for (const double radius : {1'000.0, 5'000.0, 20'000.0}) {
    CAPTURE(radius);
    Mesh mesh;
    const Ring round = polygon(radius, 720, 0.3, false);
    add_upright(mesh, round, 1'000);
    const Regions cut = cut_all(mesh, settings)[0].layer.regions;
    REQUIRE(cut.size() == 1);
    CHECK(cut[0].outer.size() * 6 < round.size());
    std::reverse(mesh.triangles.begin(), mesh.triangles.end());
    CHECK(cut_all(mesh, settings)[0].layer.regions == cut);                   // wherever the ring begins
    CHECK(area_mm2(cut[0]) == Approx(area_mm2({round, {}})).epsilon(0.001));  // between its corners 0.3 to 2.5 % less
    const geometry::SegmentIndex index(cut);
    for (const Point p : round) CHECK(index.nearest(p)->distance_um <= settings.resolution);
  }
}

TEST_CASE("slice: an upright part has the same outline at every height") {
  const LayerSettings settings;
  Mesh mesh;
  add_upright(mesh, polygon(10'000, 200, 0.3, false), 9'000);
  const auto cut = cut_all(mesh, settings);
  REQUIRE(cut.size() > 20);
  for (const Cut& layer : cut) CHECK(layer.layer.regions == cut[0].layer.regions);
}

TEST_CASE("slice: a triangle without area along an upright edge leaves its corner") {
  Mesh mesh;  // an upright edge in two pieces on the one side, whole on the other, and a triangle between them
  mesh.vertices = {{0, 0, 0}, {10'000, 0, 0}, {0, 10'000, 0}, {0, 0, 3'500}, {10'000, 0, 3'500}, {0, 10'000, 3'500}};
  mesh.vertices.push_back({10'000, 0, 2'000});
  mesh.triangles = {{0, 2, 1}, {3, 4, 5}, {2, 0, 3}, {2, 3, 5}, {1, 2, 5}, {1, 5, 4}};
  for (const Triangle& t : {Triangle{0, 1, 6}, Triangle{0, 6, 3}, Triangle{3, 6, 4}, Triangle{1, 4, 6}})
    mesh.triangles.push_back(t);
  const auto cut = cut_all(mesh);
  REQUIRE(cut.size() > 10);
  for (const Cut& layer : cut) {
    REQUIRE(layer.layer.regions.size() == 1);
    CHECK(layer.layer.regions[0].outer.size() == 3);
    CHECK(box_of(layer.layer.regions).max == Point{10'000, 10'000});
  }
}

TEST_CASE("slice: layers of real parts hold the volume of their meshes", "[law][corpus]") {
  for (const char* name :
       {"models/benchy.stl", "models/MINI-x-carriage.stl", "models/MINI-minda-holder.stl", "models/fandisk.stl"}) {
    const auto path = corpus(name);
    if (!path) return;
    INFO(name);
    Mesh mesh = mesh::read_file(path->string()).objects.at(0).mesh;
    const Um bottom = box_of(mesh).min.z;
    mesh = solids::moved(std::move(mesh), {0, 0, -bottom});
    LayerSettings settings;
    settings.layer_height = 0.05_mm;
    const auto cuts = cut_all(mesh, settings);
    check_proper(cuts);
    CHECK(volume_mm3(cuts) == Approx(volume_mm3(mesh)).epsilon(0.001));
  }
}

TEST_CASE("slice: slicing_mode says what shells within shells are") {
  using namespace fixtures;
  const Facets block = box({0, 0, 0}, {20, 20, 20}), core = box({5, 5, 0}, {15, 15, 20}),
               well = reversed(box({5, 5, 0}, {15, 15, 20}));
  const auto sliced = [](const Facets& facets, SlicingMode mode) {
    LayerSettings settings;
    settings.slicing_mode = mode;
    return volume_mm3(cut_all(mesh::read(binary_stl(facets), "part", {}).objects.at(0).mesh, settings));
  };
  CHECK(sliced(block + core, SlicingMode::regular) == Approx(8000));
  CHECK(sliced(block + core, SlicingMode::even_odd) == Approx(8000 - 2000));
  CHECK(sliced(block + well, SlicingMode::regular) == Approx(8000 - 2000));
  CHECK(sliced(block + well, SlicingMode::even_odd) == Approx(8000 - 2000));
  CHECK(sliced(block + well, SlicingMode::close_holes) == Approx(8000));
  // What stands in a hole goes into what fills it.
  const Facets pin = box({9, 9, 0}, {11, 11, 20});
  CHECK(sliced(block + well + pin, SlicingMode::close_holes) == Approx(8000));
}

TEST_CASE("slice: an open scan comes out whole", "[corpus]") {
  const auto path = corpus("models/stanford-bunny.stl");
  if (!path) return;
  Mesh mesh = mesh::read_file(path->string()).objects.at(0).mesh;
  const Um bottom = box_of(mesh).min.z;
  mesh = solids::moved(std::move(mesh), {0, 0, -bottom});
  const auto cuts = cut_all(mesh);
  check_proper(cuts);
  CHECK(volume_mm3(cuts) == Approx(volume_mm3(mesh)).epsilon(0.05));
  std::size_t gaps = 0;
  for (const auto& cut : cuts) {
    gaps += cut.closed.count + cut.bridged.count;
    CHECK(area_mm2(cut.layer.regions) > 0);
  }
  CHECK(gaps > 0);
  CHECK(notices_of(cuts, "bunny").size() >= 1);
}

TEST_CASE("slice: a shell that is inside out and cuts through another takes away, and adds nothing beyond it") {
  using namespace fixtures;
  const Facets block = box({0, 0, 0}, {20, 20, 20}), through = reversed(box({5, -5, -5}, {10, 25, 25})),
               stick = reversed(box({15, 5, 5}, {30, 10, 10})), alone = reversed(box({40, 0, 0}, {50, 10, 20}));
  const auto sliced = [](const Facets& facets) {
    auto mesh = mesh::read(binary_stl(facets), "part", {}).objects.at(0).mesh;
    Um lowest = 0;
    for (const Point3& p : mesh.vertices) lowest = std::min(lowest, p.z);
    for (Point3& p : mesh.vertices) p.z -= lowest;
    return volume_mm3(cut_all(mesh));
  };
  CHECK(sliced(block + through) == Approx(8000 - 5 * 20 * 20).epsilon(1e-3));
  CHECK(sliced(block + stick) == Approx(8000 - 5 * 5 * 5).epsilon(1e-3));
  CHECK(sliced(block + alone) == Approx(8000 + 10 * 10 * 20).epsilon(1e-3));
}
