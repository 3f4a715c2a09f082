// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/boolean.h"
#include "pipeline/fill_support.h"
#include "pipeline/layer_plastic.h"
#include "rectangle.h"
#include "support/body.h"
#include "support/column_steps.h"
#include "support/lengths.h"
#include "support/plastic.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::test;

namespace {

constexpr Um height = 200;

Settings with_steps(int steps, SupportPattern pattern = SupportPattern::zigzag) {
  Settings s;
  s.layers.layer_height = height;
  s.support.support_roof_enable = false;
  s.support.support_pattern = pattern;
  s.support.gradual_support_infill_steps = steps;
  return s;
}

/// A column as it stands on every level, and what its highest carries.
std::vector<support::SupportLayer> column_of(const Regions& area, int levels) {
  std::vector<support::SupportLayer> out(static_cast<std::size_t>(levels));
  for (std::size_t k = 0; k < out.size(); ++k) {
    out[k].z = 2000 + static_cast<Um>(k + 1) * height, out[k].height = height;
    out[k].columns = area;
  }
  out.back().carried = area;
  return out;
}

double laid_mm(const Beads& beads) {
  double mm = 0;
  for (const Bead& bead : beads) mm += length_mm(bead);
  return mm;
}

Beads without_rungs(Beads beads) {
  std::erase_if(beads, [](const Bead& bead) { return bead.sequence != 0; });
  return beads;
}

/// What of a layer's beads has nothing below, and crosses no further than feet are apart, mm.
double hangs_mm(const Settings& s, const pipeline::PrintedLayer& layer, const Beads& below) {
  const Um span = support::between_feet(s.machine.nozzle_diameter);
  return pipeline::LayerPlastic({}, below, 400).hanging(without_rungs(layer.beads), span).um / 1000;
}

Region round_of(Point at, double a, double b, double turn) {
  Region out;
  for (int i = 0; i < 40; ++i) {
    const double t = i * std::numbers::pi / 20, x = a * std::cos(t), y = b * std::sin(t);
    out.outer.push_back(
        at + Point{rounded(x * std::cos(turn) - y * std::sin(turn)), rounded(x * std::sin(turn) + y * std::cos(turn))});
  }
  return out;
}

}  // namespace

TEST_CASE("support: shares of columns halve as far as what begins on their lines can cross") {
  SupportSettings s;
  const Um band = 357, nozzle = 400;
  const double least = static_cast<double>(band) / (support::between_feet(nozzle) + 400);
  const auto shares = [&](double percent, int steps, SupportPattern pattern = SupportPattern::zigzag) {
    s.support_infill_rate = percent, s.gradual_support_infill_steps = steps, s.support_pattern = pattern;
    return support::column_shares(s, nozzle, band);
  };
  CHECK(shares(15, 0) == std::vector{0.15});
  CHECK(shares(15, 1) == std::vector{0.15, 0.075});
  CHECK(shares(15, 5) == std::vector{0.15, 0.075});
  CHECK(shares(40, 2) == std::vector{0.4, 0.2, 0.1});
  CHECK(shares(40, 5) == std::vector{0.4, 0.2, 0.1, least});
  CHECK(shares(10, 1) == std::vector{0.1, least});
  CHECK(shares(8, 3) == std::vector{0.08});  // as far apart as that already
  CHECK(shares(0, 3) == std::vector{0.0});
  CHECK(shares(15, 3, SupportPattern::grid) == std::vector{0.15});
  CHECK(shares(40, 3, SupportPattern::grid) == std::vector{0.4, 0.2, 2 * least});
  CHECK(shares(40, 3, SupportPattern::gyroid) == std::vector{0.4});
  CHECK(shares(40, 3, SupportPattern::concentric) == std::vector{0.4});
  s.support_conical_enabled = true;
  CHECK(shares(40, 3) == std::vector{0.4});
}

TEST_CASE("support: a step's height below what it carries a column has half as many lines, which run across") {
  const Regions area{rectangle(0, 0, 60000, 60000)};
  for (const auto pattern : {SupportPattern::lines, SupportPattern::zigzag}) {
    const auto s = with_steps(1, pattern);
    const auto filled = pipeline::fill_support(s, column_of(area, 60), {});
    const auto dense = pipeline::fill_support(with_steps(0, pattern), column_of(area, 60), {});
    for (std::size_t k = 0; k < 60; ++k) {
      INFO("level " << k);
      const Um below = static_cast<Um>(59 - k) * height;
      const Beads own = without_rungs(filled[k].beads);
      if (below < s.support.gradual_support_infill_step_height) {
        CHECK(own == dense[k].beads);
        continue;
      }
      CHECK(laid_mm(own) == Approx(0.5 * laid_mm(dense[k].beads)).epsilon(0.04));  // one line more or less of 13
      double along_x = 0, along_y = 0;
      for (const Bead& bead : own)
        for (std::size_t i = 1; i < bead.path.size(); ++i) {
          along_x += std::abs(bead.path[i].at.x - bead.path[i - 1].at.x) / 1000.0;
          along_y += std::abs(bead.path[i].at.y - bead.path[i - 1].at.y) / 1000.0;
        }
      CHECK(along_x < 0.15 * along_y);  // turns
    }
    double mm = 0, dense_mm = 0;
    for (std::size_t k = 0; k < 60; ++k) mm += laid_mm(filled[k].beads), dense_mm += laid_mm(dense[k].beads);
    CHECK(mm < 0.62 * dense_mm);  // (8 + 52 / 2) / 60 = 0.57, and brackets
  }
}

