// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/solid.h"

#include "areas.h"
#include "picture.h"

#include <algorithm>
#include <numbers>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::test;
using infill::SolidStyle;

namespace {
Beads filled(const Region& region, const SolidStyle& style) {
  Beads beads;
  tests::look_at({region});
  infill::fill_solid(region, style, beads);
  tests::show_beads(beads);
  return beads;
}
}  // namespace

TEST_CASE("solid: the volume of an area's lines is the area's", "[infill][law]") {
  const double angle = GENERATE(0.0, 30.0, 45.0, 90.0, 135.0);
  const bool connect = GENERATE(true, false);
  const SolidStyle style{.band = 420, .angle_rad = degrees(angle), .connect = connect};
  CAPTURE(angle, connect);
  CHECK(covered_mm2(filled(rectangle(0, 0, 20000, 20000), style)) == Approx(400).epsilon(0.003));
  const Region frame = with_hole(rectangle(0, 0, 20000, 15000), 4000, 5000, 9000, 9000);
  CHECK(covered_mm2(filled(frame, style)) == Approx(280).epsilon(0.005));
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    const Region region = star(seed, 12000, 17);
    CAPTURE(seed);
    CHECK(covered_mm2(filled(region, style)) == Approx(area_mm2(region)).epsilon(0.01));
  }
}

TEST_CASE("solid: with ends_within no end of a line stands out of the area", "[infill]") {
  const double angle = GENERATE(0.0, 30.0, 90.0);
  const bool connect = GENERATE(true, false);
  CAPTURE(angle, connect);
  constexpr Um side = 8000, half = 215;
  const auto near_the_edge = [&](bool within) {
    constexpr Um rounding = 25;  // lines are as wide as whole ones fit
    const SolidStyle style{.band = 2 * half, .angle_rad = degrees(angle), .connect = connect, .ends_within = within};
    int count = 0;
    for (const Bead& bead : filled(rectangle(0, 0, side, side), style))
      for (const Junction& j : bead.path)
        count += std::min({j.at.x, j.at.y, side - j.at.x, side - j.at.y}) < half - rounding;
    return count;
  };
  const int within = near_the_edge(true);
  CHECK(within <= (angle == 30.0 ? 4 : 0));  // lines in corners are too short to be kept back
  CHECK(near_the_edge(false) >= within + (connect ? 2 : 30));
}

TEST_CASE("solid: with ends_within a strand along a strip keeps its round ends in it", "[infill]") {
  constexpr Um length = 3000, wide = 430;
  const double lean = GENERATE(-1.2, -0.35, 0.35, 0.8, 1.5);  // of the strip against the lines
  CAPTURE(lean);
  const auto turned = [&](double x, double y) {
    return Point{rounded(x * std::cos(lean) - y * std::sin(lean)), rounded(x * std::sin(lean) + y * std::cos(lean))};
  };
  const Region strip{{turned(0, 0), turned(length, 0), turned(length, wide), turned(0, wide)}, {}};
  const auto ends = [&](bool within) {
    double least = length;
    for (const Bead& bead : filled(strip, {.band = wide, .angle_rad = 0, .ends_within = within}))
      for (const Junction& j : {bead.path.front(), bead.path.back()}) {
        const double along = j.at.x * std::cos(lean) + j.at.y * std::sin(lean);
        least = std::min(least, std::min(along, length - along) - j.width / 2.0);
      }
    return least;
  };
  CHECK(ends(true) > -wide / 4.0);  // at 60° a line in its corner has its middle a fifth of a line nearer
  CHECK(ends(true) < wide / 2.0);   // and no further in than that
  CHECK(ends(false) < ends(true) - 100);
}

TEST_CASE("solid: with ends_within lines of a round area keep their ends in it", "[infill]") {
  constexpr Um band = 430;
  const double radius = GENERATE(1000.0, 1700.0, 2500.0, 6000.0);
  const int corners = GENERATE(16, 40);
  CAPTURE(radius, corners);
  Region disc;
  for (int i = 0; i < corners; ++i) {
    const double at = 2 * std::numbers::pi * (i + 0.3) / corners;
    disc.outer.push_back({rounded(radius * std::cos(at)), rounded(radius * std::sin(at))});
  }
  double most = -band;  // how far round ends reach over it
  for (const Bead& bead : filled(disc, {.band = band, .angle_rad = 0, .connect = false, .ends_within = true}))
    for (const Junction& j : {bead.path.front(), bead.path.back()})
      most = std::max(most, std::hypot(j.at.x, j.at.y) + j.width / 2.0 - radius);
  CHECK(most < band / 6);  // beside an edge a line is no narrower for short
}

