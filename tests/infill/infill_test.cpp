// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/infill.h"

#include "areas.h"
#include "infill/strips.h"
#include "model/flow.h"

#include <algorithm>
#include <numbers>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::test;
using infill::FillInput;
using infill::LayerAreas;

namespace {

LayerAreas solid_area(Region region) {
  LayerAreas areas(1);
  areas[0].part = 3;
  areas[0].solid.push_back(std::move(region));
  return areas;
}
FillInput input(const LayerAreas& areas, std::size_t index = 0) {
  tests::look_at(areas[0].solid);
  return {.areas = areas, .index = index, .z = 200, .height = 200, .nozzle = 400};
}
Region turned(const Region& region, double angle) {
  Region r = region;
  for (Point& p : r.outer)
    p = {rounded(p.x * std::cos(angle) - p.y * std::sin(angle)),
         rounded(p.x * std::sin(angle) + p.y * std::cos(angle))};
  return r;
}

}  // namespace

TEST_CASE("infill: an automatic line width that is cut is said", "[infill]") {
  InfillSettings settings;
  CHECK(infill::check(settings, 400, 200).empty());
  const auto cut = infill::check(settings, 400, 60);
  REQUIRE(cut.size() == 1);
  CHECK(cut[0].code == "infill_line_width_cut");
  CHECK(cut[0].message.find("1.20 mm") != std::string::npos);
  settings.infill_line_width = 450;
  CHECK(infill::check(settings, 400, 60).empty());
}

TEST_CASE("infill: a slot between walls is filled wherever lines lie beside it", "[infill]") {
  const Um width = GENERATE(250, 330, 410);
  for (Um y = 9000; y < 9450; y += 50) {  // a bar across it decides where lines lie
    CAPTURE(width, y);
    Region cross;
    for (const Point p : {Point{9000, 0},
                          {11000, 0},
                          {11000, y},
                          {20000, y},
                          {20000, y + width},
                          {11000, y + width},
                          {11000, 20000},
                          {9000, 20000},
                          {9000, y + width},
                          {0, y + width},
                          {0, y},
                          {9000, y}})
      cross.outer.push_back(p);
    const LayerAreas areas = solid_area(std::move(cross));
    ShellSettings shells;
    shells.skin_angle = 0;
    const Beads beads = infill::fill({}, shells, input(areas)).beads;
    for (const double x : {1000.0, 5000.0, 8000.0, 12000.0, 15000.0, 19000.0})
      CHECK(cover(beads, x, y + width / 2.0) == 1);
  }
}

TEST_CASE("infill: an arm of an area is filled along, whichever way its lines run", "[infill]") {
  const double angle = degrees(GENERATE(0, 15, 30, 45, 60, 75, 90, 105, 120, 135, 150, 165));
  const Um wide = GENERATE(300, 500, 600, 900);
  CAPTURE(angle, wide);
  Region area;  // a square with an arm out of its right side
  for (const Point p : {Point{-4000, -4000},
                        {4000, -4000},
                        {4000, -wide / 2},
                        {9000, -wide / 2},
                        {9000, wide / 2},
                        {4000, wide / 2},
                        {4000, 4000},
                        {-4000, 4000}})
    area.outer.push_back(p);
  const LayerAreas areas = solid_area(turned(area, angle));
  ShellSettings shells;
  shells.skin_angle = 45, shells.skin_line_width = 450;
  const Beads beads = infill::fill({}, shells, input(areas)).beads;
  const double lines = wide < 800 ? 1 : 2;
  double laid = 0;  // µm² of lines in the arm between 5 and 8.5 mm
  for (const Bead& bead : beads)
    for (std::size_t i = 1; i < bead.path.size(); ++i) {
      const Junction &a = bead.path[i - 1], &b = bead.path[i];
      for (double t = 0.005; t < 1; t += 0.01) {
        const double x = std::lerp(a.at.x, b.at.x, t), y = std::lerp(a.at.y, b.at.y, t);
        if (const double u = x * std::cos(angle) + y * std::sin(angle), v = y * std::cos(angle) - x * std::sin(angle);
            u < 5000 || u > 8500 || std::abs(v) > wide / 2.0)
          continue;
        const double width = std::lerp(a.width, b.width, t);
        CHECK(width == Approx(wide / lines).epsilon(0.05));
        laid += width * distance(a.at, b.at) * 0.01;
      }
    }
  CHECK(laid == Approx(3500.0 * wide).epsilon(0.05));
}

