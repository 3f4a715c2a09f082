// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/medial_axis.h"

#include "picture.h"

#include <cmath>
#include <random>

#include <catch2/catch.hpp>

using namespace weft;
using geometry::MedialAxis;

namespace {

/// Walking along `next` passes every half-edge and never leaves the graph; twins' ends agree.
void check_order(const MedialAxis& axis) {
  std::vector<int> seen(axis.half_edges.size(), 0);
  for (std::uint32_t h = 0; h < axis.half_edges.size(); ++h) {
    const auto& half_edge = axis.half_edges[h];
    REQUIRE(half_edge.next < axis.half_edges.size());
    ++seen[half_edge.next];
    CHECK(axis.half_edges[half_edge.next].from == axis.half_edges[MedialAxis::twin(h)].from);
  }
  for (const int n : seen) CHECK(n == 1);
}

double distance_to_outline(const Region& region, double x, double y) {
  double best = 1e18;
  auto ring_distance = [&](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point a = ring[i], b = ring[(i + 1) % ring.size()];
      const double ux = b.x - a.x, uy = b.y - a.y, d2 = ux * ux + uy * uy;
      const double t = d2 > 0 ? std::clamp(((x - a.x) * ux + (y - a.y) * uy) / d2, 0.0, 1.0) : 0;
      best = std::min(best, std::hypot(x - a.x - t * ux, y - a.y - t * uy));
    }
  };
  ring_distance(region.outer);
  for (const Ring& hole : region.holes) ring_distance(hole);
  return best;
}

void check_clearance(const Region& region, const MedialAxis& axis, double margin_um = 0.2) {
  tests::look_at({region});
  for (const auto& node : axis.nodes)
    CHECK(distance_to_outline(region, node.at.x + axis.origin.x, node.at.y + axis.origin.y) ==
          Approx(node.clearance).margin(margin_um));
}

}  // namespace

TEST_CASE("medial axis: a rectangle has one ridge and four edges into its corners", "[geometry][medial_axis]") {
  const Region region{{{100, 200}, {10'100, 200}, {10'100, 2'200}, {100, 2'200}}, {}};
  const auto axis = geometry::medial_axis(region);
  REQUIRE(axis.valid);
  CHECK(axis.half_edges.size() == 10);
  check_order(axis);
  check_clearance(region, axis);
}

TEST_CASE("medial axis: a hole, a reflex corner and points on a line do no harm", "[geometry][medial_axis]") {
  const Region region{
      {{0, 0}, {5'000, 0}, {9'000, 0}, {9'000, 0}, {9'000, 4'000}, {5'000, 4'000}, {5'000, 9'000}, {0, 9'000}},
      {{{1'000, 1'000}, {1'000, 2'000}, {2'000, 2'000}, {2'000, 1'000}}}};
  const auto axis = geometry::medial_axis(region);
  REQUIRE(axis.valid);
  check_order(axis);
  check_clearance(region, axis);
}

TEST_CASE("medial axis: rings that touch, cross by a micron or run to and fro are made simple",
          "[geometry][medial_axis]") {
  const Region touching{{{0, 0}, {8'000, 0}, {8'000, 8'000}, {0, 8'000}},
                        {{{4'000, 0}, {3'000, 2'000}, {5'000, 2'000}}}};
  const Region crossing{{{0, 0}, {8'000, 0}, {4'001, 4'000}, {8'000, 8'000}, {0, 8'000}, {4'002, 4'001}}, {}};
  const Region spike{{{0, 0}, {8'000, 0}, {8'000, 8'000}, {8'000, 12'000}, {8'000, 8'000}, {0, 8'000}}, {}};
  for (const Region& region : {touching, crossing, spike}) {
    const auto axis = geometry::medial_axis(region);
    REQUIRE(axis.valid);
    check_order(axis);
  }
}

TEST_CASE("medial axis: what has no area has no axis", "[geometry][medial_axis]") {
  CHECK_FALSE(geometry::medial_axis(Region{}).valid);
  CHECK_FALSE(geometry::medial_axis(Region{{{0, 0}, {10, 0}}, {}}).valid);
  CHECK_FALSE(geometry::medial_axis(Region{{{0, 0}, {10, 0}, {20, 0}}, {}}).valid);
}

TEST_CASE("medial axis: clearances of random polygons are exact and the order is whole",
          "[geometry][medial_axis][law]") {
  std::mt19937 random(11);
  for (int round = 0; round < 60; ++round) {
    Region region;
    const int corners = 3 + static_cast<int>(random() % 60);
    for (int i = 0; i < corners; ++i) {
      const double a = 6.283185307 * i / corners, r = 200 + static_cast<double>(random() % 20'000);
      region.outer.push_back({rounded(r * std::cos(a)), rounded(r * std::sin(a))});
    }
    if (double_area(region.outer) <= 0) continue;
    const auto axis = geometry::medial_axis(region);
    REQUIRE(axis.valid);
    check_order(axis);
    check_clearance(region, axis);
  }
}