TEST_CASE("solid: lines lie side by side without gap and without overlap", "[infill][law]") {
  const double angle = GENERATE(0.0, 45.0, 77.0);
  const Beads beads = filled(rectangle(0, 0, 8000, 5000), {.band = 430, .angle_rad = degrees(angle)});
  int bare = 0, twice = 0, all = 0;
  for (double x = 650; x < 7400; x += 31)
    for (double y = 650; y < 4400; y += 29) {
      const auto n = cover(beads, x, y);
      ++all, bare += n == 0, twice += n > 1;
    }
  CAPTURE(angle);
  CHECK(bare <= all / 500);  // a line's width is rounded to a micron
  CHECK(twice <= all / 200);
}

TEST_CASE("solid: lines along a side fill the width exactly, whatever it is", "[infill]") {
  for (Um width = 900; width < 3000; width += 130) {
    const Beads beads = filled(rectangle(0, 0, 10000, width), {.band = 430, .angle_rad = 0, .connect = false});
    REQUIRE(!beads.empty());
    Um lowest = max_coord, highest = 0;
    for (const Bead& bead : beads)
      for (const Junction& j : bead.path) {
        lowest = std::min(lowest, j.at.y - j.width / 2), highest = std::max(highest, j.at.y + j.width / 2);
        CHECK(std::abs(j.width - 430) <= 430 / 4 + 1);
      }
    CHECK(lowest <= 2);
    CHECK(highest >= width - 2);
  }
}

TEST_CASE("solid: lines beside an edge cover what is between them and it, whatever the grid of the lines is",
          "[infill][law]") {
  const auto offset = GENERATE(range(0, 440, 55));
  // a hole whose sides lie anywhere between two lines, and an outline that a line runs along at a slant
  const Region frame = with_hole(rectangle(0, 0, 12000, 9000), 3000, 3000 + offset, 9000, 6000 - offset / 2);
  const Region wedge{{{0, 0}, {12000, 900 + offset}, {12000, 6000 + offset}, {0, 7000 - offset}}, {}};
  for (const Region& region : {frame, wedge}) {
    const Beads beads = filled(region, {.band = 430, .angle_rad = 0, .connect = false});
    int bare = 0, twice = 0, beyond = 0, all = 0, outside = 0;
    for (double x = 130; x < 11900; x += 97)
      for (double y = 20; y < 7000; y += 23) {
        const bool corner = std::abs(x - 3000) < 150 || std::abs(x - 9000) < 150;  // lines step aside there
        if (corner) continue;
        const auto n = cover(beads, x, y);
        const bool in = holds({region}, {rounded(x), rounded(y)});
        in ? ++all : ++outside;
        if (in) bare += n == 0, twice += n > 1;
        if (!in) beyond += n > 0;
      }
    CAPTURE(offset, all, outside);
    // where a line steps aside it lies over a corner of its neighbour; beside a slant its width follows in part, and
    // where for short not at all
    const int slants = region.holes.empty() ? 3 : 0;
    CHECK(bare <= (2 + slants) * all / 200);
    CHECK(twice <= (2 + slants) * all / 200);
    CHECK(beyond <= (2 + slants) * all / 400);
  }
}

TEST_CASE("solid: a line is much wider or narrower than others only where it stays so", "[infill]") {
  constexpr Um band = 430;
  const auto widths = [](const Region& region) {
    std::pair<Um, Um> all{max_coord, 0};
    for (const Bead& bead : filled(region, {.band = band, .angle_rad = 0, .connect = false}))
      for (const Junction& j : bead.path)
        all.first = std::min(all.first, j.width), all.second = std::max(all.second, j.width);
    return all;
  };
  const double slope = GENERATE(0.2, 0.3);  // of an edge that each line runs along for 2.2 and 1.4 mm
  CAPTURE(slope);
  const auto beside_slant = widths({{{0, 0}, {12000, rounded(slope * 12000)}, {12000, 9000}, {0, 9000}}, {}});
  CHECK(beside_slant.first >= 0.8 * band);
  CHECK(beside_slant.second <= 1.2 * band);
  const auto beside_hole = widths(with_hole(rectangle(0, 0, 12000, 20 * band), 3000, 10 * band + 120, 9000, 15 * band));
  CHECK(beside_hole.second == Approx(band + 120 / 6.0).margin(2));  // six lines share that
  const auto beside_two = widths(with_hole(rectangle(0, 0, 12000, 20 * band), 3000, 2 * band + 120, 9000, 15 * band));
  CHECK(beside_two.second == Approx(band + 120 / 2.0).margin(2));
}