TEST_CASE("infill: a straight-walled area is covered up to its walls", "[infill][law]") {
  const bool turns = GENERATE(true, false);
  const double angle = GENERATE(0.0, 12.3, 45.0, 81.7);
  const std::size_t layer = GENERATE(0U, 1U);
  const Region square = rectangle(0, 0, 17400, 9130);
  const LayerAreas areas = solid_area(turned(square, degrees(angle)));
  InfillSettings settings;
  settings.infill_connect_lines = turns;
  const Beads beads = infill::fill(settings, {}, input(areas, layer)).beads;
  // No gap is wider than 0.05 mm; two turns side by side leave a cusp of up to 0.15 mm between their round
  // corners.
  const double reach = turns ? 75 : 25;
  int gaps = 0;
  for (double x = 30; x < 17400; x += 61)
    for (double y = 30; y < 9130; y += 59) {
      const bool corner = (x < 500 || x > 16900) && (y < 500 || y > 8630);
      const auto laid = [&](double u, double v) {
        if (u < 0 || v < 0 || u > 17400 || v > 9130) return true;  // there is the wall
        const double c = std::cos(degrees(angle)), s = std::sin(degrees(angle));
        return cover(beads, u * c - v * s, u * s + v * c) > 0;
      };
      if (corner || laid(x, y)) continue;
      bool near = false;
      for (int k = 0; k < 8; ++k) near |= laid(x + reach * std::cos(k * 0.785), y + reach * std::sin(k * 0.785));
      gaps += !near;
    }
  CAPTURE(angle, layer, turns);
  CHECK(gaps == 0);
}

TEST_CASE(
    "infill: a full block's volume is right within half a percent of its area, with ends that overlap the wall too",
    "[infill][law]") {
  InfillSettings none;
  none.infill_overlap = length(0);
  const LayerAreas areas = solid_area(rectangle(0, 0, 17400, 17400));
  CHECK(covered_mm2(infill::fill(none, {}, input(areas)).beads) == Approx(17.4 * 17.4).epsilon(0.003));
  CHECK(covered_mm2(infill::fill({}, {}, input(areas)).beads) == Approx(17.4 * 17.4).epsilon(0.005));
}

TEST_CASE("infill: lines run along a strip of up to five of them, on every layer", "[infill]") {
  const double angle = GENERATE(0, 0.3, 1.2);
  const Um width = GENERATE(1700, 2400);
  const LayerAreas strip = solid_area(turned(rectangle(0, 0, 30000, width), angle)),
                   area = solid_area(rectangle(0, 0, 30000, 6000));
  const auto longest = [](const LayerAreas& areas, std::size_t index) {  // a bead's mean line
    const Beads beads = infill::fill({}, {}, input(areas, index)).beads;
    double most = 0;
    for (const Bead& bead : beads)
      for (std::size_t i = 1; i < bead.path.size(); ++i)
        most = std::max(most, distance(bead.path[i - 1].at, bead.path[i].at));
    return most;
  };
  for (const std::size_t index : {0U, 1U}) CHECK(longest(strip, index) > 28000);
  CHECK(longest(area, 1) < 8000);  // a wider one is crossed
}

TEST_CASE("infill: lines of a long top run along it on every layer, those of others turn", "[infill]") {
  const double angle = GENERATE(0, 0.3, 1.2);
  const auto longest = [&](Um length, Um width, std::size_t index, const ShellSettings& shells) {
    LayerAreas areas(1);
    areas[0].top.push_back(turned(rectangle(0, 0, length, width), angle));
    tests::look_at(areas[0].top);
    double most = 0;
    const FillInput layer{.areas = areas, .index = index, .z = 200, .height = 200, .nozzle = 400};
    for (const Bead& bead : infill::fill({}, shells, layer).beads)
      for (std::size_t i = 1; i < bead.path.size(); ++i)
        most = std::max(most, distance(bead.path[i - 1].at, bead.path[i].at));
    return most;
  };
  for (const std::size_t index : {0U, 1U}) CHECK(longest(30000, 7000, index, {}) > 28000);
  CHECK(longest(30000, 20000, 0, {}) > 28000);
  CHECK(longest(30000, 20000, 1, {}) < 21000);
  ShellSettings asked;  // for a direction
  asked.skin_angle = angle * 180 / std::numbers::pi;
  CHECK(longest(30000, 7000, 1, asked) < 8000);
}

