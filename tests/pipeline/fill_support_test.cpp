// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/fill_support.h"

#include "geometry/spatial_index.h"
#include "model/flow.h"
#include "pipeline/layer_plastic.h"
#include "rectangle.h"
#include "support/body.h"

#include <algorithm>
#include <cmath>
#include <iterator>
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

Bead straight(Point a, Point b) {
  Bead out;
  out.path = {{a, 400, 1.F}, {b, 400, 1.F}};
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

TEST_CASE("support: round ends of lines stay within the area, as far from walls as it is") {
  const Regions area{rectangle(0, 0, 20000, 12000)};
  const auto filled = pipeline::fill_support(fine_lines(), {level(2000, 200, &support::SupportLayer::roof, area)}, {});
  REQUIRE(!filled.front().beads.empty());
  Um nearest = 20000;
  for (const Bead& bead : filled.front().beads)
    for (const auto& j : bead.path) {
      const Um to_edge = std::min({j.at.x, j.at.y, 20000 - j.at.x, 12000 - j.at.y});
      nearest = std::min(nearest, to_edge);
      CHECK(to_edge >= j.width / 2 - 25);  // lines are told to 20 µm
    }
  CHECK(nearest < 250);  // and no further than that
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

TEST_CASE("support: lines of a small column are joined, however much of its plastic that takes") {
  Settings s;
  s.layers.layer_height = 200;
  const auto of = [&](Um across) {
    const Regions column{rectangle(0, 0, 3600, across)};
    return pipeline::fill_support(s, {level(2000, 200, &support::SupportLayer::columns, column)}, {}).front().beads;
  };
  for (const Um across : {5000, 7000, 9000, 12000}) {
    const Beads beads = of(across);
    INFO(across);
    REQUIRE(beads.size() == 1);
    CHECK(!beads.front().closed);
    CHECK(leaves_its_chord(beads.front()) > 400);
  }
}

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

TEST_CASE("support: lines of a column that changes from level to level turn where those below do") {
  Settings s;
  s.layers.layer_height = 200;
  std::vector<support::SupportLayer> levels;
  for (int i = 0; i < 8; ++i) {  // the outline begins elsewhere on each level, and the column loses lines
    Region outline = rectangle(0, 1100 * i, 20000, 30000);
    std::rotate(outline.outer.begin(), outline.outer.begin() + i % 4, outline.outer.end());
    levels.push_back(level(2000 + 200 * i, 200, &support::SupportLayer::columns, {outline}));
  }
  const auto filled = pipeline::fill_support(s, levels, {});
  for (std::size_t k = 1; k < filled.size(); ++k) {
    INFO("level " << k);
    // Half of its turns would lie between two lines where the level below turned on their other side.
    const double hangs_um = pipeline::LayerPlastic({}, filled[k - 1].beads, 400).hanging(filled[k].beads, 1000).um;
    double laid_um = 0;
    for (const Bead& bead : filled[k].beads) laid_um += 1000 * length_mm(bead);
    CHECK(hangs_um < 0.01 * laid_um);
  }
}

TEST_CASE("support: a line of a column that is joined to no other lies on a straight one, in waves") {
  Settings s;
  s.layers.layer_height = 200;
  const double apart_um = flow::band(400, 200) * 100 / s.support.support_infill_rate;
  for (int n = -2; n <= 2; ++n) {
    const Um row = rounded(n * apart_um), beside = rounded(0.7 * apart_um);  // nearer than the next, and not hollow
    const Regions column{rectangle(500, row - beside, 29000, row + beside)};
    const auto filled = pipeline::fill_support(s, {level(2000, 200, &support::SupportLayer::columns, column)}, {});
    REQUIRE(filled.front().beads.size() == 1);
    const Bead& wave = filled.front().beads.front();
    INFO(row);
    CHECK_FALSE(wave.closed);
    CHECK(leaves_its_chord(wave) > 400);
    CHECK(length_mm(wave) < 1.4 * 28.5);
    const Bead below = straight({500, row}, {29000, row});
    CHECK(pipeline::LayerPlastic({}, {below}, 400).hanging({&wave, 1}, 4000).um == 0);
  }
}

TEST_CASE("support: what crosses from rest to rest hangs no more than what lies, loose ends do") {
  const Bead line = straight({0, 0}, {0, 10000});  // along Y
  const Bead next = straight({3000, 0}, {3000, 10000});
  const pipeline::LayerPlastic below({rectangle(20000, 0, 30000, 10000)}, {line, next}, 400);
  const auto hangs = [&](Point a, Point b) {
    const Bead bead = straight(a, b);
    return below.hanging({&bead, 1}, 4000).um;
  };
  CHECK(hangs({100, 1000}, {100, 9000}) == 0);                             // on one
  CHECK(hangs({0, 5000}, {3000, 5000}) == 0);                              // from one to the other
  CHECK(hangs({1500, 1000}, {1500, 9000}) == Approx(8000));                // between them
  CHECK(hangs({3000, 5000}, {8000, 5000}) == Approx(4700).margin(300));    // a loose end
  CHECK(hangs({3000, 5000}, {20000, 5000}) == Approx(16500).margin(600));  // too far
  CHECK(hangs({21000, 1000}, {29000, 9000}) == 0);
}

namespace {
/// Level i of a column of 40 mm whose lower side is there.
support::SupportLayer column_from(Um low, int i) {
  return level(2000 + 200 * i, 200, &support::SupportLayer::columns, {rectangle(0, low, 40000, 40000)});
}
/// Where a column's lines lie that run along x.
std::set<Um> lines_of(const Settings& s, const support::SupportLayer& column) {
  const auto filled = pipeline::fill_support(s, {column}, {});
  std::set<Um> rows;
  for (const Bead& bead : filled.front().beads) rows.insert(bead.path[0].at.y);
  REQUIRE(rows.size() > 10);
  return rows;
}
}  // namespace

TEST_CASE("support: a narrow roof crosses the lines of a column where beads along it would hang between two of them") {
  const auto s = fine_lines();
  const Regions column{rectangle(0, 0, 40000, 40000)};
  const auto of_column = level(2000, 200, &support::SupportLayer::columns, column);
  const std::set<Um> rows = lines_of(s, of_column);
  const Um row = *std::next(rows.begin(), 5), apart = *std::next(rows.begin(), 6) - row;
  const auto roof = [&](Um z, Um low, Um high) {
    return level(z, 200, &support::SupportLayer::roof, {rectangle(5000, low, 25000, high)});
  };
  const auto loops = [](const pipeline::PrintedLayer& layer) {
    return std::any_of(layer.beads.begin(), layer.beads.end(), [](const Bead& bead) { return bead.closed; });
  };
  // From line to line, with both ends of strands on one: loops lie on nothing but for the outer one.
  const auto between = pipeline::fill_support(s, {of_column, roof(2200, row - 100, row + apart + 100)}, {});
  CHECK_FALSE(loops(between[1]));
  // On another roof there is nothing to cross.
  const auto on_roof = pipeline::fill_support(
      s, {of_column, roof(2200, row - 100, row + apart + 100), roof(2400, row - 100, row + apart + 100)}, {});
  CHECK(loops(on_roof[2]));
}

TEST_CASE("support: a dab under a tip between two lines of a column lies on a rung, one on a line needs none") {
  const auto s = fine_lines();
  const auto of_column = level(2000, 200, &support::SupportLayer::columns, {rectangle(0, 0, 40000, 40000)});
  const std::set<Um> rows = lines_of(s, of_column);
  const Um row = *std::next(rows.begin(), 5), next = *std::next(rows.begin(), 6);
  const auto rungs = [&](Um y) {
    const auto dab = level(2200, 200, &support::SupportLayer::roof, {rectangle(19500, y - 500, 20500, y + 500)});
    return pipeline::fill_support(s, {of_column, dab}, {})[0].beads.size() -
           pipeline::fill_support(s, {of_column}, {}).front().beads.size();
  };
  CHECK(rungs(row) == 0);
  REQUIRE(rungs((row + next) / 2) == 1);
  const auto dab = level(2200, 200, &support::SupportLayer::roof,
                         {rectangle(19500, (row + next) / 2 - 500, 20500, (row + next) / 2 + 500)});
  const Bead rung = pipeline::fill_support(s, {of_column, dab}, {})[0].beads.back();
  std::set<Um> ends{rung.path.front().at.y, rung.path.back().at.y};
  CHECK(std::abs(*ends.begin() - row) <= 1);
  CHECK(std::abs(*ends.rbegin() - next) <= 1);
  CHECK(std::abs(rung.path.front().at.x - 20000) <= 1);
}

TEST_CASE(
    "support: what hangs over hollow columns lies on rungs and brackets, which begin on beads and are laid after "
    "them") {
  Body body;
  body.add(30, {rectangle(-2000, -2000, 2000, 2000)});
  for (Um out = 2800; out <= 14000; out += 800) body.add(1, {rectangle(-out, -out, out, out)});
  body.add(5, {rectangle(-14000, -14000, 14000, 14000)});
  const auto plan = planned(on(), body);
  Settings s;
  s.support = on();
  std::size_t rungs = 0;
  const auto filled = pipeline::fill_support(s, plan.layers, {});
  for (const auto& layer : filled) {
    Beads lower;
    for (const auto& under : filled)
      if (under.z < layer.z && under.z >= layer.z - layer.height * 3 / 2)
        lower.insert(lower.end(), under.beads.begin(), under.beads.end());
    const pipeline::LayerPlastic below({}, lower, 800);  // brackets reach a step beyond those below
    for (const Bead& bead : layer.beads) {
      if (bead.sequence == 0) continue;
      ++rungs;
      CHECK(length_mm(bead) <= 4.8);  // a bracket: from one of fewer lines to where the next would be
      Beads others;
      std::copy_if(layer.beads.begin(), layer.beads.end(), std::back_inserter(others),
                   [&](const Bead& other) { return &other != &bead; });
      const auto laid = pipeline::segments_of(others);
      CHECK(laid.nearest(bead.path.front().at, 2));
      CHECK((laid.nearest(bead.path.back().at, 2) || below.lies(bead.path.back().at) || length_mm(bead) < 1));
    }
  }
  CHECK(rungs > 10);
}

TEST_CASE("support: a roof lies on strands across its column's lines, and its own across these") {
  for (const double angle : {0.0, 30.0})
    for (const double density : {100.0, 60.0, 20.0}) {
      CAPTURE(angle, density);
      auto s = fine_lines();
      s.support.support_infill_angle = angle, s.support.support_interface_density = density;
      const Regions area{rectangle(0, 0, 40000, 30000)};
      std::vector<support::SupportLayer> stack;
      for (int i = 0; i < 15; ++i)  // so that brackets grow out of it
        stack.push_back(level(2000 + 200 * i, 200, &support::SupportLayer::columns, area));
      stack.push_back(level(5000, 200, &support::SupportLayer::under_roof, area));
      stack.push_back(level(5200, 200, &support::SupportLayer::roof, area));
      const auto filled = pipeline::fill_support(s, stack, {});
      const auto hangs_mm = [&](std::size_t k, Um span) {
        return pipeline::LayerPlastic({}, filled[k - 1].beads, 400).hanging(filled[k].beads, span).um / 1000;
      };
      for (std::size_t k = 14; k <= 16; ++k) {
        const double along = (angle + (k == 15 ? 90 : 0)) * std::numbers::pi / 180;
        std::size_t strands = 0;
        for (const Bead& bead : filled[k].beads) {
          if (bead.sequence != 0) continue;  // a rung
          ++strands;
          CHECK(bead.role == (k == 16 ? Role::support_interface : Role::support));
          const Point a = bead.path.front().at, b = bead.path.back().at;
          CHECK(std::abs((b.x - a.x) * std::sin(along) - (b.y - a.y) * std::cos(along)) < 5);
        }
        constexpr double end_mm = 1.2;  // a quarter of a span holds itself
        if (k > 14) CHECK(hangs_mm(k, 4000) < 2 * end_mm * static_cast<double>(strands));
      }
      CHECK(mm3_of(filled[15]) == Approx(40 * 30 * 0.2 * std::min(density / 100, 1.0 / 3)).epsilon(0.05));
      // From one to the next a strand of a dense roof crosses two beads' width; its ends are no longer.
      if (density > 99) CHECK(hangs_mm(16, 700) < 0.7 * 2 * static_cast<double>(filled[16].beads.size()));
    }
}

TEST_CASE("support: a strip of roof beside the one below it lies on rungs between that and the next line") {
  const Um hair = GENERATE(0, 20);  // between the column's outline and the roof's
  const auto s = fine_lines();
  auto of_column = level(2000, 200, &support::SupportLayer::columns, {rectangle(0, 0, 40000, 40000)});
  const std::set<Um> rows = lines_of(s, of_column);
  const Um row = *std::next(rows.begin(), 5), next = *std::next(rows.begin(), 6);
  of_column.columns = {rectangle(0, row + 800, 40000, 40000)};
  of_column.roof = {rectangle(0, row, 40000, row + 800 - hair)};
  const auto strip = level(2200, 200, &support::SupportLayer::roof, {rectangle(5000, row + 900, 25000, row + 1700)});
  const auto filled = pipeline::fill_support(s, {of_column, strip}, {});
  std::size_t rungs = 0;
  for (const Bead& bead : filled.front().beads) {
    if (bead.sequence == 0) continue;
    ++rungs;
    const auto [low, high] = std::minmax(bead.path.front().at.y, bead.path.back().at.y);
    CHECK(low <= row + 800);  // on the roof's outermost bead
    CHECK(std::abs(high - next) <= 1);
  }
  CHECK(rungs >= 5);
  const pipeline::LayerPlastic below({}, filled.front().beads, 400);
  CHECK(below.hanging(filled[1].beads, 5000).um == 0);
}

TEST_CASE("support: strips on either side of a column's last line lie on brackets and on rungs") {
  const auto s = fine_lines();
  const std::set<Um> rows = lines_of(s, column_from(0, 0));
  const Um last = *std::next(rows.begin(), 5), edge = last - 700;
  std::vector<support::SupportLayer> stack;
  for (int i = 0; i < 15; ++i) stack.push_back(column_from(edge, i));
  auto strips = level(2000 + 200 * 15, 200, &support::SupportLayer::roof, {rectangle(5000, edge, 25000, edge + 400)});
  strips.roof.push_back(rectangle(5000, last + 600, 25000, last + 1000));
  stack.push_back(strips);
  const auto filled = pipeline::fill_support(s, stack, {});
  const pipeline::LayerPlastic below({}, filled[14].beads, 400);
  CHECK(below.hanging(filled[15].beads, 5000).um < 0.1 * 2 * 20000);
}

TEST_CASE("support: on the bed a narrow column is beads along it, not dabs aslant") {
  auto s = fine_lines();
  s.support.support_infill_angle = 45;
  s.support.support_initial_layer_density = 90;
  for (const Um width : {420, 500, 600, 700, 1000, 1600, 2400}) {
    auto first = level(200, 200, &support::SupportLayer::columns, {rectangle(0, 0, width, 6000)});
    first.first = true;
    const auto filled = pipeline::fill_support(s, {first}, {});
    INFO(width);
    for (const Bead& bead : filled.front().beads) CHECK(length_mm(bead) > 3);
    CHECK(mm3_of(filled.front()) > 0.7 * width / 1000 * 6 * 0.2);
  }
}

TEST_CASE("support: a strip between two wide places of a column is filled, wherever its lines lie") {
  const Um wide = GENERATE(500, 1400), y = GENERATE(1000, 1900, 2800, 3700);
  const Region column{{{0, 0},
                       {10000, 0},
                       {10000, y},
                       {24000, y},
                       {24000, 0},
                       {34000, 0},
                       {34000, 10000},
                       {24000, 10000},
                       {24000, y + wide},
                       {10000, y + wide},
                       {10000, 10000},
                       {0, 10000}},
                      {}};
  const auto filled =
      pipeline::fill_support(fine_lines(), {level(2000, 200, &support::SupportLayer::columns, {column})}, {});
  const geometry::SegmentIndex laid = pipeline::segments_of(filled.front().beads);
  for (Um x = 13000; x <= 21000; x += 1000) CHECK(laid.nearest({x, y + wide / 2}, wide / 2.0));
}

TEST_CASE("support: where a column gets one more line, that lies on brackets") {
  const auto s = fine_lines();
  const std::set<Um> rows = lines_of(s, column_from(0, 0));
  const Um next = *std::next(rows.begin(), 4);  // of the column above; the one below ends just before it
  std::vector<support::SupportLayer> stack;
  for (int i = 0; i < 15; ++i) stack.push_back(column_from(next + 20, i));
  stack.push_back(column_from(next - 300, 15));
  const auto filled = pipeline::fill_support(s, stack, {});
  const auto hangs_mm = [&](bool on_brackets) {
    Beads below = filled[14].beads;
    if (!on_brackets) std::erase_if(below, [](const Bead& bead) { return bead.sequence != 0; });
    return pipeline::LayerPlastic({}, below, 400).hanging(filled[15].beads, 4000).um / 1000;
  };
  CHECK(hangs_mm(false) > 35);
  CHECK(hangs_mm(true) < 5);
  CHECK(std::none_of(filled[15].beads.begin(), filled[15].beads.end(), [](const Bead& b) { return b.sequence != 0; }));
}

TEST_CASE(
    "support: a roof that reaches beyond a column's last line lies on brackets, each grown out of the one below") {
  const auto s = fine_lines();
  const std::set<Um> rows = lines_of(s, column_from(0, 0));
  const Um last = *std::next(rows.begin(), 5), edge = last - 2300;
  constexpr int levels = 15;
  std::vector<support::SupportLayer> stack;
  for (int i = 0; i < levels; ++i) stack.push_back(column_from(edge, i));
  stack.push_back(level(2000 + 200 * levels, 200, &support::SupportLayer::roof, {rectangle(5000, edge, 25000, last)}));
  const auto filled = pipeline::fill_support(s, stack, {});
  const auto hangs_mm = [](const Beads& beads, const Beads& on) {
    return pipeline::LayerPlastic({}, on, 400).hanging(beads, 5000).um / 1000;
  };
  CHECK(hangs_mm(filled[levels].beads, filled[levels - 1].beads) < 3);  // of 90: two ends beside the outermost brackets
  std::size_t brackets = 0;
  Um reach = last;
  for (std::size_t k = levels; k-- > 0;) {
    Um low = last;
    for (const Bead& bead : filled[k].beads) {
      if (bead.sequence == 0) continue;
      ++brackets;
      const bool bar = k + 1 == levels && std::abs(bead.path.front().at.y - bead.path.back().at.y) < 1000;
      CHECK((bar || std::abs(bead.path.front().at.y - last) <= 1));
      CHECK(bead.path.back().at.y >= edge);
      low = std::min(low, bead.path.back().at.y);
    }
    if (reach < last) CHECK(low - reach <= (low < last ? 300 : 800));  // what a bead holds itself, beyond one or beside
    reach = low;
    if (k > 0) CHECK(hangs_mm(filled[k].beads, filled[k - 1].beads) < 0.4 * 20);
  }
  CHECK(brackets >= 20);
  CHECK(reach == last);  // and they begin above the lowest level
}