TEST_CASE("solid: lines that share what an edge asks of one lie side by side, and come back beyond it", "[infill]") {
  constexpr Um band = 430;
  const Um more = GENERATE(-200, -120, 120, 200);  // room beside the hole than its lines fill
  const bool mirrored = GENERATE(false, true);
  Region area = with_hole(rectangle(0, 0, 24000, 20 * band), 8000, 7 * band + more, 16000, 15 * band);
  if (mirrored) area = with_hole(rectangle(0, 0, 24000, 20 * band), 8000, 5 * band, 16000, 13 * band - more);
  CAPTURE(more, mirrored);
  const Beads beads = filled(area, {.band = band, .angle_rad = 0, .connect = false});
  const auto y_at = [&](double x) {  // of the lines, away from the hole's other side
    std::vector<double> ys;
    for (const Bead& bead : beads)
      for (std::size_t i = 1; i < bead.path.size(); ++i) {
        Point a = bead.path[i - 1].at, b = bead.path[i].at;
        if (a.x > b.x) std::swap(a, b);
        if (a.x <= x && x < b.x) ys.push_back(std::lerp(a.y, b.y, (x - a.x) / (b.x - a.x)));
      }
    std::sort(ys.begin(), ys.end());
    if (mirrored) {
      for (double& y : ys) y = 20 * band - y;
      std::reverse(ys.begin(), ys.end());
    }
    ys.resize(7);
    return ys;
  };
  const std::vector<double> beside = y_at(12000), away = y_at(3000);
  const double shared = band + more / 6.0;
  CHECK(beside[0] == Approx(away[0]).margin(2));
  for (std::size_t i = 2; i < 7; ++i)
    CHECK(beside[i] - beside[i - 1] == Approx(shared).margin(16));  // less is not worth a corner
  for (std::size_t i = 1; i < 7; ++i) CHECK(away[i] - away[i - 1] == Approx(band).margin(2));
}

TEST_CASE("solid: beside a wall with bumps only the first line bends", "[infill]") {
  constexpr Um band = 430, apart = 2000;
  const double lean = GENERATE(0.0, 0.003);  // of the wall
  Region area{{{12 * apart, 20 * band}, {0, 20 * band}}, {}};
  for (Um x = 0; x <= 12 * apart; x += apart) {
    const Um y = rounded(lean * x);
    area.outer.push_back({x, y});
    if (x == 12 * apart) break;
    for (const auto& [away, high] : {std::pair{600, 0}, {900, 70}, {1100, 70}, {1400, 0}})
      area.outer.push_back({x + away, y + high});
  }
  std::size_t bent = 0, all = 0;
  for (const Bead& bead : filled(area, {.band = band, .angle_rad = 0, .connect = false}))
    ++all, bent += bead.path.size() > 2;
  CAPTURE(lean);
  CHECK(all == 20);
  CHECK(bent <= 1);
}

TEST_CASE("solid: lines begin at the wall, and are even beside an edge that is loose", "[infill]") {
  constexpr Um band = 430, length = 12000;
  const Um high = GENERATE(7 * band + 100, 7 * band + 200, 7 * band + 350);
  const bool below = GENERATE(true, false);  // the loose edge is the lower one
  const double lean = GENERATE(0.0, 0.7);
  CAPTURE(high, below, lean);
  const auto at = [lean](double x, double y) {
    return Point{rounded(x * std::cos(lean) - y * std::sin(lean)), rounded(x * std::sin(lean) + y * std::cos(lean))};
  };
  Region area{{at(0, 0), at(length, 0), at(length, high), at(0, high + 700)}, {}};
  if (below) area.outer = {at(0, -700), at(length, 0), at(length, high), at(0, high)};
  // what lies beyond, which has a corner more there
  const geometry::SegmentIndex loose(std::vector<geometry::Segment>{
      {area.outer[below ? 0 : 2], area.outer[below ? 1 : 3]}, {at(0, 20000), at(length, 20000)}});
  const Beads beads =
      filled(area, {.band = band, .angle_rad = lean, .connect = false, .ends_within = true, .loose = &loose});
  REQUIRE(beads.size() >= 7);
  double nearest = length;  // of the lines' sides to the wall's
  for (const Bead& bead : beads)
    for (const Junction& j : bead.path) {
      CHECK(std::abs(j.width - band) <= 1);
      const double y = j.at.y * std::cos(lean) - j.at.x * std::sin(lean);
      nearest = std::min(nearest, (below ? high - y : y) - j.width / 2.0);
    }
  CHECK(std::abs(nearest) < 4);
}