TEST_CASE("infill: behind a single wall, or none, lines with their round ends stay within the outline",
          "[infill][law]") {
  const int walls = GENERATE(0, 1);
  const double depth = walls == 0 ? 0 : (420 + flow::band(420, 200)) / 2.0;  // of the automatic width's wall
  LayerAreas areas = solid_area(rectangle(0, 0, 9000, 6000));
  areas[0].top.push_back(rectangle(9000, 0, 18000, 6000));
  areas[0].sparse.push_back(rectangle(0, 6000, 18000, 20000));
  FillInput in = input(areas);
  in.wall_count = walls;
  const Beads beads = infill::fill({}, {}, in).beads;
  CHECK(std::any_of(beads.begin(), beads.end(), [](const Bead& b) { return b.role == Role::infill; }));
  double furthest = 0;
  for (const Bead& bead : beads)
    for (const Junction& j : bead.path) {
      const double beyond =
          std::max({0.0 - j.at.x, 0.0 - j.at.y, j.at.x - 18000.0, j.at.y - 20000.0});  // out of the areas together
      furthest = std::max(furthest, beyond + flow::line_width(j.width, 200) / 2.0 - depth);
    }
  // without walls the bands of lines along the outline end on it, and their widest points a little beyond
  CHECK(furthest <= (walls == 0 ? flow::bulge_um(500, 200, 1) : 0) + 2);  // the lattice
}

TEST_CASE("infill: every bead knows its part, ordered fills have a sequence of their own", "[infill]") {
  LayerAreas areas = solid_area(rectangle(0, 0, 9000, 9000));
  areas[0].top.push_back(rectangle(20000, 0, 29000, 9000));
  areas[0].sparse.push_back(rectangle(40000, 0, 60000, 20000));
  areas[0].bridges.push_back({{rectangle(70000, 0, 80000, 9000)}, 0});
  std::vector<std::uint32_t> of_role(20, 0);
  for (const Bead& bead : infill::fill({}, {}, input(areas)).beads) {
    CHECK(bead.part == 3);
    CHECK((bead.sequence == 0) == (bead.role == Role::infill));
    of_role[static_cast<std::size_t>(bead.role)] = bead.sequence;
  }
  CHECK(of_role[static_cast<std::size_t>(Role::solid_infill)] != of_role[static_cast<std::size_t>(Role::top_skin)]);
  CHECK(of_role[static_cast<std::size_t>(Role::bridge)] != of_role[static_cast<std::size_t>(Role::top_skin)]);
}

TEST_CASE("infill: lines run along walls, also where a longer edge that is no wall runs nearly so", "[infill]") {
  const double angle = GENERATE(0.0, 30.0);
  for (const Um slant : {-120, 120}) {  // 0.35° over 20 mm, which is longer than either piece of wall
    CAPTURE(angle, slant);
    const Region area{
        {{0, 0}, {9000, 0}, {9000, 3000}, {11000, 3000}, {11000, 0}, {20000, 0}, {20000, 9000}, {0, 9000 + slant}}, {}};
    for (const std::size_t layer : {0U, 1U}) {
      const LayerAreas areas = solid_area(turned(area, degrees(angle)));
      double all = 0, straight = 0;
      for (const Bead& bead : fill({}, {}, input(areas, layer)).beads)
        for (std::size_t i = 1; i < bead.path.size(); ++i) {
          const Point a = bead.path[i - 1].at, b = bead.path[i].at;
          const double length = distance(a, b);
          if (length < 4000) continue;
          const double lean = std::atan2(b.y - a.y, b.x - a.x) - degrees(angle + (layer == 0 ? 0 : 90));
          CHECK(std::abs(std::sin(lean)) < 0.006);  // no more than the edge that some lines beside it share
          all += length, straight += std::abs(std::sin(lean)) < 0.0005 ? length : 0;
        }
      CHECK(straight > all / 2);
    }
  }
}

