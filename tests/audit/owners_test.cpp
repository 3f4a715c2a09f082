// SPDX-License-Identifier: GPL-3.0-or-later
// Beads of two owners that lie in each other, found in the bytes.
#include "audit/owners.h"

#include "audit/audit_fixture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <fmt/format.h>

namespace weft::audit {
namespace {

/// A square wall around a place, turned by 45° where asked.
std::array<Vec, 4> square(Vec at, double side, bool turned) {
  const double h = side / 2;
  if (turned) return {Vec{at.x + h, at.y}, {at.x, at.y + h}, {at.x - h, at.y}, {at.x, at.y - h}};
  return {Vec{at.x - h, at.y - h}, {at.x + h, at.y - h}, {at.x + h, at.y + h}, {at.x - h, at.y + h}};
}
void lay(Owners& owners, std::string_view object, std::string_view feature, const std::array<Vec, 4>& corners,
         double half, double z, double height = 0.2, int layer = 0) {
  for (std::size_t i = 0; i < 4; ++i)
    owners.lay(object, feature, {.from = corners[i], .to = corners[(i + 1) % 4]}, {}, half, z, height, layer);
}

/// Cells that discs along the wall cover, each smaller by that.
constexpr double cell_mm = 0.04;
constexpr int cells = 400;
std::vector<char> raster_of(const std::array<Vec, 4>& corners, double radius) {
  std::vector<char> out(std::size_t{cells} * cells, 0);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec a = corners[i], b = corners[(i + 1) % 4], d = b - a;
    const auto cell = [](double mm, int and_more) {
      return std::clamp(static_cast<int>(std::floor(mm / cell_mm)) + cells / 2 + and_more, 0, cells);
    };
    const int last_x = cell(std::max(a.x, b.x) + radius, 2), last_y = cell(std::max(a.y, b.y) + radius, 2);
    for (int y = cell(std::min(a.y, b.y) - radius, 0); y < last_y; ++y)
      for (int x = cell(std::min(a.x, b.x) - radius, 0); x < last_x; ++x) {
        const Vec p{(x - cells / 2) * cell_mm, (y - cells / 2) * cell_mm};
        const double t = std::clamp(dot(p - a, d) / dot(d, d), 0.0, 1.0);
        if (norm(p - a - t * d) <= radius) out[static_cast<std::size_t>(y) * cells + static_cast<std::size_t>(x)] = 1;
      }
  }
  return out;
}
bool meet(const std::vector<char>& a, const std::vector<char>& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] != 0 && b[i] != 0) return true;
  return false;
}

/// A layer of two squares of 20 mm in that many words: what begins an object, and ends it.
std::string two_objects(const std::string& begin_a, const std::string& begin_b, const std::string& end, double apart) {
  std::string out = "G28\nG90\nM83\n;LAYER_CHANGE\n;HEIGHT:0.2\n;WIDTH:0.45\n;TYPE:External perimeter\nG1 Z0.2\n";
  for (const bool second : {false, true}) {
    const double x = 60 + (second ? 20 + apart : 0), y = 60;
    out += (second ? begin_b : begin_a) + "\n";
    out += fmt::format("G1 X{} Y{}\n", x, y);
    for (const auto& [dx, dy] : {std::pair(20, 0), {20, 20}, {0, 20}, {0, 0}})
      out += fmt::format("G1 X{} Y{} E0.7\n", x + dx, y + dy);
    out += end + "\n";
  }
  return out;
}

}  // namespace

TEST_CASE("owners: a thousand random placements as a raster has them") {
  std::mt19937 random(21);
  const auto number = [&](double least, double most) {
    return least + (most - least) * static_cast<double>(random() % 10'000) / 10'000;
  };
  constexpr double tolerance = 0.1, diagonal = 0.057;
  std::size_t yes = 0, no = 0, near = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto a = square({0, 0}, number(1, 4), random() % 2 == 0);
    const auto b = square({number(-4.5, 4.5), number(-4.5, 4.5)}, number(1, 4), random() % 2 == 0);
    const double ra = number(0.15, 0.3), rb = number(0.15, 0.3);
    Owners owners(tolerance);
    lay(owners, "a", "outer_wall", a, ra, 0.2);
    lay(owners, "b", "outer_wall", b, rb, 0.2);
    const auto found = owners.conflicts();
    const double surely_by = (tolerance + diagonal) / 2, maybe_by = (tolerance - diagonal) / 2;
    const bool surely = meet(raster_of(a, ra - surely_by), raster_of(b, rb - surely_by));
    const bool maybe = meet(raster_of(a, ra - maybe_by), raster_of(b, rb - maybe_by));
    INFO("placement " << i);
    if (surely) CHECK(found.size() == 1);
    if (!found.empty()) CHECK(maybe);
    (surely ? yes : maybe ? near : no) += 1;
  }
  CHECK(yes > 200);
  CHECK(no > 200);
  CHECK(near < 150);
}