TEST_CASE("solid: every line is printed after its neighbour below", "[infill][law]") {
  const Region frame =
      with_hole(with_hole(rectangle(0, 0, 20000, 15000), 4000, 5000, 9000, 9000), 12000, 2000, 16000, 13000);
  const bool connect = GENERATE(true, false);
  const Beads beads = filled(frame, {.band = 400, .angle_rad = 0, .connect = connect, .sequence = 7});
  struct Line {
    Um y, from, to;
  };
  std::vector<Line> printed;
  for (const Bead& bead : beads) {
    CHECK(bead.sequence == 7);
    for (std::size_t i = 1; i < bead.path.size(); ++i) {
      const Point a = bead.path[i - 1].at, b = bead.path[i].at;
      if (a.y == b.y) printed.push_back({a.y, std::min(a.x, b.x), std::max(a.x, b.x)});
    }
  }
  REQUIRE(printed.size() > 60);
  for (std::size_t i = 0; i < printed.size(); ++i)
    for (std::size_t j = i + 1; j < printed.size(); ++j) {
      const bool beside = std::min(printed[i].to, printed[j].to) - std::max(printed[i].from, printed[j].from) > 400;
      if (beside && std::abs(printed[i].y - printed[j].y) < 500) CHECK(printed[i].y < printed[j].y);
    }
}

TEST_CASE("solid: joined lines are fewer beads of the same volume", "[infill]") {
  const Region square = rectangle(0, 0, 20000, 20000);
  const Beads joined = filled(square, {.band = 420, .angle_rad = degrees(45), .connect = true});
  const Beads apart = filled(square, {.band = 420, .angle_rad = degrees(45), .connect = false});
  CHECK(joined.size() < 5);
  CHECK(apart.size() > 60);
  CHECK(covered_mm2(joined) == Approx(covered_mm2(apart)).epsilon(0.003));
}

TEST_CASE("solid: lines that run out in an acute corner are one bead with those before them", "[infill]") {
  for (Um height = 3500; height <= 6000; height += 250) {
    const Region corner{{{0, 0}, {6000, 0}, {4000, height}}, {}};
    const Beads beads = filled(corner, {.band = 430, .angle_rad = 0});
    CAPTURE(height);
    CHECK(beads.size() == 1);
    CHECK(covered_mm2(beads) == Approx(area_mm2(corner)).epsilon(0.02));
  }
}

TEST_CASE("solid: where an area forks its lines go on in one of the branches", "[infill]") {
  const Region fork{
      {{0, 0}, {15000, 0}, {15000, 9000}, {10000, 9000}, {10000, 4300}, {5000, 4300}, {5000, 9000}, {0, 9000}}, {}};
  const Beads beads = filled(fork, {.band = 430, .angle_rad = 0});
  CHECK(beads.size() == 2);
  CHECK(covered_mm2(beads) == Approx(area_mm2(fork)).epsilon(0.005));
}

TEST_CASE("solid: a strip narrower than a line gets one bead as wide as the strip", "[infill]") {
  const Region strip{{{0, 0}, {20000, 0}, {20000, 300}, {0, 300}}, {}};
  const Beads beads = filled(strip, {.band = 430, .angle_rad = degrees(45)});
  CHECK(covered_mm2(beads) == Approx(6).epsilon(0.05));
  CHECK(beads.size() <= 3);
  CHECK(std::any_of(beads.begin(), beads.end(), [](const Bead& b) { return b.role == Role::gap_fill; }));
}

