// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/box_tree.h"
#include "mesh/fixtures.h"
#include "source.h"
#include "tasks/tasks.h"

#include <algorithm>
#include <optional>
#include <random>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::mesh;
using namespace fixtures;

namespace {

const Facets cube = box({0, 0, 0}, {20, 20, 20});

struct Result {
  double volume_mm3;
  Repairs repairs;
};

Result repaired(const Facets& facets) {
  const Loaded loaded = read(binary_stl(facets));
  REQUIRE(loaded.objects.size() == 1);
  return {volume_mm3(loaded.objects[0].mesh), loaded.objects[0].repairs};
}

/// Corners 0, 1, 2 of a facet that is no triangle on the lattice.
const Facet needle{{{0, 0, 0}, {20, 0, 0}, {20, 0, 0.0001f}}};

/// Each facet cut at the middles of its sides.
Facets in_quarters(const Facets& facets) {
  const auto middle = [](Corner p, Corner q) { return Corner{(p.x + q.x) / 2, (p.y + q.y) / 2, (p.z + q.z) / 2}; };
  Facets out;
  for (const auto& [a, b, c] : facets) {
    const Corner ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const Facet& part : {Facet{a, ab, ca}, Facet{ab, b, bc}, Facet{ca, bc, c}, Facet{ab, bc, ca}})
      out.push_back(part);
  }
  return out;
}

/// Each outward shell once, each inward one once: no side has the same direction as another of its edge.
bool consistent(const Mesh& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sides;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) sides.emplace_back(t[i], t[(i + 1) % 3]);
  std::sort(sides.begin(), sides.end());
  return std::adjacent_find(sides.begin(), sides.end()) == sides.end();
}

}  // namespace

TEST_CASE("mesh: a sound mesh is not touched", "[mesh][repair]") {
  const Facets two = cube + box({30, 0, 0}, {40, 10, 10});
  const auto [volume, repairs] = repaired(two);
  CHECK(volume == Approx(9000));
  CHECK(repairs == Repairs{.shells = 2});
  CHECK(repairs.watertight());
  CHECK(notices_of(repairs, "part").empty());
}

TEST_CASE("mesh: triangles thinner than the lattice are dropped and leave no open edge", "[mesh][repair]") {
  Facets facets = cube;
  facets.push_back(needle);
  const auto [volume, repairs] = repaired(facets);
  CHECK(volume == Approx(8000));
  CHECK(repairs == Repairs{.degenerate = 1, .shells = 1});
}