TEST_CASE("owners: all pairs are told, where each begins and on how many layers") {
  Owners owners(0.1);
  const auto wall = square({10, 10}, 5, false), inside = square({12.7, 10}, 5, false);
  for (int layer = 0; layer < 4; ++layer) {
    const double z = 0.2 * (layer + 1);
    if (layer == 1) owners.lay("", "wipe_tower", {.from = {7.3, 5}, .to = {7.3, 15}}, {}, 0.2, z, 0.2, layer);
    lay(owners, "body", "outer_wall", wall, 0.2, z, 0.2, layer);
    lay(owners, "far", "outer_wall", square({40, 0}, 5, false), 0.2, z, 0.2, layer);
    if (layer > 0) lay(owners, "lid", "inner_wall", inside, 0.2, z, 0.2, layer);
    owners.lay("body", "support", {.from = {8, 8}, .to = {12, 12}}, {}, 0.2, z, 0.2, layer);  // its own
  }
  const auto found = owners.conflicts();
  REQUIRE(found.size() == 3);
  const auto of = [&](const std::string& b) {
    return *std::find_if(found.begin(), found.end(), [&](const Conflict& c) { return c.a == b || c.b == b; });
  };
  CHECK(of("wipe_tower").blocks);
  CHECK(of("wipe_tower").layers == 1);
  const auto lid = *std::find_if(found.begin(), found.end(), [](const Conflict& c) {
    return !c.support_a && !c.support_b && (c.a == "lid" || c.b == "lid");
  });
  CHECK(lid.layers == 3);
  CHECK(lid.layer == 1);
  CHECK_THAT(describe(lid), Catch::Contains("overlap at layer 1, z 0.400") && Catch::Contains("0.400 mm deep"));
  CHECK(owners.labelled());
}

TEST_CASE("owners: a brim may lie at its part and a little in it, a skirt through it is refused") {
  const auto blocks = [](const std::string& feature, double x) {
    Owners owners(0.1);
    lay(owners, "body", "outer_wall", square({10, 10}, 5, false), 0.2, 0.2);
    owners.lay("", feature, {.from = {x, 5}, .to = {x, 15}}, {}, 0.2, 0.2, 0.2, 0);
    const auto found = owners.conflicts();
    return found.empty() ? std::string("none") : found[0].blocks ? std::string("blocks") : std::string("told");
  };
  CHECK(blocks("brim", 7.5 - 0.41) == "none");
  CHECK(blocks("brim", 7.5 - 0.2) == "told");
  CHECK(blocks("brim", 8) == "blocks");
  CHECK(blocks("skirt", 10) == "blocks");
}

TEST_CASE("owners: layers of other heights meet where their plastic does") {
  const auto a = square({0, 0}, 5, false), b = square({2, 0}, 5, false);
  const auto pairs = [&](double thin_z) {
    Owners owners(0.1);
    const auto lay_both = [&](bool thick) {
      lay(owners, thick ? "thick" : "thin", "outer_wall", thick ? a : b, 0.2, thick ? 0.6 : thin_z, thick ? 0.3 : 0.2);
    };
    lay_both(thin_z > 0.6), lay_both(thin_z <= 0.6);
    return owners.conflicts().size();
  };
  CHECK(pairs(0.4) == 1);
  CHECK(pairs(0.8) == 0);  // 0.6 … 0.8 lies on 0.3 … 0.6
  CHECK(pairs(0.3) == 0);  // 0.1 … 0.3 under it
}

TEST_CASE("owners: files of other slicers are audited by their labels, and without them not") {
  const Bench bench;
  struct Dialect {
    const char *a, *b, *end;
  };
  const auto dialect = GENERATE(
      Dialect{"; printing object a.stl id:0 copy 0", "; printing object a.stl id:0 copy 1", "; stop printing object a"},
      Dialect{"M486 S0", "M486 S1", "M486 S-1"},
      Dialect{"EXCLUDE_OBJECT_START NAME=a", "EXCLUDE_OBJECT_START NAME=b", "EXCLUDE_OBJECT_END"});
  INFO(dialect.a);
  const auto near = bench(two_objects(dialect.a, dialect.b, dialect.end, 0.2));
  CHECK(near.labelled);
  REQUIRE(near.conflicts.size() == 1);
  CHECK(near.verdict == Verdict::rejected);
  CHECK_THAT(summary(near), Catch::Contains("overlap at layer 0, z 0.200"));
  CHECK(near.conflicts[0].depth == Approx(207).margin(2));  // bands of 0.407 mm, 0.2 mm apart
  CHECK(bench(two_objects(dialect.a, dialect.b, dialect.end, 0.5)).clean());
}

TEST_CASE("owners: meshes of Cura may be parts of one object, and what has no label is not audited") {
  const Bench bench;
  const auto cura = bench(two_objects(";MESH:a.stl", ";MESH:b.stl", ";MESH:NONMESH", 0.2));
  REQUIRE(cura.conflicts.size() == 1);
  CHECK_FALSE(cura.conflicts[0].blocks);
  CHECK(cura.clean());
  const auto none = bench(two_objects(";", ";", ";", 0.2));
  CHECK_FALSE(none.labelled);
  CHECK(none.clean());
}

}  // namespace weft::audit