TEST_CASE("solid: without gap fill a strip narrower than a line stays open, and wide areas stay as they are",
          "[infill]") {
  const Region strip{{{0, 0}, {20000, 0}, {20000, 300}, {0, 300}}, {}};
  CHECK(covered_mm2(filled(strip, {.band = 430, .angle_rad = degrees(45), .gaps = false})) == 0);
  const Region square{{{0, 0}, {20000, 0}, {20000, 20000}, {0, 20000}}, {}};
  CHECK(filled(square, {.band = 430, .gaps = false}).size() == filled(square, {.band = 430}).size());
}

TEST_CASE("solid: a strip that runs out to nothing has no bead where it is thinner than any that can be laid",
          "[infill][law]") {
  // A quarter of a line. Half a millimetre of such ends was 0.01 mm wide.
  const double angle = GENERATE(range(0, 180, 15));
  CAPTURE(angle);
  int gaps = 0;
  for (const Um wide : {150, 300, 500, 700}) {
    CAPTURE(wide);
    const Region wedge{{{0, 0}, {12000, 0}, {6000, wide}}, {}};
    for (const Bead& bead : filled(wedge, {.band = 420, .angle_rad = degrees(angle)})) {
      if (bead.role != Role::gap_fill) continue;
      ++gaps;
      for (const Junction& j : bead.path) CHECK(j.width >= 420 / 4);
    }
  }
  if (angle > 30 && angle < 150) CHECK(gaps >= 3);
}

TEST_CASE("solid: a corner that stands out of a strip makes its lines no narrower", "[infill]") {
  const Region strip{{{0, 0}, {20000, 0}, {20000, 1480}, {19400, 1480}, {19400, 1230}, {0, 1230}}, {}};
  const Beads beads = filled(strip, {.band = 410});
  int lines = 0;
  for (const Bead& bead : beads)
    for (std::size_t i = 1; i < bead.path.size(); ++i) {
      const Junction &a = bead.path[i - 1], &b = bead.path[i];
      if (std::abs(b.at.x - a.at.x) < 15000) continue;
      ++lines;
      CHECK(a.width == Approx(410).margin(2));
      CHECK(b.width == Approx(410).margin(2));
    }
  CHECK(lines == 3);
  CHECK(covered_mm2(beads) == Approx(area_mm2(strip)).epsilon(0.01));
}

TEST_CASE("solid: notches part a strip's side and make its lines no other than on a whole side", "[infill]") {
  const bool mirrored = GENERATE(false, true);
  Ring ring{{0, 0}, {19400, 0}, {19400, -180}, {20000, -180}, {20000, 1230}};  // a corner stands out, too
  for (Um x = 16000; x > 0; x -= 4000)
    for (const Point p : {Point{x + 800, 1230}, {x + 800, 750}, {x, 750}, {x, 1230}}) ring.push_back(p);
  ring.push_back({0, 1230});
  if (mirrored) {
    for (Point& p : ring) p.y = -p.y;
    std::reverse(ring.begin(), ring.end());
  }
  const Beads beads = filled({ring, {}}, {.band = 410});
  double plain = 0, whole = 0;
  for (const Bead& bead : beads)
    for (std::size_t i = 1; i < bead.path.size(); ++i) {
      const Junction &a = bead.path[i - 1], &b = bead.path[i];
      const double length = distance(a.at, b.at);
      whole += length;
      if (std::abs(a.width - 410) <= 2 && std::abs(b.width - 410) <= 2) plain += length;
    }
  CHECK(plain > 0.85 * whole);
}

TEST_CASE("solid: beside edges that run along lines at a slant widths stay near that of a line", "[infill][law]") {
  constexpr Um band = 430;
  const double slope = GENERATE(0.03, 0.1, 0.2, 0.35);
  CAPTURE(slope);
  const Um up = rounded(slope * 20000);
  const Region wedge{{{0, 0}, {20000, up}, {20000, up + 4000}, {0, 4000}}, {}};
  for (const bool connect : {true, false})
    for (const Bead& bead : filled(wedge, {.band = band, .connect = connect}))
      for (const Junction& j : bead.path) {
        CHECK(j.width >= 0.6 * band);
        CHECK(j.width <= 1.5 * band);
      }
}