TEST_CASE(
    "infill: lines of a narrow area run along it, whichever way its edge runs, and along walls that run nearly so",
    "[infill]") {
  const double angle = GENERATE(0.0, 20.0, 65.0);
  const std::size_t layer = GENERATE(0U, 1U);
  CAPTURE(angle, layer);
  const auto lean_of = [&](const Region& area) {  // of the longest line, against the area's own direction
    const LayerAreas areas = solid_area(turned(area, degrees(angle)));
    double longest = 0, lean = 0;
    for (const Bead& bead : fill({}, {}, input(areas, layer)).beads)
      for (std::size_t i = 1; i < bead.path.size(); ++i) {
        const Point a = bead.path[i - 1].at, b = bead.path[i].at;
        if (distance(a, b) <= longest) continue;
        longest = distance(a, b), lean = std::atan2(b.y - a.y, b.x - a.x) - degrees(angle);
      }
    REQUIRE(longest > 0);
    return std::abs(std::sin(lean));
  };
  // an arrowhead, and one that a wall runs along at 6°
  CHECK(lean_of({{{0, 0}, {1500, -600}, {3600, -250}, {3600, 250}, {1500, 600}}, {}}) < 0.05);
  CHECK(lean_of({{{0, 0}, {4000, 420}, {3000, 1100}, {1500, 1300}, {600, 900}}, {}}) < 0.2);
}

TEST_CASE("infill: lines run along straight walls, however long round ones are", "[infill]") {
  const auto pierced = [](int corners) {
    Region area = rectangle(0, 0, 16000, 16000);
    for (const Point centre : {Point{4000, 4000}, {12000, 4000}, {4000, 12000}, {12000, 12000}}) {
      Ring hole;
      for (int i = corners; i > 0; --i)
        hole.push_back({centre.x + rounded(3300 * std::cos(degrees(360.0 * i / corners))),
                        centre.y + rounded(3300 * std::sin(degrees(360.0 * i / corners)))});
      area.holes.push_back(std::move(hole));
    }
    return area;
  };
  for (const int corners : {24, 120}) {
    CAPTURE(corners);
    const LayerAreas areas = solid_area(pierced(corners));
    for (const Bead& bead : fill({}, {}, input(areas)).beads)
      for (std::size_t i = 1; i < bead.path.size(); ++i) {
        const Point a = bead.path[i - 1].at, b = bead.path[i].at;
        if (distance(a, b) > 2500) CHECK(std::abs(b.y - a.y) < 100);
      }
  }
  Region round;
  for (int i = 0; i < 40; ++i)
    round.outer.push_back({rounded(9000 * std::cos(degrees(9.0 * i))), rounded(9000 * std::sin(degrees(9.0 * i)))});
  CHECK_FALSE(infill::angle_along_walls(round));
}

TEST_CASE("infill: bridges are strands of the nozzle's diameter", "[infill]") {
  LayerAreas areas(1);
  areas[0].bridges.push_back({{rectangle(0, 0, 20000, 10000)}, degrees(90)});
  ShellSettings shells;
  InfillSettings none;
  none.infill_overlap = length(0);
  const double strands = 20.0 / 0.4;
  for (const double percent : {100.0, 80.0}) {
    shells.bridge_flow = percent;
    const Beads beads = infill::fill(none, shells, input(areas)).beads;
    double volume = 0;
    for (const Bead& bead : beads) {
      CHECK(bead.role == Role::bridge);
      volume += volume_mm3(bead, 200);
    }
    CHECK(volume == Approx(strands * 10 * flow::bridge_area_mm2(400) * percent / 100).epsilon(0.01));
  }
}