TEST_CASE("mesh: three corners in a line are kept, for their neighbours meet there", "[mesh][repair]") {
  // A cube whose first facet is split at the middle of an edge, with a needle between the halves and the neighbour.
  Facets facets = cube;
  const auto [a, b, c] = facets[0];
  const Corner middle{(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2};
  facets[0] = {a, middle, c};
  facets.push_back({middle, b, c});
  facets.push_back({a, b, middle});
  const auto [volume, repairs] = repaired(facets);
  CHECK(volume == Approx(8000));
  CHECK(repairs == Repairs{.shells = 1});
}

TEST_CASE("mesh: repeated triangles are dropped, from whichever corner they begin", "[mesh][repair]") {
  Facets facets = cube;
  facets.push_back({cube[3][1], cube[3][2], cube[3][0]});
  CHECK(repaired(facets).repairs == Repairs{.duplicates = 1, .shells = 1});
  CHECK(repaired(cube + cube).repairs == Repairs{.duplicates = 12, .shells = 1});
}

TEST_CASE("mesh: a triangle repeated the wrong way round is dropped, and the surface stays closed", "[mesh][repair]") {
  const std::size_t at = GENERATE(0u, 5u, 12u);
  Facets facets = cube;
  facets.insert(facets.begin() + static_cast<std::ptrdiff_t>(at), reversed(cube[3]));
  const auto [volume, repairs] = repaired(facets);
  CHECK(volume == Approx(8000));
  CHECK(repairs.duplicates == 1);
  CHECK(repairs.watertight());
}

TEST_CASE("mesh: a file with every triangle from both sides is one solid", "[mesh][repair]") {
  for (const Facets& facets : {cube + reversed(cube), reversed(cube) + cube}) {
    const auto [volume, repairs] = repaired(facets);
    CHECK(volume == Approx(8000));
    CHECK(repairs.duplicates == 12);
    CHECK(repairs.watertight());
  }
}

TEST_CASE("mesh: a fin without thickness is dropped", "[mesh][repair]") {
  const Facets fin{{{{20, 0, 0}, {20, 20, 0}, {30, 0, 0}}}, {{{20, 20, 0}, {30, 20, 0}, {30, 0, 0}}}};
  const auto [volume, repairs] = repaired(cube + fin + reversed(fin));
  CHECK(volume == Approx(8000));
  CHECK(repairs == Repairs{.duplicates = 2, .sheets = 2, .shells = 1});
}

TEST_CASE("mesh: two boxes that touch face to face become one", "[mesh][repair]") {
  const auto [volume, repairs] = repaired(cube + box({20, 0, 0}, {30, 20, 20}));
  CHECK(volume == Approx(12'000));
  // The box's faces are split along the same diagonal as the cube's, so they are pairs back to back.
  CHECK(repairs == Repairs{.duplicates = 2, .sheets = 2, .shells = 1});
}

TEST_CASE("mesh: flipped triangles are turned round, whichever they are", "[mesh][repair][law]") {
  std::mt19937 random(3);
  const Facets sound = cube + box({30, 0, 0}, {40, 10, 10});
  for (int run = 0; run < 50; ++run) {
    Facets facets = sound;
    std::size_t flips = 0;
    for (Facet& facet : facets)
      if (random() % 3 == 0) facet = reversed(facet), ++flips;
    std::shuffle(facets.begin(), facets.end(), random);
    const Loaded loaded = read(binary_stl(facets));
    const auto& mesh = loaded.objects[0].mesh;
    const auto& repairs = loaded.objects[0].repairs;
    CHECK(volume_mm3(mesh) == Approx(9000));
    CHECK(repairs.flipped + 12 * repairs.inverted_shells <= std::max(flips, std::size_t{12}));
    CHECK(repairs.watertight());
    CHECK(consistent(mesh));
  }
}

TEST_CASE("mesh: a mesh that is inside out is turned round, its void stays one", "[mesh][repair]") {
  const Facets hollow = cube + reversed(box({5, 5, 5}, {15, 15, 15}));
  CHECK(repaired(hollow).volume_mm3 == Approx(7000));
  CHECK(repaired(hollow).repairs == Repairs{.shells = 2});
  CHECK(repaired(reversed(hollow)).volume_mm3 == Approx(7000));
  CHECK(repaired(reversed(hollow)).repairs == Repairs{.inverted_shells = 2, .shells = 2});
}

TEST_CASE("mesh: a few flipped triangles do not make a void solid", "[mesh][repair]") {
  Facets inner = reversed(box({5, 5, 5}, {15, 15, 15}));
  inner[4] = reversed(inner[4]);
  const auto [volume, repairs] = repaired(cube + inner);
  CHECK(volume == Approx(7000));
  CHECK(repairs == Repairs{.flipped = 1, .shells = 2});
}

TEST_CASE("mesh: a solid inside a solid stays solid", "[mesh][repair]") {
  CHECK(repaired(cube + box({5, 5, 5}, {15, 15, 15})).volume_mm3 == Approx(9000));  // nonzero winding: it is in once
}

TEST_CASE("mesh: a part that is inside out beside one that is not is turned round", "[mesh][repair]") {
  const Facets small = box({30, 0, 0}, {40, 10, 10});
  for (const Facets& facets : {cube + reversed(small), reversed(cube) + small, reversed(small) + cube}) {
    const auto [volume, repairs] = repaired(facets);
    CHECK(volume == Approx(9000));
    CHECK(repairs == Repairs{.inverted_shells = 1, .shells = 2});
  }
}

TEST_CASE("mesh: a shell that is inside out is a hole where it cuts through another, and a part where it does not",
          "[mesh][repair]") {
  const Facets bar = box({5, 5, -5}, {10, 10, 25}), beside = box({20, 0, 0}, {30, 10, 10}),
               corner = box({19, 19, 30}, {25, 25, 40});
  for (const auto& hole : {bar, box({-5, 8, 8}, {25, 12, 12}), box({15, 15, 15}, {30, 30, 30})}) {
    const auto [volume, repairs] = repaired(cube + reversed(hole));
    CHECK(repairs.inverted_shells == 0);
    CHECK(volume < 8000);
  }
  for (const auto& part : {beside, corner, box({2, 2, 20}, {8, 8, 30})}) {  // faces and edges that only touch
    const auto [volume, repairs] = repaired(cube + reversed(part));
    CHECK(repairs.inverted_shells == 1);
    CHECK(volume > 8000);
  }
  CHECK(repaired(reversed(bar)).volume_mm3 == Approx(750));  // alone
}

TEST_CASE("mesh: among thousands of parts one that is inside out is turned round, and a void stays one",
          "[mesh][repair]") {
  Facets facets = cube + reversed(box({5, 5, 5}, {15, 15, 15}));
  const double one = repaired(facets).volume_mm3;
  REQUIRE(one == Approx(7000));
  constexpr int more = 2000;
  for (int i = 0; i < more; ++i) {
    const float x = 30.F + 3.F * static_cast<float>(i % 50), y = 3.F * static_cast<float>(i / 50);
    const Facets part = box({x, y, 0}, {x + 2, y + 2, 2});
    facets = std::move(facets) + (i == 777 ? reversed(part) : part);
  }
  const auto [volume, repairs] = repaired(facets);
  CHECK(volume == Approx(one + more * 8));
  CHECK(repairs == Repairs{.inverted_shells = 1, .shells = more + 2});
}

TEST_CASE("mesh: a tree of boxes finds what looking at each box finds", "[mesh][repair][law]") {
  std::mt19937 random(11);
  const auto below = [&](int end) { return static_cast<Um>(random() % static_cast<unsigned>(end)); };
  for (const int count : {0, 1, 8, 9, 700}) {
    std::vector<Box3> boxes(static_cast<std::size_t>(count));
    for (auto& b : boxes) {
      const Point3 low{below(1000), below(1000), below(1000)};
      b.add(low);
      b.add(Point3{low.x + below(300), low.y + below(300), low.z + below(300)});
    }
    const BoxTree tree(boxes);
    int held = 0;
    for (int i = 0; i < 2000; ++i) {
      const Point3 low{below(1200), below(1200), below(1200)};
      const Um size = below(60);
      Box3 asked;
      asked.add(low), asked.add(Point3{low.x + size, low.y + size, low.z + size});
      const bool any = std::any_of(boxes.begin(), boxes.end(), [&](const Box3& b) { return b.contains(asked); });
      held += any;
      REQUIRE(tree.any_contains(asked) == any);
    }
    if (count == 700) CHECK((held > 200 && held < 1800));
  }
}

TEST_CASE("mesh: triangles that meet nowhere are left as they are", "[mesh][repair]") {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> off(-0.05F, 0.05F);
  for (const bool inside_out : {false, true}) {
    Facets scraps = in_quarters(in_quarters(inside_out ? reversed(cube) : cube));
    for (Facet& facet : scraps)
      for (Corner& corner : facet) corner = {corner.x + off(random), corner.y + off(random), corner.z + off(random)};
    const auto repairs = repaired(scraps).repairs;
    CHECK(repairs.shells == scraps.size());
    CHECK(repairs.inverted_shells == 0);
  }
}

TEST_CASE("mesh: holes and crowded edges are counted and left", "[mesh][repair]") {
  Facets facets = cube;
  facets.pop_back();
  const auto open = repaired(facets).repairs;
  CHECK(open == Repairs{.shells = 1, .open_edges = 3});
  CHECK_FALSE(open.watertight());
  CHECK(notices_of(open, "part.stl")[0].message.starts_with("part.stl: 3 edges are open"));

  const auto crowded = repaired(cube + box({20, 20, 0}, {40, 40, 20}));
  CHECK(crowded.repairs == Repairs{.shells = 2, .non_manifold_edges = 1});
  CHECK(crowded.volume_mm3 == Approx(16'000));
  // A crowded edge does not hide that a shell is closed, and inside out.
  CHECK(repaired(cube + reversed(box({20, 20, 0}, {40, 40, 20}))).repairs ==
        Repairs{.inverted_shells = 1, .shells = 2, .non_manifold_edges = 1});
}

TEST_CASE("mesh: a Möbius strip is left as it is", "[mesh][repair]") {
  constexpr int steps = 12;
  Facets facets;
  const auto at = [](int i, float side) {
    const double turn = 2 * M_PI * i / steps, tilt = turn / 2;
    const double r = 10 + side * std::cos(tilt);
    return Corner{static_cast<float>(r * std::cos(turn)), static_cast<float>(r * std::sin(turn)),
                  static_cast<float>(side * std::sin(tilt))};
  };
  for (int i = 0; i < steps; ++i) {
    facets.push_back({at(i, -2), at(i + 1, -2), at(i + 1, 2)});
    facets.push_back({at(i, -2), at(i + 1, 2), at(i, 2)});
  }
  const auto repairs = repaired(facets).repairs;
  CHECK(repairs.one_sided_shells == 1);
  CHECK(repairs.flipped == 0);
}

TEST_CASE("mesh: repairing twice is repairing once", "[mesh][repair][law]") {
  std::mt19937 random(4);
  std::uniform_int_distribution<int> corner(0, 4);
  for (int run = 0; run < 300; ++run) {  // soups of triangles on a tiny grid: every kind of fault at once
    Mesh mesh;
    for (int i = 0; i < 125; ++i) mesh.vertices.push_back({i % 5, i / 5 % 5, i / 25});
    for (int i = 0; i < 60; ++i) {
      const auto vertex = [&] { return static_cast<std::uint32_t>(corner(random) + 5 * corner(random) * (run % 2)); };
      mesh.triangles.push_back({vertex(), vertex(), vertex()});
    }
    const Repaired once = repair(mesh), twice = repair(once.mesh);
    CHECK(twice.repairs.degenerate == 0);
    CHECK(twice.repairs.duplicates == 0);
    CHECK(twice.repairs.open_edges == once.repairs.open_edges);
    CHECK(twice.repairs.shells == once.repairs.shells);
    CHECK(twice.repairs.one_sided_shells == once.repairs.one_sided_shells);
    CHECK(twice.mesh.triangles.size() == once.mesh.triangles.size());
  }
}

TEST_CASE("mesh: a large mesh with every fault is repaired alike on any number of threads", "[mesh][repair][law]") {
  // A grid of boxes in several blocks and ranges: some inside out, some open, some twice, some touching, all shuffled.
  std::mt19937 random(6);
  Facets facets;
  for (int i = 0; i < 30; ++i)
    for (int k = 0; k < 30; ++k) {
      const float x = 11.F * static_cast<float>(i), y = 11.F * static_cast<float>(k) - (k % 2 == 0 ? 0.F : 1.F);
      Facets one = in_quarters(in_quarters(box({x, y, 0}, {x + 10, y + 10, 10})));
      if (random() % 9 == 0) one = reversed(one);
      if (random() % 9 == 0) one.erase(one.begin() + static_cast<std::ptrdiff_t>(random() % one.size()));
      if (random() % 9 == 0) one.push_back(one[random() % one.size()]);
      if (random() % 9 == 0) one.push_back(reversed(one[random() % one.size()]));
      if (random() % 9 == 0) one[3] = reversed(one[3]);
      facets = std::move(facets) + one;
    }
  std::shuffle(facets.begin(), facets.end(), random);
  std::optional<Object> first;
  for (const unsigned threads : {1U, 2U, 8U}) {
    const tasks::ThreadLimit limit(threads);
    const Object object = read(binary_stl(facets)).objects[0];
    if (!first) first = object;
    CHECK((object.mesh == first->mesh));
    CHECK(object.repairs == first->repairs);
  }
  CHECK(first->mesh.triangles.size() > 140'000);
  CHECK(first->repairs.duplicates > 100);
  CHECK(first->repairs.sheets > 100);
  CHECK(first->repairs.flipped > 50);
  CHECK(first->repairs.inverted_shells > 0);
  CHECK(first->repairs.shells > 400);
  CHECK(first->repairs.open_edges > 200);
  CHECK(first->repairs.non_manifold_edges > 100);
}

TEST_CASE("mesh: a vertex of very many edges does not slow the repair down", "[mesh][repair]") {
  Mesh mesh;  // two fans about one axis: quadratic if the edges of a vertex were compared pair by pair
  constexpr std::uint32_t rim = 300'000;
  mesh.vertices = {{0, 0, 1'000'000}, {0, 0, -1'000'000}};
  for (std::uint32_t i = 0; i < rim; ++i) mesh.vertices.push_back({static_cast<Um>(i), static_cast<Um>(i % 7), 0});
  for (std::uint32_t i = 0; i < rim; ++i) {
    const std::uint32_t a = 2 + i, b = 2 + (i + 1) % rim;
    mesh.triangles.push_back({0, a, b});
    mesh.triangles.push_back({1, b, a});
  }
  CHECK(repair(std::move(mesh)).repairs.watertight());
}

TEST_CASE("mesh: the example models are sound as they are", "[mesh][repair]") {
  const std::string name = GENERATE("box.stl", "bracket.stl", "calibration-tower.stl");
  const Loaded loaded = read_file(tests::source / "examples/" / name);
  REQUIRE(loaded.objects.size() == 1);
  CHECK(loaded.objects[0].repairs == Repairs{.shells = 1});
  CHECK(loaded.objects[0].mesh.triangles.size() == loaded.triangles_in_file);
  CHECK(volume_mm3(loaded.objects[0].mesh) > 7999);
}