TEST_CASE("solid: lines end where there is less room than for a third of one", "[infill]") {
  for (const Um high : {90, 220}) {
    CAPTURE(high);
    const Um y = 1000;  // a line of the wide part lies there
    Region area = rectangle(0, 0, 9000, 4000);
    area.outer = {{0, 0},
                  {9000, 0},
                  {9000, y - high / 2},
                  {14000, y - high / 2},
                  {14000, y + high / 2},
                  {9000, y + high / 2},
                  {9000, 4000},
                  {0, 4000}};
    Um farthest = 0;
    for (const Bead& bead : filled(area, {.band = 400}))
      for (const Junction& j : bead.path) farthest = std::max(farthest, j.at.x);
    CHECK((farthest > 9500) == (high > 130));
  }
}

TEST_CASE("solid: a bead along a strip whose sides lean towards each other lies on its axis", "[infill]") {
  const Region wedge{{{0, 100}, {0, -100}, {9000, -300}, {9000, 300}}, {}};  // its axis is y = 0
  const double angle = GENERATE(30, 45, 60, 120, 135);
  CAPTURE(angle);
  int looked_at = 0;
  for (const Bead& bead : filled(wedge, {.band = 420, .angle_rad = degrees(angle)}))
    for (std::size_t i = 1; i + 1 < bead.path.size() && bead.role == Role::gap_fill; ++i, ++looked_at) {
      const Junction& j = bead.path[i];
      CHECK(std::abs(j.at.y) <= 3);
      CHECK(j.width == Approx(200 + 400.0 * j.at.x / 9000).margin(5));
    }
  CHECK(looked_at >= 5);
}

TEST_CASE("solid: a strand along a narrow strip of a bridge is a bridge", "[infill]") {
  const SolidStyle bridge{
      .role = Role::bridge, .band = 400, .angle_rad = degrees(60), .fixed_strand = true, .flow = 1.57};
  const Beads beads = filled(rectangle(0, 0, 6000, 450), bridge);
  REQUIRE(!beads.empty());
  for (const Bead& bead : beads) CHECK(bead.role == Role::bridge);
}

TEST_CASE("solid: lines reach over the edge by the overlap and no further", "[infill][law]") {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const Region region = star(seed, 9000, 13);
    const Beads beads = filled(region, {.band = 400, .angle_rad = degrees(45), .overlap = {50}});
    for (const Bead& bead : beads)
      for (const Junction& j : bead.path) {
        // an overlap of 50 µm across a shallow edge is up to 125 along the line; turns may bend a quarter of a line
        bool near = side_of(region.outer, j.at) != Side::outside;
        for (int a = 0; a < 16 && !near; ++a)
          near = side_of(region.outer, {j.at.x + rounded(240 * std::cos(a * 0.3927)),
                                        j.at.y + rounded(240 * std::sin(a * 0.3927))}) != Side::outside;
        CHECK(near);
      }
  }
}

TEST_CASE("solid: slivers that lie between other areas are no beads", "[infill]") {
  Beads beads;
  SolidStyle style;
  style.band = 400;
  fill_solid(rectangle(0, 0, 60, 20000), style, beads);
  fill_solid(rectangle(0, 0, 20000, 60), style, beads);
  CHECK(beads.empty());
  fill_solid(rectangle(0, 0, 150, 20000), style, beads);
  CHECK(beads.size() == 1);
}

TEST_CASE("solid: what is shorter than a line is wide is no bead, however narrow it is", "[infill]") {
  const SolidStyle style{.band = 400, .angle_rad = 0, .overlap = {60}};
  for (const Um width : {110, 150, 300, 400}) {
    CHECK(filled(rectangle(0, 0, 300, width), style).empty());
    CHECK(filled(rectangle(0, 0, 600, width), style).size() == 1);
  }
}

TEST_CASE("solid: nothing, specks and needles are borne", "[infill]") {
  const SolidStyle style{.band = 430, .angle_rad = degrees(45), .overlap = {45}};
  CHECK(filled({}, style).empty());
  CHECK(filled({{{0, 0}, {1000, 0}}, {}}, style).empty());
  filled(rectangle(0, 0, 1, 1), style);
  filled(rectangle(0, 0, 20, 30), style);
  filled({{{0, 0}, {50000, 1}, {0, 2}}, {}}, style);
  filled({{{0, 0}, {1000, 0}, {2000, 0}}, {}}, style);
}