TEST_CASE("infill: lines of a ledge are those of other solid layers, in its direction", "[infill]") {
  LayerAreas areas(1);
  areas[0].bridges.push_back({{rectangle(0, 0, 20000, 10000)}, degrees(20), true});
  const Beads beads = infill::fill({}, {}, input(areas)).beads;
  REQUIRE(!beads.empty());
  double volume = 0, along = 0, all = 0;
  for (const Bead& bead : beads) {
    CHECK(bead.role == Role::solid_infill);
    volume += volume_mm3(bead, 200);
    for (std::size_t i = 1; i < bead.path.size(); ++i) {
      const Point a = bead.path[i - 1].at, b = bead.path[i].at;
      const double length = distance(a, b);
      all += length;
      if (std::abs(std::sin(std::atan2(b.y - a.y, b.x - a.x) - degrees(20))) < 0.02) along += length;
    }
  }
  CHECK(volume == Approx(20 * 10 * 0.2).epsilon(0.02));
  CHECK(along > 0.8 * all);  // the rest are turns
}

TEST_CASE("infill: solid lines cross the strands of the bridge below, unless a direction is asked for", "[infill]") {
  const LayerAreas areas = solid_area(rectangle(0, 0, 20000, 20000));
  const std::vector<infill::BridgeArea> below{{{rectangle(0, 0, 20000, 15000)}, degrees(30)}};
  const auto direction = [&](const ShellSettings& shells, std::span<const infill::BridgeArea> bridges) {
    auto in = input(areas);
    in.bridges_below = bridges;
    double best = 0, angle = 0;
    for (const Bead& bead : infill::fill({}, shells, in).beads)
      for (std::size_t i = 1; i < bead.path.size(); ++i) {
        const Point a = bead.path[i - 1].at, b = bead.path[i].at;
        if (distance(a, b) > best) best = distance(a, b), angle = std::atan2(b.y - a.y, b.x - a.x);
      }
    return angle;
  };
  CHECK(std::abs(std::cos(direction({}, below) - degrees(30))) < 0.02);
  for (const double strands : {10.0, 75.0, 105.0, 170.0}) {  // along the walls, or square on them
    const std::vector<infill::BridgeArea> nearly{{{rectangle(0, 0, 20000, 15000)}, degrees(strands)}};
    CHECK(std::abs(std::sin(2 * direction({}, nearly))) < 0.02);
    CHECK(std::abs(std::cos(direction({}, nearly) - degrees(strands))) < 0.3);
  }
  ShellSettings asked;
  asked.skin_angle = 10;
  CHECK(std::abs(std::sin(direction(asked, below) - direction(asked, {}))) < 1e-6);
  const std::vector<infill::BridgeArea> beside{{{rectangle(0, 0, 20000, 5000)}, degrees(30)}};
  CHECK(std::abs(std::sin(direction({}, beside) - direction({}, {}))) < 1e-6);
}

TEST_CASE("infill: tops whose lines are as long either way run like those of their layer that are not", "[infill]") {
  const std::size_t index = GENERATE(0U, 1U);
  const bool upright = GENERATE(false, true);
  const auto box = [upright](Um x0, Um y0, Um x1, Um y1) {
    return upright ? rectangle(y0, x0, y1, x1) : rectangle(x0, y0, x1, y1);
  };
  Region round;
  for (int i = 0; i < 60; ++i)
    round.outer.push_back({rounded(5000 * std::cos(degrees(6.0 * i))), rounded(5000 * std::sin(degrees(6.0 * i)))});
  LayerAreas areas = solid_area(box(20000, 0, 32000, 12000));
  areas[0].top = {round, box(20000, 0, 32000, 12000), box(50000, 0, 70000, 5000)};
  areas[0].solid.clear();
  const auto all_run = [&](double angle) {
    const Beads beads = infill::fill({}, {}, input(areas, index)).beads;
    CHECK(beads.size() >= areas[0].top.size());
    for (const Bead& bead : beads)
      for (std::size_t i = 1; i < bead.path.size(); ++i) {
        const Point a = bead.path[i - 1].at, b = bead.path[i].at;
        if (distance(a, b) < 3000) continue;  // a turn
        if (std::abs(std::sin(std::atan2(b.y - a.y, b.x - a.x) - degrees(angle))) > 0.02) return false;
      }
    return true;
  };
  CHECK(all_run(upright ? 90 : 0));
  areas[0].top.pop_back();  // of what is left the largest has a direction of its own, from layer to layer
  CHECK(all_run(index == 1 ? 90 : 0));
}