TEST_CASE("support: what carries nothing, and columns of one density, are as without steps") {
  const Regions area{rectangle(0, 0, 40000, 30000)};
  auto stack = column_of(area, 40);
  const auto off = pipeline::fill_support(with_steps(0), stack, {});
  stack.back().carried.clear();
  const auto untold = pipeline::fill_support(with_steps(1), stack, {});
  stack = column_of({rectangle(0, 0, 4000, 30000)}, 40);  // narrow
  const auto narrow = pipeline::fill_support(with_steps(1), stack, {}),
             narrow_off = pipeline::fill_support(with_steps(0), stack, {});
  for (std::size_t k = 0; k < off.size(); ++k) {
    CHECK(off[k].beads == untold[k].beads);
    CHECK(narrow[k].beads == narrow_off[k].beads);
  }
}

TEST_CASE("support: what begins at a step lies on the lines below it, whatever the column") {
  std::mt19937 random(7);
  const auto between = [&](double from, double to) { return std::uniform_real_distribution<>(from, to)(random); };
  std::size_t stepped = 0;
  for (int i = 0; i < 60; ++i) {
    std::vector<Ring> rings;
    for (int k = 0; k < 3; ++k)
      rings.push_back(round_of({rounded(between(-9000, 9000)), rounded(between(-9000, 9000))}, between(4000, 22000),
                               between(4000, 12000), between(0, 3.1))
                          .outer);
    const Regions area = geometry::regions_from_rings(rings);
    for (const auto pattern : {SupportPattern::zigzag, SupportPattern::lines, SupportPattern::grid}) {
      auto s = with_steps(1 + i % 3, pattern);
      s.support.support_infill_angle = i % 4 == 0 ? between(0, 180) : 0;
      if (i % 3 != 0 || pattern == SupportPattern::grid) s.support.support_infill_rate = 40;
      auto stack = column_of(area, 60);
      if (i % 2 == 0) {  // part of it ends halfway up, under something of its own
        const Regions half{rectangle(-50000, -50000, rounded(between(-6000, 6000)), 50000)};
        stack[30].carried = geometry::intersect(area, half);
        for (std::size_t k = 31; k < stack.size(); ++k) stack[k].columns = geometry::subtract(area, half);
        stack.back().carried = stack.back().columns;
      }
      const auto filled = pipeline::fill_support(s, stack, {});
      double hangs = 0, loose = 0, begun = 0;
      for (std::size_t k = 1; k < filled.size(); ++k) {
        if (without_rungs(filled[k].beads) == without_rungs(filled[k - 1].beads)) continue;
        ++stepped;
        begun += laid_mm(without_rungs(filled[k].beads));
        hangs += hangs_mm(s, filled[k], filled[k - 1].beads);
        loose += hangs_mm(s, filled[k], without_rungs(filled[k - 1].beads));
      }
      INFO("column " << i << ", pattern " << static_cast<int>(pattern) << ", " << loose << " mm without rungs");
      // Turns beyond the last line below, where there is no room for brackets. Of lines along others half would hang.
      CHECK(hangs < 0.25 * begun);
      CHECK(hangs <= loose);
    }
  }
  CHECK(stepped > 200);
}

TEST_CASE("support: columns with fewer lines below take as much less plastic as is reckoned") {
  Body body = tee(200);
  double before_mm3 = 0;
  for (const int steps : {0, 1}) {
    Settings s;
    s.layers.layer_height = height;
    s.support = on();
    s.support.gradual_support_infill_steps = steps;
    const auto plan = planned(s.support, body);
    const double reckoned_mm3 = support::plastic_mm3(s.support, s.machine.nozzle_diameter, plan);
    double mm3 = 0;
    for (const auto& layer : pipeline::fill_support(s, plan.layers, {}))
      for (const Bead& bead : layer.beads)
        mm3 += length_mm(bead) * to_mm(bead.path.front().width) * to_mm(layer.height);
    INFO(steps << " steps");
    CHECK(mm3 == Approx(reckoned_mm3).epsilon(0.12));  // turns, brackets
    if (steps > 0) CHECK(mm3 < 0.75 * before_mm3);
    before_mm3 = mm3;
  }
}
