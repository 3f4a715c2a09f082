// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/conflicts.h"

#include "core/error.h"
#include "tasks/tasks.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::pipeline;
using Catch::Matchers::Contains;

namespace {

Bead bead(std::vector<Junction> path, Role role = Role::outer_wall, bool closed = false) {
  Bead out;
  out.path = std::move(path), out.role = role, out.closed = closed;
  return out;
}

/// A square wall of that side around a place, turned by 45° where asked.
Bead square(Point at, Um side, Um width, bool turned) {
  const Um h = side / 2;
  if (turned)
    return bead(
        {{{at.x + h, at.y}, width}, {{at.x, at.y + h}, width}, {{at.x - h, at.y}, width}, {{at.x, at.y - h}, width}},
        Role::outer_wall, true);
  return bead({{{at.x - h, at.y - h}, width},
               {{at.x + h, at.y - h}, width},
               {{at.x + h, at.y + h}, width},
               {{at.x - h, at.y + h}, width}},
              Role::outer_wall, true);
}

travel::LayerInput layer(Um z, std::vector<Beads> objects, Beads adhesion = {}, Um height = 200) {
  travel::LayerInput out;
  out.z = z, out.height = height, out.adhesion = std::move(adhesion);
  out.time.number = static_cast<std::uint32_t>(z / 200 - 1);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    travel::ObjectLayer object;
    object.object = static_cast<ObjectId>(i), object.height = height, object.beads = std::move(objects[i]);
    out.objects.push_back(std::move(object));
  }
  return out;
}

/// Cells of a raster that the discs along a closed bead cover, each disc smaller by that.
constexpr Um cell = 40, cells = 400;
using Raster = std::vector<char>;
Raster raster_of(const Bead& bead, double smaller_by) {
  Raster out(static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells), 0);
  const std::size_t count = bead.path.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto &a = bead.path[i], &b = bead.path[(i + 1) % count];
    const double r = a.width / 2.0 - smaller_by;
    const double dx = b.at.x - a.at.x, dy = b.at.y - a.at.y, length2 = dx * dx + dy * dy;
    const auto index = [](Um v) { return std::clamp(v / cell + cells / 2, Um{0}, cells - 1); };
    const Um low_x = index(std::min(a.at.x, b.at.x) - a.width), high_x = index(std::max(a.at.x, b.at.x) + a.width);
    const Um low_y = index(std::min(a.at.y, b.at.y) - a.width), high_y = index(std::max(a.at.y, b.at.y) + a.width);
    for (Um y = low_y; y <= high_y; ++y)
      for (Um x = low_x; x <= high_x; ++x) {
        const double px = (x - cells / 2) * cell - a.at.x, py = (y - cells / 2) * cell - a.at.y;
        const double t = std::clamp((px * dx + py * dy) / length2, 0.0, 1.0);
        if (std::hypot(px - t * dx, py - t * dy) <= r) out[static_cast<std::size_t>(y * cells + x)] = 1;
      }
  }
  return out;
}
bool meet(const Raster& a, const Raster& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] != 0 && b[i] != 0) return true;
  return false;
}

}  // namespace

TEST_CASE("conflicts: a thousand random placements as a raster has them") {
  std::mt19937 random(11);
  const auto number = [&](int least, int most) {
    return least + static_cast<Um>(random() % static_cast<unsigned>(most - least + 1));
  };
  constexpr Um tolerance = 100;
  // Bands that both lose 50 µm a side still share a cell where they overlapped by more than tolerance and the cell's
  // diagonal; where they overlapped by less than tolerance they share none.
  constexpr Um diagonal = 57;
  std::size_t yes = 0, no = 0, near = 0;
  for (int i = 0; i < 1000; ++i) {
    const Bead a = square({0, 0}, number(1000, 4000), number(300, 600), random() % 2 == 0);
    const Bead b =
        square({number(-4500, 4500), number(-4500, 4500)}, number(1000, 4000), number(300, 600), random() % 2 == 0);
    const auto found = conflicts_in(std::vector{layer(200, {{a}, {b}})}, tolerance);
    const bool surely = meet(raster_of(a, (tolerance + diagonal) / 2.0), raster_of(b, (tolerance + diagonal) / 2.0));
    const bool maybe = meet(raster_of(a, (tolerance - diagonal) / 2.0), raster_of(b, (tolerance - diagonal) / 2.0));
    INFO("placement " << i);
    if (surely) CHECK(found.size() == 1);
    if (!found.empty()) CHECK(maybe);
    (surely ? yes : maybe ? near : no) += 1;
    if (!found.empty()) CHECK(found[0].depth_um > tolerance);
  }
  CHECK(yes > 200);
  CHECK(no > 200);
  CHECK(near < 150);
}