TEST_CASE("infill: strips that bend are filled along their edge, as whoever can do that gives their lines",
          "[infill]") {
  const auto ring = [](double inner, double outer) {
    Region out;
    Ring hole;
    for (int i = 0; i < 120; ++i) {
      const double a = degrees(3.0 * i);
      out.outer.push_back({rounded(outer * std::cos(a)), rounded(outer * std::sin(a))});
      hole.push_back({rounded(inner * std::cos(-a)), rounded(inner * std::sin(-a))});
    }
    out.holes.push_back(std::move(hole));
    return out;
  };
  const Role role = GENERATE(Role::solid_infill, Role::top_skin);
  const auto along = [role](const Region& region, const ShellSettings& shells = {}) {
    LayerAreas areas = solid_area(region);
    if (role == Role::top_skin) areas[0].top.swap(areas[0].solid);
    auto in = input(areas, 1);
    in.along_edge = [](const Region& strip, Um) {
      return Beads{{{{strip.outer[0], 411}, {strip.outer[40], 411}, {strip.outer[80], 411}}, Role::inner_wall, true, 2},
                   {{{{0, 0}, 411}, {{200, 0}, 411}}, Role::inner_wall}};  // a dab
    };
    const Beads beads = infill::fill({}, shells, in).beads;
    const bool found = beads.size() == 1 && beads[0].closed && beads[0].path.size() == 3;
    if (found) CHECK((beads[0].role == role && beads[0].part == 3 && beads[0].inset == 0));
    CHECK(!beads.empty());
    return found;
  };
  CHECK(along(ring(10000, 11200)));
  CHECK(along(ring(10000, 10800)));
  CHECK_FALSE(along(ring(10000, 13500)));                    // it is crossed
  CHECK_FALSE(along(ring(1, 1200)));                         // a patch
  CHECK_FALSE(along({{{0, 0}, {2400, 0}, {0, 1200}}, {}}));  // too, with as much edge as a strip
  CHECK_FALSE(along(rectangle(0, 0, 30000, 1200)));          // straight lines along it do
  ShellSettings asked;
  asked.skin_angle = 10;
  CHECK_FALSE(along(ring(10000, 11200), asked));
}

TEST_CASE("infill: on a bridge lines of a strip run along it, if that is not along the strands", "[infill]") {
  const LayerAreas areas = solid_area(rectangle(0, 0, 20000, 1200));
  const auto lines_over = [&](double angle) {
    const std::vector<infill::BridgeArea> below{{{rectangle(0, 0, 20000, 15000)}, degrees(angle)}};
    auto in = input(areas);
    in.bridges_below = below;
    std::size_t lines = 0;
    for (const Bead& bead : infill::fill({}, {}, in).beads) lines += bead.path.size();
    return lines;
  };
  for (const double strands : {65.0, 75.0, 90.0, 105.0, 115.0}) CHECK(lines_over(strands) <= 8);
  for (const double strands : {0.0, 30.0, 50.0, 140.0}) CHECK(lines_over(strands) > 20);
}

TEST_CASE("infill: settings of widths and directions do something", "[infill]") {
  LayerAreas areas = solid_area(rectangle(0, 0, 20000, 20000));
  areas[0].top.push_back(rectangle(30000, 0, 50000, 20000));
  areas[0].sparse.push_back(rectangle(60000, 0, 90000, 30000));
  const Beads plain = infill::fill({}, {}, input(areas)).beads;
  const auto differs = [&](auto change) {
    InfillSettings infill;
    ShellSettings shells;
    change(infill, shells);
    return infill::fill(infill, shells, input(areas)).beads != plain;
  };
  CHECK(differs([](auto&, auto& s) { s.skin_line_width = 500; }));
  CHECK(differs([](auto&, auto& s) { s.top_skin_line_width = 500; }));
  CHECK(differs([](auto&, auto& s) { s.skin_angle = 30; }));
  CHECK(differs([](auto& i, auto&) { i.infill_line_width = 500; }));
  CHECK(differs([](auto& i, auto&) { i.infill_angle = 10; }));
  CHECK(differs([](auto& i, auto&) { i.infill_overlap = share(30); }));
  CHECK(differs([](auto& i, auto&) { i.infill_connect_lines = false; }));
  CHECK(differs([](auto& i, auto&) { i.infill_pattern = InfillPattern::gyroid; }));
  CHECK(differs([](auto& i, auto&) { i.infill_sparse_density = 30; }));
  CHECK(infill::fill({}, {}, input(areas, 1)).beads != plain);
}

