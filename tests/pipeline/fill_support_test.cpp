// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/fill_support.h"

#include "geometry/spatial_index.h"
#include "rectangle.h"

#include <cmath>
#include <numbers>
#include <set>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::test;

namespace {

Settings fine_lines() {
  Settings s;
  s.layers.layer_height = 200;
  s.support.support_pattern = SupportPattern::lines;
  s.support.support_interface_pattern = SupportPattern::lines;
  return s;
}

support::SupportLayer level(Um z, Um height, Regions support::SupportLayer::*kind, const Regions& area) {
  support::SupportLayer out;
  out.z = z, out.height = height, out.*kind = area;
  return out;
}

double mm3_of(const pipeline::PrintedLayer& layer) {
  double mm3 = 0;
  for (const Bead& bead : layer.beads)
    for (std::size_t i = bead.closed ? 0 : 1, j = i == 0 ? bead.path.size() - 1 : 0; i < bead.path.size(); j = i++)
      mm3 += distance(bead.path[j].at, bead.path[i].at) / 1000 * bead.path[i].width / 1000 * layer.height / 1000;
  return mm3;
}

}  // namespace

TEST_CASE("support: beads are as much plastic as the area, the height and the share that is asked for") {
  const Regions wide{rectangle(0, 0, 240000, 240000)};  // a hundred lines: one more or less is a percent
  for (const double share : {15.0, 40.0}) {
    auto s = fine_lines();
    s.support.support_infill_rate = share;
    const auto filled = pipeline::fill_support(s, {level(2000, 200, &support::SupportLayer::columns, wide)}, {});
    CHECK(mm3_of(filled.front()) == Approx(240 * 240 * 0.2 * share / 100).epsilon(0.01));
  }
  for (const Um height : {200, 300}) {
    const auto filled =
        pipeline::fill_support(fine_lines(), {level(2000, height, &support::SupportLayer::roof, wide)}, {});
    CHECK(mm3_of(filled.front()) == Approx(240 * 240 * height / 1000.0).epsilon(0.01));
  }
}

TEST_CASE("support: lines of levels of any height lie on each other") {
  const Regions column{rectangle(0, 0, 40000, 40000)};
  const auto filled = pipeline::fill_support(fine_lines(),
                                             {level(2000, 200, &support::SupportLayer::columns, column),
                                              level(2300, 300, &support::SupportLayer::columns, column),
                                              level(2500, 200, &support::SupportLayer::columns, column)},
                                             {});
  std::vector<std::set<Um>> rows;
  for (const auto& layer : filled) {
    auto& own = rows.emplace_back();
    for (const Bead& bead : layer.beads)
      for (const auto& junction : bead.path) own.insert(junction.at.y);
  }
  CHECK(rows[0].size() > 10);
  REQUIRE(rows[1].size() == rows[0].size());
  for (auto a = rows[0].begin(), b = rows[1].begin(); a != rows[0].end(); ++a, ++b) CHECK(std::abs(*a - *b) <= 20);
  // What is the same is filled the same.
  REQUIRE(filled[2].beads.size() == filled[0].beads.size());
  for (std::size_t i = 0; i < filled[0].beads.size(); ++i) CHECK(filled[2].beads[i] == filled[0].beads[i]);
}

namespace {

/// How far a bead leaves its chord, µm: as thin as it is, it would fall over. A closed one is as wide as it is.
double leaves_its_chord(const Bead& bead) {
  if (bead.closed) return 1e9;
  double most = 0;
  for (const auto& place : bead.path)
    most = std::max(most, geometry::foot_of(place.at, {bead.path.front().at, bead.path.back().at}).distance_um);
  return most;
}

Region ellipse(double a, double b, double turn) {
  Region out;
  for (int i = 0; i < 48; ++i) {
    const double t = i * std::numbers::pi / 24, x = a * std::cos(t), y = b * std::sin(t);
    out.outer.push_back({static_cast<Um>(x * std::cos(turn) - y * std::sin(turn)),
                         static_cast<Um>(x * std::sin(turn) + y * std::cos(turn))});
  }
  return out;
}

}  // namespace

TEST_CASE("support: no line of a column stands alone") {
  Settings s;
  s.layers.layer_height = 200;
  for (double a = 1000; a < 12000; a += 370)
    for (double b = a; b < 3 * a; b += 0.45 * a)
      for (const double turn : {0.0, 0.7, 1.5}) {
        const Regions column{ellipse(a, b, turn)};
        const auto filled = pipeline::fill_support(s, {level(2000, 200, &support::SupportLayer::columns, column)}, {});
        REQUIRE(!filled.front().beads.empty());
        for (const Bead& bead : filled.front().beads) {
          INFO(a << " by " << b << ", turned by " << turn);
          CHECK(leaves_its_chord(bead) > 400);
        }
      }
}