TEST_CASE("conflicts: depth between strokes of varying width is the deepest of all places") {
  std::mt19937 random(5);
  const auto number = [&](int least, int most) {
    return least + static_cast<Um>(random() % static_cast<unsigned>(most - least + 1));
  };
  for (int i = 0; i < 300; ++i) {
    const auto stroke = [&] {
      return Stroke{
          {number(0, 4000), number(0, 4000)}, {number(0, 4000), number(0, 4000)}, number(100, 1500), number(100, 1500)};
    };
    const Stroke a = stroke(), b = stroke();
    double deepest = -1e9;
    constexpr int steps = 200;
    for (int s = 0; s <= steps; ++s)
      for (int t = 0; t <= steps; ++t) {
        const double u = s / double(steps), v = t / double(steps);
        const double dx = a.a.x + u * (a.b.x - a.a.x) - b.a.x - v * (b.b.x - b.a.x);
        const double dy = a.a.y + u * (a.b.y - a.a.y) - b.a.y - v * (b.b.y - b.a.y);
        deepest =
            std::max(deepest, (a.width_a + u * (a.width_b - a.width_a) + b.width_a + v * (b.width_b - b.width_a)) / 2 -
                                  std::hypot(dx, dy));
      }
    const auto depth = depth_of(a, b, 0);
    // A step along either is at most 28 µm, and widths change by at most 7 µm with it.
    constexpr double step_um = 40;
    if (deepest > 1) REQUIRE(depth.has_value());
    if (depth) {
      CHECK(depth->um >= deepest - 0.5);  // the search ends within that
      CHECK(depth->um <= deepest + step_um);
    }
  }
}

TEST_CASE("conflicts: all pairs are told, with names, place, layer and depth, an object and its support are one") {
  const Bead wall = square({10'000, 10'000}, 5'000, 400, false), inside = square({12'700, 10'000}, 5'000, 400, false);
  auto low = layer(200, {{wall}, {square({40'000, 0}, 5'000, 400, false)}}),
       high = layer(400, {{wall}, {inside}}, {bead({{{7'300, 5'000}, 400}, {{7'300, 15'000}, 400}}, Role::skirt)});
  auto top = layer(600, {{wall}, {inside}});
  auto support = wall;
  support.role = Role::support;
  travel::ObjectLayer below;
  below.object = 0, below.height = 200, below.support = true, below.beads = {support};
  low.objects.push_back(below);
  const std::vector<ObjectLabel> objects{{"body", {}, {}}, {"lid", {}, {}}};
  const std::vector layers{low, high, top};
  const auto found = conflicts_in(layers, 100);
  REQUIRE(found.size() == 2);
  CHECK(found[0].layers == 2);
  CHECK(found[1].layers == 1);
  CHECK_THAT(describe(found[0], objects), Contains("'body' and 'lid' overlap at layer 1, z 0.400, (") &&
                                              Contains("0.400 mm deep (outer_wall, outer_wall)"));
  CHECK_THAT(describe(found[1], objects),
             Contains("'body' and skirt overlap at layer 1, z 0.400") && Contains("0.200 mm deep"));
  Notices notices;
  CHECK_THROWS_WITH(
      check_conflicts(layers, objects, 100, false, notices),
      Contains("plate: 'body' and 'lid' overlap at layer 1, z 0.400") && Contains("join them: a.stl+b.stl"));
  CHECK(notices.size() == 2);
  notices.clear();
  CHECK_NOTHROW(check_conflicts(layers, objects, 100, true, notices));
  CHECK(notices.size() == 2);
  CHECK_NOTHROW(check_conflicts(layers, objects, 400, false, notices));
}

TEST_CASE("conflicts: layers of other heights meet where their plastic does") {
  const Bead a = square({0, 0}, 5'000, 400, false), b = square({2'000, 0}, 5'000, 400, false);
  auto thick = layer(600, {{a}}, {}, 300), thin = layer(400, {{}, {b}}), above = layer(800, {{}, {b}}),
       touches = layer(300, {{}, {b}});
  CHECK(conflicts_in(std::vector{thin, thick}, 100).size() == 1);
  CHECK(conflicts_in(std::vector{thick, above}, 100).empty());    // 0.6 … 0.8 lies on 0.3 … 0.6
  CHECK(conflicts_in(std::vector{touches, thick}, 100).empty());  // 0.1 … 0.3 under it
}

TEST_CASE("conflicts: two supports that meet are told and not refused") {
  auto one = layer(200, {{}, {}});
  for (const int i : {0, 1}) {
    auto& object = one.objects[static_cast<std::size_t>(i)];
    object.support = true;
    object.beads = {bead({{{0, i * 100}, 400}, {{9'000, i * 100}, 400}}, Role::support)};
  }
  Notices notices;
  CHECK_NOTHROW(check_conflicts(std::vector{one}, {{"a", {}, {}}, {"b", {}, {}}}, 100, false, notices));
  REQUIRE(notices.size() == 1);
  CHECK(notices[0].code == "paths_touch");
  CHECK_THAT(notices[0].message, Contains("the support of 'a' and the support of 'b' overlap"));
}

TEST_CASE("conflicts: support that is purged into first is no other than the rest of it") {
  const Bead purged = bead({{{0, 0}, 400}, {{9'000, 0}, 400}}, Role::support);
  auto one = layer(200, {{}}, {purged});
  one.objects[0].support = true;
  one.objects[0].beads = {bead({{{0, 100}, 400}, {{9'000, 100}, 400}}, Role::support_interface)};
  CHECK(conflicts_in(std::vector{one}, 100).empty());
  // A raft lies on a layer of its own, and the tower not in it.
  auto raft = layer(200, {}, {purged, bead({{{0, 100}, 400}, {{9'000, 100}, 400}}, Role::wipe_tower)});
  CHECK(conflicts_in(std::vector{raft}, 100).size() == 1);
}