TEST_CASE("infill: moving a part moves its fill and changes nothing else", "[infill][law]") {
  const Point by{7'001, -90'003};
  LayerAreas areas = solid_area(star(5, 15000, 17));
  areas[0].sparse.push_back(star(6, 20000, 11));
  LayerAreas there = areas;
  there[0].solid = moved(there[0].solid, by), there[0].sparse = moved(there[0].sparse, by);
  FillInput far = input(there);
  far.origin = by;
  Beads here = infill::fill({}, {}, input(areas)).beads;
  for (Bead& bead : here)
    for (Junction& j : bead.path) j.at = j.at + by;
  CHECK(here == infill::fill({}, {}, far).beads);
}

namespace {

/// Of the longest straight piece of sparse infill, 0 … π.
double direction_of(const Beads& beads) {
  double longest = 0, angle = 0;
  for (const Bead& bead : beads)
    for (std::size_t i = 1; i < bead.path.size(); ++i) {
      const Point d = bead.path[i].at - bead.path[i - 1].at;
      if (std::hypot(d.x, d.y) > longest) longest = std::hypot(d.x, d.y), angle = std::atan2(d.y, d.x);
    }
  return angle < 0 ? angle + std::numbers::pi : angle;
}

LayerAreas sparse_area(int layers, std::size_t turn) {
  LayerAreas areas(1);
  const Regions square{rectangle(-20'000, -20'000, 20'000, 20'000)};
  (layers > 1 ? areas[0].combined : areas[0].sparse) = square;
  areas[0].combined_layers = layers, areas[0].combined_turn = turn;
  return areas;
}

}  // namespace

TEST_CASE("infill: layers printed at once turn from one time to the next, as single layers do", "[infill]") {
  InfillSettings settings;
  settings.infill_pattern = InfillPattern::lines;
  const auto fill = [&](std::size_t turn) {
    const LayerAreas areas = sparse_area(2, turn);
    return infill::fill(settings, {}, {.areas = areas, .index = 2 * turn + 2, .z = 600, .height = 200, .nozzle = 400});
  };
  for (const std::size_t turn : {0U, 1U, 2U})
    CHECK(direction_of(fill(turn).beads) == Approx(degrees(turn % 2 == 0 ? 45 : 135)).margin(1e-3));
}

TEST_CASE("infill: lines stand on each other in layers of any height", "[infill]") {
  InfillSettings settings;
  settings.infill_pattern = InfillPattern::aligned, settings.infill_angle = 0;
  infill::Prepared prepared;
  prepared.band = 600;
  const LayerAreas areas = sparse_area(1, 0);
  const auto rows = [&](Um height) {  // y of lines
    std::vector<Um> out;
    const auto layer = infill::fill(
        settings, {}, {.areas = areas, .index = 3, .z = 1'000, .height = height, .nozzle = 400, .prepared = &prepared});
    for (const Bead& bead : layer.beads)
      for (std::size_t i = 1; i < bead.path.size(); ++i)
        if (bead.path[i].at.y == bead.path[i - 1].at.y) out.push_back(bead.path[i].at.y);
    std::sort(out.begin(), out.end());
    return out;
  };
  CHECK(rows(100) == rows(300));
  CHECK(rows(100).size() > 10);
}

TEST_CASE("infill: directions stand still against the plate, or against the part", "[infill]") {
  InfillSettings settings;
  settings.infill_pattern = InfillPattern::aligned, settings.infill_angle = 10;
  const LayerAreas areas = sparse_area(1, 0);
  const auto direction = [&] {
    return direction_of(
        infill::fill(settings, {},
                     {.areas = areas, .index = 3, .z = 1'000, .height = 200, .nozzle = 400, .turned_rad = degrees(30)})
            .beads);
  };
  CHECK(direction() == Approx(degrees(10)).margin(1e-3));
  settings.infill_angle_frame = InfillFrame::part;
  CHECK(direction() == Approx(degrees(40)).margin(1e-3));
}
