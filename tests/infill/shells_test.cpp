// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/shells.h"

#include "areas.h"
#include "geometry/boolean.h"
#include "geometry/offset.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::test;
using infill::LayerAreas;
using infill::PartAreas;
using infill::ShellLayer;

namespace {

/// An object from its outlines, with walls of 1 mm.
struct Object {
  std::vector<Regions> outlines, insides;
  std::vector<ShellLayer> layers;

  explicit Object(std::vector<Regions> from, Um wall = 1000) : outlines(std::move(from)) {
    for (const Regions& r : outlines) insides.push_back(geometry::offset(r, {.by = -wall}));
    for (std::size_t i = 0; i < outlines.size(); ++i)
      layers.push_back({static_cast<Um>(200 * (i + 1)), 200, &outlines[i], &insides[i]});
  }
  std::vector<LayerAreas> areas(const ShellSettings& shells, const InfillSettings& infill = {}) const {
    return infill::find_areas(shells, infill, {layers, infill::box_of(layers), 400}, 0, layers.size());
  }
};

/// Counts of layers, thicknesses and the smallest sparse patch.
ShellSettings skin(int top, int bottom, Um top_thickness, Um bottom_thickness, double below_area = 20) {
  ShellSettings shells;
  shells.top_layers = top, shells.bottom_layers = bottom;
  shells.top_thickness = top_thickness, shells.bottom_thickness = bottom_thickness;
  shells.infill_solid_below_area = below_area;
  return shells;
}

double sum(const LayerAreas& layer, Regions PartAreas::*kind) {
  double mm2 = 0;
  for (const PartAreas& part : layer) mm2 += area_mm2(part.*kind);
  return mm2;
}
double bridged(const LayerAreas& layer) {
  double mm2 = 0;
  for (const PartAreas& part : layer)
    for (const infill::BridgeArea& b : part.bridges) mm2 += b.ledge ? 0 : area_mm2(b.regions);
  return mm2;
}
double ledges(const LayerAreas& layer) {
  double mm2 = 0;
  for (const PartAreas& part : layer)
    for (const infill::BridgeArea& b : part.bridges) mm2 += b.ledge ? area_mm2(b.regions) : 0;
  return mm2;
}
double all(const LayerAreas& layer) {
  return sum(layer, &PartAreas::top) + sum(layer, &PartAreas::solid) + sum(layer, &PartAreas::sparse) +
         sum(layer, &PartAreas::belted) + bridged(layer) + ledges(layer);
}
bool bridged_at(const LayerAreas& layer, Point p) {
  return std::any_of(layer.begin(), layer.end(), [&](const PartAreas& a) {
    return std::any_of(a.bridges.begin(), a.bridges.end(), [&](const auto& b) { return holds(b.regions, p); });
  });
}
bool solid_at(const LayerAreas& layer, Point p) {
  return bridged_at(layer, p) || std::any_of(layer.begin(), layer.end(), [&](const PartAreas& a) {
           return holds(a.top, p) || holds(a.solid, p) || holds(a.belted, p);
         });
}

}  // namespace

TEST_CASE("shells: a block has its solid layers below and above, and nothing else", "[infill]") {
  const Object block(std::vector<Regions>(20, {rectangle(0, 0, 20000, 20000)}));
  const ShellSettings shells = skin(3, 2, 0, 0);
  const auto areas = block.areas(shells);
  for (std::size_t i = 0; i < 20; ++i) {
    CAPTURE(i);
    CHECK(sum(areas[i], &PartAreas::sparse) == Approx(i >= 2 && i < 17 ? 324 : 0).margin(0.001));
    CHECK(sum(areas[i], &PartAreas::top) == Approx(i == 19 ? 324 : 0).margin(0.001));
    CHECK(all(areas[i]) == Approx(324));
  }
}

TEST_CASE("shells: what is seen from above between two walls is top, however narrow it gets", "[infill]") {
  // From 0.1 to 0.9 mm between the walls above the hole, and 0.35 mm beside it.
  Region frame = rectangle(0, 0, 40000, 20000);
  frame.holes.push_back({{2350, 5000}, {2350, 17900}, {37000, 17100}, {37000, 5000}});
  const auto areas = Object(std::vector<Regions>(12, {frame})).areas({});
  CHECK(sum(areas[11], &PartAreas::solid) == 0);
  CHECK(sum(areas[11], &PartAreas::top) == Approx(all(areas[11])));
  // Steps of 0.3 mm along the wall of what stands on the layer are not: they would be lines beside others of their own.
  std::vector<Regions> steps;
  for (Um in = 0; in < 12 * 300; in += 300) steps.push_back({rectangle(in, 0, 40000, 20000)});
  const auto stepped = Object(std::move(steps)).areas({});
  for (std::size_t i = 0; i + 1 < 12; ++i) CHECK(sum(stepped[i], &PartAreas::top) == 0);
}

TEST_CASE("shells: what stands on a top surface covers top like the rest, unless it covers most of it", "[infill]") {
  const Region plate = rectangle(0, 0, 30000, 20000);
  // a block of that width stands on a plate of three layers
  const auto below_block = [&](Um width, Um length) {
    std::vector<Regions> outlines(3, {plate});
    outlines.resize(8, {rectangle(15000 - width / 2, 10000 - length / 2, 15000 + width / 2, 10000 + length / 2)});
    return Object(std::move(outlines)).areas(skin(5, 4, 0, 0))[2];
  };
  for (const Um width : {1600, 5000, 9000}) {
    CHECK(sum(below_block(width, 8000), &PartAreas::solid) == 0);
    CHECK(sum(below_block(width, 8000), &PartAreas::top) == Approx(28 * 18));
  }
  CHECK(sum(below_block(24000, 14000), &PartAreas::solid) == Approx((24 - 0.9) * (14 - 0.9)).epsilon(0.1));
}

TEST_CASE("shells: narrow solid beside a top is one surface with it under walls, and stays solid where it leads away",
          "[infill]") {
  std::vector<Regions> steps(14, {rectangle(0, 0, 30000, 20000)});
  steps.resize(24, {rectangle(0, 0, 20000, 20000)});
  const LayerAreas step = Object(std::move(steps), 1200).areas(skin(4, 4, 0, 0))[13];
  CHECK(sum(step, &PartAreas::sparse) > 100);
  CHECK(sum(step, &PartAreas::top) == Approx((8.8 + 1.1) * 17.6).epsilon(0.05));  // and what carries the walls above

  std::vector<Regions> bars(3, {rectangle(0, 0, 30000, 3000)});
  bars.resize(8, {rectangle(5000, 0, 30000, 3000)});
  const LayerAreas bar = Object(std::move(bars)).areas(skin(5, 4, 0, 0))[2];
  CHECK(sum(bar, &PartAreas::top) == Approx(4.2).epsilon(0.05));
}

TEST_CASE("shells: what lies between two floors that are near each other is top like them, also beside sparse infill",
          "[infill]") {
  const auto between = [](Um width) {  // two pockets in a block, and how much of the strip between their floors is top
    Region pocketed = rectangle(0, 0, 40000, 30000);
    const Um left = 20000 - width / 2, right = 20000 + width / 2;
    pocketed.holes = {rectangle(left - 6000, 10000, left, 20000).outer,
                      rectangle(right, 10000, right + 6000, 20000).outer};
    for (Ring& hole : pocketed.holes) std::reverse(hole.begin(), hole.end());
    std::vector<Regions> outlines(10, {rectangle(0, 0, 40000, 30000)});
    outlines.resize(20, {pocketed});
    const LayerAreas floor = Object(std::move(outlines), 1200).areas(skin(4, 4, 0, 0))[9];
    CHECK(sum(floor, &PartAreas::sparse) > 300);
    double mm2 = 0;
    for (const PartAreas& part : floor)
      mm2 += area_mm2(geometry::intersect(part.top, {rectangle(left, 10000, right, 20000)}));
    return mm2 / (to_mm(width) * 10);
  };
  CHECK(between(1500) > 0.95);
  CHECK(between(5000) == Approx(2 * 1.0 / 5).margin(0.06));  // what carries the pockets' walls
}

TEST_CASE("shells: infill_support_enabled keeps infill only below what does not carry itself", "[infill]") {
  InfillSettings below_tops;
  below_tops.infill_support_enabled = true;
  const auto kept = [&](const Object& object, const InfillSettings& infill) {
    auto areas = object.areas(skin(3, 2, 0, 0, 0), infill);
    infill::keep_below_tops(infill, {object.layers, infill::box_of(object.layers), 400}, areas);
    double mm2 = 0;
    for (const LayerAreas& layer : areas) mm2 += sum(layer, &PartAreas::sparse);
    return mm2;
  };
  // A flat roof is carried all over, down to the bottom.
  const Object block(std::vector<Regions>(20, {rectangle(0, 0, 20000, 20000)}));
  CHECK(kept(block, below_tops) == Approx(kept(block, {})).epsilon(0.001));
  // A steep roof carries itself: 0.1 mm a layer of 0.2 mm is 27° from the vertical.
  std::vector<Regions> steep;
  for (Um i = 0; i < 90; ++i) steep.push_back({rectangle(100 * i, 100 * i, 20000 - 100 * i, 20000 - 100 * i)});
  const Object roof(std::move(steep));
  CHECK(kept(roof, {}) > 1000);
  CHECK(kept(roof, below_tops) < 0.02 * kept(roof, {}));
  below_tops.infill_support_angle = 20;
  CHECK(kept(roof, below_tops) > 0.9 * kept(roof, {}));
  // Half of a block is covered by a flat roof at half its height: only what stands below it, and the roof of the other.
  below_tops.infill_support_angle = 40;
  std::vector<Regions> steps(20, {rectangle(0, 0, 20000, 20000)});
  steps.resize(40, {rectangle(0, 0, 8000, 20000)});
  const Object two(std::move(steps));
  CHECK(kept(two, below_tops) == Approx(kept(two, {})).epsilon(0.03));
}

TEST_CASE("shells: thickness asks for as many layers as it needs", "[infill]") {
  const Object block(std::vector<Regions>(20, {rectangle(0, 0, 20000, 20000)}));
  const auto solid_layers = [&](const ShellSettings& shells) {
    const auto areas = block.areas(shells);
    return std::count_if(areas.begin(), areas.end(),
                         [](const LayerAreas& a) { return sum(a, &PartAreas::sparse) == 0; });
  };
  CHECK(solid_layers(skin(1, 1, 0, 0)) == 2);
  CHECK(solid_layers(skin(1, 1, 700, 500)) == 4 + 3);
  CHECK(solid_layers(skin(1, 1, 800, 0)) == 4 + 1);
  CHECK(solid_layers(skin(0, 0, 0, 0)) == 0);
}

TEST_CASE("shells: areas of a layer do not overlap and together are the inside", "[infill][law]") {
  std::vector<Regions> outlines;
  for (std::uint32_t seed = 1; seed <= 30; ++seed)
    outlines.push_back({star(seed / 3, 25000 - static_cast<Um>(seed) * 300, 19)});
  const Object object(std::move(outlines));
  const auto areas = object.areas({});
  for (std::size_t i = 0; i < areas.size(); ++i) {
    CAPTURE(i);
    CHECK(all(areas[i]) == Approx(area_mm2(object.insides[i])).epsilon(0.001).margin(0.01));
  }
}

TEST_CASE("shells: a sloped roof leaves no open spot", "[infill][law]") {
  const Um slope = GENERATE(40, 150, 400, 900, 2500);  // how far the outline recedes a layer
  std::vector<Regions> outlines;
  for (int i = 0; i < 30 && 30000 - 2 * i * slope > 3000; ++i)
    outlines.push_back({rectangle(i * slope, i * slope / 2, 30000 - i * slope, 30000 - i * slope / 2)});
  const Object roof(std::move(outlines));
  const auto areas = roof.areas({});
  CAPTURE(slope);
  for (std::size_t i = 1; i < areas.size(); ++i)
    for (Um x = 37; x < 30000; x += 211)
      for (Um y = 41; y < 30000; y += 397) {
        const Point p{x, y};
        if (!holds(roof.insides[i], p)) continue;
        const bool open_above = i + 1 == areas.size() || !holds(roof.outlines[i + 1], p);
        if (open_above && !solid_at(areas[i], p)) FAIL_CHECK("open at layer " << i << ", " << x << ", " << y);
      }
}

TEST_CASE("shells: solid reaches under the walls of what stands on it", "[infill]") {
  std::vector<Regions> outlines(10, {rectangle(0, 0, 30000, 30000)});
  outlines.insert(outlines.end(), 10, {rectangle(10000, 10000, 20000, 20000)});
  const Object step(std::move(outlines));
  const auto areas = step.areas(skin(4, 4, 0, 0, 0));
  CHECK(solid_at(areas[9], {10500, 15000}));
  CHECK(!solid_at(areas[9], {15000, 15000}));
  CHECK(sum(areas[9], &PartAreas::sparse) == Approx(8.4 * 8.4).epsilon(0.06));
  CHECK(sum(areas[9], &PartAreas::top) > 600);
}

TEST_CASE("shells: walls as thick as the skin close a slope alone, and leave it to solid where it is gentler",
          "[infill]") {
  const auto beside_slope_mm2 = [](Um step, Um wall) {  // four layers of skin
    std::vector<Regions> outlines;
    for (int i = 0; i < 20; ++i) outlines.push_back({rectangle(i * step, 0, 40000 - i * step, 30000)});
    ShellSettings shells = skin(4, 4, 0, 0, 0);
    shells.skin_line_width = 450;
    const auto areas = Object(std::move(outlines), wall).areas(shells);
    return sum(areas[10], &PartAreas::solid) + sum(areas[10], &PartAreas::belted);
  };
  CHECK(beside_slope_mm2(100, 450) == 0);
  CHECK(beside_slope_mm2(200, 450) > 2 * 28 * 0.4);
  for (const Um wall : {900, 1350}) {
    CAPTURE(wall);
    for (const Um step : {100, 200, 230}) CHECK(beside_slope_mm2(step, wall) == 0);  // 200: 45°
    CHECK(beside_slope_mm2(500, wall) > 2 * 27 * 0.8);
  }
}

TEST_CASE("shells: walls that begin on a ledge stand on solid, which is wider the nearer it is", "[infill]") {
  constexpr Um wall = 1350;
  const bool upside_down = GENERATE(false, true);  // walls that end below one
  std::vector<Regions> outlines(10, {rectangle(0, 0, 30000, 30000)});
  outlines.insert(outlines.end(), 10, {rectangle(1100, 1100, 28900, 28900)});  // within the walls of what is below
  if (upside_down) std::reverse(outlines.begin(), outlines.end());
  ShellSettings shells = skin(4, 4, 0, 0, 0);
  shells.skin_line_width = 450;
  const auto areas = Object(std::move(outlines), wall).areas(shells);
  const auto solid_um = [&](std::size_t layer) {  // from the walls inwards
    Um um = 0;
    while (solid_at(areas[upside_down ? 19 - layer : layer], {wall + um + 10, 15000})) um += 10;
    return um;
  };
  CHECK(solid_um(9) == Approx(1100 - 200).margin(210));
  CHECK(solid_um(8) == Approx(1100 - 400).margin(210));
  CHECK(solid_um(7) == Approx(1100 - 600).margin(210));
  CHECK(solid_um(6) == Approx(1100 - 800).margin(210));
  CHECK(solid_um(5) == 0);
}

TEST_CASE("shells: a patch beside a top is part of it, also where sparse infill is at its other side", "[infill]") {
  const Um covered = GENERATE(12000, 8000, 2000);  // beside the top, by one layer
  constexpr Um size = 30000, wall = 450, top = 10000;
  std::vector<Regions> outlines(10, {rectangle(0, 0, size, size)});
  outlines.push_back({rectangle(0, 0, size - top, size)});
  outlines.insert(outlines.end(), 10, {rectangle(0, 0, size - top - covered, size)});
  ShellSettings shells = skin(4, 4, 0, 0);
  shells.skin_line_width = 450;
  const auto areas = Object(std::move(outlines), wall).areas(shells);
  const auto is_top = [&](Um x) {
    return std::any_of(areas[9].begin(), areas[9].end(), [x](const PartAreas& a) {
      return holds(a.top, {x, size / 2});
    });
  };
  CAPTURE(covered);
  REQUIRE(sum(areas[9], &PartAreas::sparse) > 200);
  CHECK(is_top(size - top / 2));
  CHECK(solid_at(areas[9], {size - top - covered / 2, size / 2}));
  CHECK(is_top(size - top - covered / 2) == (covered < top));
  CHECK(!solid_at(areas[9], {5000, size / 2}));
}

TEST_CASE("shells: walls that cross a bar between the belts of its slopes stand on solid", "[infill]") {
  constexpr Um wall = 1350;
  std::vector<Regions> outlines(10, {rectangle(0, 0, 5700, 40000)});
  for (Um in = 320; in <= 1280; in += 320)  // a notch begins, and the sides lean inwards
    outlines.push_back({rectangle(in, 0, 5700 - in, 19200), rectangle(in, 20800, 5700 - in, 40000)});
  outlines.insert(outlines.end(), 10, outlines.back());
  ShellSettings shells = skin(4, 4, 0, 0);
  shells.skin_line_width = 450;
  const auto areas = Object(std::move(outlines), wall).areas(shells);
  REQUIRE(areas[9].front().belts.size() > 1);
  for (const Um x : {wall + 200, 2850, 5700 - wall - 200})
    for (const Um y : {19200 - wall + 300, 20800 + wall - 300}) {
      CAPTURE(x, y);
      CHECK(solid_at(areas[9], {x, y}));
    }
  CHECK(!solid_at(areas[9], {2850, 10000}));
}

TEST_CASE(
    "shells: no air lies within the skin of sparse infill, and walls stand beside what carries them by less than "
    "a line",
    "[infill][law]") {
  constexpr int count = 30, skin_layers = 4;
  constexpr Um line = 450, half_band = 204, exact = 150;  // a cell of the grid, and what stands for a round wall
  const Um wall = GENERATE(1, 2, 3) * line;
  const int shape = GENERATE(range(0, 6));
  const bool upside_down = GENERATE(false, true);
  const auto radius = [&](int i) {
    const double up = i / static_cast<double>(count);
    switch (shape) {
      case 0:
        return 18'000. - 200 * i;  // 45°
      case 1:
        return 18'000. - 346 * i;  // 60°
      case 2:
        return 18'000. - 120 * i;  // 31°
      case 3:
        return 14'000. * std::sqrt(1 - up * up) + 10;  // a dome
      case 4:
        return 18'000. - (i < 15 ? 0 : 500) - (i < 20 ? 0 : 900);  // ledges
      default:
        return i < 15 ? 18'000. : 9'000.;  // a tower on a plate
    }
  };
  std::vector<Regions> outlines;
  Region base;  // of three lobes
  for (int k = 0; k < 180; ++k) {
    const double a = degrees(2 * k), r = 18'000 + 2'000 * std::cos(3 * a);
    base.outer.push_back({rounded(r * std::cos(a)), rounded(r * std::sin(a))});
  }
  for (int i = 0; i < count; ++i) outlines.push_back(geometry::offset({base}, {.by = rounded(radius(i) - 18'000)}));
  if (upside_down) std::reverse(outlines.begin(), outlines.end());
  const Object object(std::move(outlines), wall);
  ShellSettings shells = skin(skin_layers, skin_layers, 0, 0, 0);
  shells.skin_line_width = line;
  const auto areas = object.areas(shells);
  double sparse_mm2 = 0;
  const auto mm2 = [](const Regions& regions) {
    double sum = 0;
    for (const Region& region : regions) sum += area_mm2(region);
    return sum;
  };
  for (int i = 0; i < count; ++i) {
    CAPTURE(wall, shape, upside_down, i);
    Regions sparse;
    for (const PartAreas& part : areas[static_cast<std::size_t>(i)])
      sparse.insert(sparse.end(), part.sparse.begin(), part.sparse.end());
    if (sparse.empty()) continue;
    sparse_mm2 += mm2(sparse);
    const Regions surely = geometry::offset(sparse, {.by = -half_band - exact});
    for (int j = std::max(0, i - skin_layers); j <= std::min(count - 1, i + skin_layers); ++j)
      CHECK(mm2(geometry::subtract(surely, object.outlines[static_cast<std::size_t>(j)])) < 0.05);
    if (i + 1 == count) continue;
    const auto above = static_cast<std::size_t>(i + 1);
    const Regions walls = geometry::subtract(object.outlines[above], object.insides[above]);
    CHECK(mm2(geometry::intersect(geometry::offset(sparse, {.by = -2 * half_band - exact}), walls)) < 0.05);
  }
  CHECK(sparse_mm2 > 1000);
}

TEST_CASE("shells: a gap between two supports is bridged along its shorter span", "[infill]") {
  const bool turned = GENERATE(false, true);
  std::vector<Regions> outlines;
  const auto box = [&](Um x0, Um y0, Um x1, Um y1) {
    return turned ? rectangle(y0, x0, y1, x1) : rectangle(x0, y0, x1, y1);
  };
  for (int i = 0; i < 10; ++i) outlines.push_back({box(0, 0, 8000, 30000), box(20000, 0, 28000, 30000)});
  for (int i = 0; i < 10; ++i) outlines.push_back({box(0, 0, 28000, 30000)});
  const auto areas = Object(std::move(outlines)).areas({});
  REQUIRE(areas[10].size() == 1);
  REQUIRE(areas[10][0].bridges.size() == 1);
  const double angle = areas[10][0].bridges[0].angle_rad * 180 / std::numbers::pi;
  CHECK(angle == Approx(turned ? 90 : 0).margin(6));
  CHECK(bridged(areas[10]) > 12 * 28);  // the gap, and anchors on both sides
  CHECK(bridged(areas[10]) < 16.4 * 28.2);
  CHECK(bridged(areas[11]) == 0);
}

TEST_CASE("shells: gaps whose anchors meet are one bridge, unless its strands would hang far for that", "[infill]") {
  const auto ceiling = [](Um length, Um width, Um apart) {  // over a pit along x, and one along y beside it
    Region below = with_hole(rectangle(0, 0, 60000, 50000), 5000, 5000, 5000 + length, 5000 + width);
    const Um y = 5000 + width + apart;
    below.holes.push_back(with_hole(rectangle(0, 0, 60000, 50000), 5000, y, 5000 + width, y + length).holes.front());
    std::vector<Regions> outlines(6, {below});
    outlines.insert(outlines.end(), 6, {rectangle(0, 0, 60000, 50000)});
    return Object(std::move(outlines)).areas({})[6][0].bridges;
  };
  const auto one = ceiling(4500, 2000, 2000);
  REQUIRE(one.size() == 1);
  CHECK(one[0].regions.size() == 1);
  CHECK(ceiling(20000, 12000, 2000).size() == 2);  // strands of both would hang 17 mm
  CHECK(ceiling(20000, 2000, 6000).size() == 2);   // no strand is of both
}

TEST_CASE("shells: a ceiling over a pit is bridged, a ledge is not", "[infill]") {
  std::vector<Regions> pit(6, {with_hole(rectangle(0, 0, 30000, 20000), 5000, 5000, 25000, 15000)});
  pit.insert(pit.end(), 6, {rectangle(0, 0, 30000, 20000)});
  const auto ceiling = Object(std::move(pit)).areas({});
  REQUIRE(ceiling[6][0].bridges.size() == 1);
  CHECK(ceiling[6][0].bridges[0].angle_rad == Approx(std::numbers::pi / 2).margin(0.1));

  std::vector<Regions> ledge(6, {rectangle(0, 0, 10000, 20000)});
  ledge.insert(ledge.end(), 6, {rectangle(0, 0, 20000, 20000)});
  const auto hanging = Object(std::move(ledge)).areas({});
  CHECK(bridged(hanging[6]) == 0);
  CHECK(solid_at(hanging[6], {15000, 10000}));
}

TEST_CASE("shells: lines of a ledge begin where it is held, also in a corner that hangs", "[infill]") {
  const auto beside = [](const Regions& below, const Regions& above) {
    std::vector<Regions> outlines(6, below);
    outlines.insert(outlines.end(), 6, above);
    return Object(std::move(outlines)).areas({});
  };
  const Regions wide{rectangle(0, 0, 20000, 30000)};
  const auto shelf = beside({rectangle(0, 0, 10000, 30000)}, wide);
  REQUIRE(shelf[6][0].bridges.size() == 1);
  CHECK(shelf[6][0].bridges[0].ledge);
  CHECK(std::abs(std::sin(shelf[6][0].bridges[0].angle_rad)) < std::sin(degrees(6)));
  CHECK(ledges(shelf[6]) > 9 * 28);  // what hangs, and where its lines begin
  CHECK(ledges(shelf[6]) < 11.2 * 28.2);
  CHECK(all(shelf[6]) == Approx(18 * 28));
  CHECK(shelf[7][0].bridges.empty());

  CHECK(beside({rectangle(0, 0, 19000, 30000)}, wide)[6][0].bridges.empty());      // too narrow for lines of its own
  CHECK(beside({rectangle(40000, 0, 50000, 30000)}, wide)[6][0].bridges.empty());  // held nowhere
}

TEST_CASE("shells: solid over sparse infill is a bridge across the lines of the infill, from edge to edge",
          "[infill]") {
  const Object block(std::vector<Regions>(20, {rectangle(0, 0, 30000, 30000)}));
  InfillSettings infill;
  infill.infill_pattern = InfillPattern::lines;
  infill.infill_sparse_density = 10;
  infill.infill_angle = GENERATE(0.0, 30.0, 45.0);
  CAPTURE(infill.infill_angle);
  const auto areas = block.areas(skin(4, 4, 0, 0), infill);
  const double inside = 28 * 28;
  REQUIRE(sum(areas[15], &PartAreas::sparse) == Approx(inside));  // lines turned by 90°: the layer's number is odd
  REQUIRE(areas[16][0].bridges.size() == 1);
  CHECK(bridged(areas[16]) == Approx(inside));
  const double across = degrees(infill.infill_angle);
  CHECK(std::abs(std::sin(areas[16][0].bridges[0].angle_rad - across)) < std::sin(degrees(6)));
  for (const std::size_t other : {3U, 17U, 18U, 19U}) CHECK(bridged(areas[other]) == 0);
}

TEST_CASE("shells: a patch of solid between two lines of the infill goes on to them", "[infill]") {
  // below a pit of 1.5 mm; lines along one axis are 4 mm apart
  const Um at = GENERATE(12000, 13000, 14000, 15000);
  CAPTURE(at);
  std::vector<Regions> outlines(20, {rectangle(0, 0, 30000, 30000)});
  const Regions pit{rectangle(at, at, at + 1500, at + 1500)};
  for (std::size_t i = 16; i < outlines.size(); ++i) outlines[i] = geometry::subtract(outlines[i], pit);
  const Object block(outlines);
  InfillSettings infill;
  infill.infill_pattern = InfillPattern::lines;
  infill.infill_sparse_density = 10, infill.infill_angle = 0;
  const auto areas = block.areas(skin(4, 4, 0, 0, 0), infill);
  REQUIRE(areas[12][0].bridges.size() == 1);
  const infill::BridgeArea& bridge = areas[12][0].bridges[0];
  double left = 1e9, right = -1e9, low = 1e9, high = -1e9;
  for (const Ring& ring : geometry::rings_of(bridge.regions))
    for (const Point p : ring) {
      const double along = p.x * std::cos(bridge.angle_rad) + p.y * std::sin(bridge.angle_rad);
      const double across = p.y * std::cos(bridge.angle_rad) - p.x * std::sin(bridge.angle_rad);
      left = std::min(left, along), right = std::max(right, along);
      low = std::min(low, across), high = std::max(high, across);
    }
  const double length = right - left, width = high - low;
  CHECK(length >= 4000);  // from one line to the next at least
  CHECK(length <= 9000);  // and no further than to one on either side
  CHECK(width <= 4500);   // the patch: the pit and its walls
}

TEST_CASE("shells: strands over infill do not end where it goes on", "[infill]") {
  // lines along y below, 4.5 mm apart; solid along x that is held at its long sides, or has infill beside them
  const auto angle = [](bool open_sides) {
    Object block(std::vector<Regions>(20, {rectangle(0, 0, 60000, open_sides ? 30000 : 6000)}));
    InfillSettings infill;
    infill.infill_pattern = InfillPattern::lines;
    infill.infill_sparse_density = 10, infill.infill_angle = 0;
    const Regions open{rectangle(1000, 1000, 59000, 13000), rectangle(1000, 17000, 59000, 29000)};
    if (open_sides) block.layers[16].open = &open;
    auto shell = skin(4, 4, 0, 0);
    if (open_sides) shell.top_layers = 0;
    const auto areas = block.areas(shell, infill);
    REQUIRE(areas[16][0].bridges.size() == 1);
    return areas[16][0].bridges[0].angle_rad;
  };
  CHECK(std::abs(std::sin(angle(true))) < std::sin(degrees(6)));  // along x, over the lines, however near its sides are
  CHECK(std::abs(std::sin(angle(false))) > std::sin(degrees(40)));
}

TEST_CASE("shells: a strip of solid that the anchors of a bridge over infill would leave is of the bridge",
          "[infill]") {
  InfillSettings infill;
  infill.infill_sparse_density = 10;
  const auto solid_beside_bridge = [&](Um beyond_anchors) {
    Object block(std::vector<Regions>(20, {rectangle(0, 0, 30000, 30000)}));
    const Um from = 1000 + 2000 + beyond_anchors;  // the wall, the anchor
    const Regions open{rectangle(from, from, 30000 - from, 30000 - from)};
    block.layers[15].open = &open;
    const auto areas = block.areas(skin(4, 4, 0, 0), infill);
    CHECK(bridged(areas[16]) > 400);
    return sum(areas[16], &PartAreas::solid);
  };
  CHECK(solid_beside_bridge(300) == 0);
  CHECK(solid_beside_bridge(500) == 0);
  CHECK(solid_beside_bridge(1200) > 4 * 20);  // it has lines of its own
}

TEST_CASE("shells: dense infill carries ordinary lines, and bridges are laid only where they are asked for",
          "[infill]") {
  const Object block(std::vector<Regions>(20, {rectangle(0, 0, 30000, 30000)}));
  InfillSettings infill;
  infill.infill_sparse_density = 80, infill.infill_line_width = 450;
  for (const LayerAreas& layer : block.areas({}, infill)) CHECK(bridged(layer) == 0);
  infill.infill_sparse_density = 10;
  ShellSettings none;
  none.bridges = false;
  for (const LayerAreas& layer : block.areas(none, infill)) CHECK(bridged(layer) == 0);
}

TEST_CASE("shells: a belt of solid over sparse infill is a bridge along it, where a line finds room", "[infill]") {
  const auto bridges = [](Um step) {  // under a roof that falls by that much a layer, towards x
    std::vector<Regions> outlines;
    for (int i = 0; i < 12; ++i) outlines.push_back({rectangle(0, 0, 40000 - i * step, 20000)});
    InfillSettings infill;
    infill.infill_sparse_density = 20;
    std::vector<infill::BridgeArea> out;
    const auto areas = Object(std::move(outlines)).areas(skin(2, 0, 0, 0), infill);
    for (std::size_t i = 0; i + 2 < areas.size(); ++i)
      for (const PartAreas& part : areas[i]) out.insert(out.end(), part.bridges.begin(), part.bridges.end());
    return out;
  };
  CHECK(bridges(300).empty());
  for (const Um step : {800, 2000}) {
    CAPTURE(step);
    const auto found = bridges(step);
    CHECK(found.size() >= 8);
    for (const infill::BridgeArea& bridge : found) {
      CHECK(std::abs(std::cos(bridge.angle_rad)) < std::sin(degrees(1)));
      CHECK(area_mm2(bridge.regions) > 18 * to_mm(step));
      CHECK(area_mm2(bridge.regions) < 18 * to_mm(step + 1200));  // what is beside it is no anchor
    }
  }
}

TEST_CASE("shells: a bridge over sparse infill runs along its area also where that lies aslant on the grid",
          "[infill]") {
  const double turned = degrees(GENERATE(17, 27, 63, 110));
  CAPTURE(turned);
  const auto turn = [&](Regions regions) {
    for (Region& region : regions)
      for (Point& p : region.outer)
        p = {rounded(p.x * std::cos(turned) - p.y * std::sin(turned)),
             rounded(p.x * std::sin(turned) + p.y * std::cos(turned))};
    return regions;
  };
  std::vector<Regions> outlines;
  for (int i = 0; i < 12; ++i) outlines.push_back(turn({rectangle(0, 0, 40000 - i * 1100, 20000)}));
  InfillSettings infill;
  infill.infill_sparse_density = 20, infill.infill_angle = 45 + turned * 180 / std::numbers::pi;
  std::vector<infill::BridgeArea> found;
  const auto areas = Object(std::move(outlines)).areas(skin(2, 0, 0, 0), infill);
  for (std::size_t i = 0; i + 2 < areas.size(); ++i)  // what is below the top
    for (const PartAreas& part : areas[i]) found.insert(found.end(), part.bridges.begin(), part.bridges.end());
  CHECK(found.size() >= 8);
  for (const infill::BridgeArea& bridge : found)
    CHECK(std::abs(std::cos(bridge.angle_rad - turned)) < std::sin(degrees(1)));
}

TEST_CASE("shells: a narrow belt of solid whose lines along would end over nothing is no bridge", "[infill]") {
  // a ring, on sparse infill between two walls: across it lines are short, along it they would leave it
  constexpr int corners = 60;
  const auto round = [](double radius_um) {
    Ring ring;
    for (int i = 0; i < corners; ++i)
      ring.push_back({20000 + rounded(radius_um * std::cos(2 * std::numbers::pi * i / corners)),
                      20000 + rounded(radius_um * std::sin(2 * std::numbers::pi * i / corners))});
    return ring;
  };
  const auto tube = [&](double outer, double inner) {
    Ring hole = round(inner);
    std::reverse(hole.begin(), hole.end());
    return Regions{{round(outer), {hole}}};
  };
  InfillSettings infill;
  infill.infill_sparse_density = 10;
  const Object object(std::vector<Regions>(20, tube(15000, 11900)));  // 1.1 mm between the walls
  for (const LayerAreas& layer : object.areas(skin(4, 4, 0, 0, 0), infill)) CHECK(bridged(layer) == 0);
}

TEST_CASE("shells: small patches of sparse infill become solid", "[infill]") {
  const Object tower(std::vector<Regions>(20, {rectangle(0, 0, 8000, 8000)}));
  CHECK(sum(tower.areas(skin(4, 4, 0, 0, 40))[10], &PartAreas::sparse) == 0);
  CHECK(sum(tower.areas(skin(4, 4, 0, 0, 30))[10], &PartAreas::sparse) == Approx(36));
}

TEST_CASE("shells: a small patch that solid cuts off of sparse infill where that goes on below is of its bridge",
          "[infill]") {
  std::vector<Regions> outlines(10, {rectangle(0, 0, 40000, 8000)});
  for (int i = 0; i < 10; ++i) outlines.push_back({rectangle(0, 0, 4500, 8000), rectangle(12000, 0, 40000, 8000)});
  const Object object(std::move(outlines));
  const Point patch{2200, 4000}, slot{8000, 4000};  // 15 mm² beside the floor of a slot
  ShellSettings shells = skin(2, 2, 0, 0);
  const auto areas = object.areas(shells);
  CHECK_FALSE(solid_at(areas[7], slot));
  CHECK(bridged_at(areas[8], slot));
  CHECK(bridged_at(areas[8], patch));  // or strands would end beside it, and the next layer's lines hang over it
  CHECK(solid_at(areas[9], patch));
  CHECK(solid_at(areas[13], patch));  // what is that small by its walls
  // Ordinary lines over it would hang from line to line of the infill below.
  shells.bridges = false;
  const auto plain = object.areas(shells);
  CHECK(solid_at(plain[8], slot));
  CHECK_FALSE(solid_at(plain[8], patch));
}

TEST_CASE("shells: a patch that a bridge leaves of sparse infill has no ordinary lines over any that goes on below",
          "[infill]") {
  std::vector<Regions> outlines(10, {rectangle(0, 0, 6000, 8000), rectangle(16000, 0, 22000, 8000)});
  outlines.insert(outlines.end(), 10, {rectangle(0, 0, 22000, 8000)});
  Object object(std::move(outlines));
  const Regions open{rectangle(1000, 1000, 4400, 7000)};  // 20.4 mm²
  object.layers[9].open = &open;
  const auto areas = object.areas(skin(0, 1, 0, 0));
  const Point patch{2000, 4000};  // 18 mm² beside the anchor
  REQUIRE(bridged(areas[10]) > 14 * 6);
  REQUIRE_FALSE(solid_at(areas[9], patch));
  CHECK_FALSE(solid_at(areas[10], patch));
}

TEST_CASE("shells: full density is solid everywhere", "[infill]") {
  const Object block(std::vector<Regions>(20, {rectangle(0, 0, 20000, 20000)}));
  InfillSettings full;
  full.infill_sparse_density = 100;
  for (const LayerAreas& layer : block.areas({}, full)) CHECK(sum(layer, &PartAreas::sparse) == 0);
}

TEST_CASE("shells: a layer's areas do not depend on the run they are found in", "[infill][law]") {
  std::vector<Regions> outlines;
  for (std::uint32_t i = 0; i < 25; ++i) outlines.push_back({star(3 + i / 4, 20000 - static_cast<Um>(i) * 250, 15)});
  const Object object(std::move(outlines));
  const auto together = object.areas({});
  for (std::size_t i = 0; i < object.layers.size(); ++i) {
    const auto alone = infill::find_areas({}, {}, {object.layers, infill::box_of(object.layers), 400}, i, 1);
    REQUIRE(alone.size() == 1);
    REQUIRE(alone[0].size() == together[i].size());
    for (std::size_t k = 0; k < alone[0].size(); ++k) {
      CHECK(alone[0][k].solid == together[i][k].solid);
      CHECK(alone[0][k].top == together[i][k].top);
      CHECK(alone[0][k].sparse == together[i][k].sparse);
    }
  }
}

TEST_CASE("shells: each area knows the part that it lies in", "[infill]") {
  const Regions two{rectangle(0, 0, 20000, 20000), rectangle(30000, 0, 50000, 20000)};
  const auto areas = Object(std::vector<Regions>(12, two)).areas({});
  REQUIRE(areas[6].size() == 2);
  for (const PartAreas& part : areas[6]) {
    REQUIRE(part.sparse.size() == 1);
    CHECK(holds({two[part.part]}, part.sparse[0].outer[0]));
  }
}

TEST_CASE("shells: empty layers, specks and ten thousand regions are borne", "[infill]") {
  CHECK(infill::find_areas({}, {}, {}, 0, 0).empty());
  const Object gaps({{rectangle(0, 0, 9000, 9000)}, {}, {rectangle(0, 0, 9000, 9000)}, {rectangle(0, 0, 30, 30)}});
  CHECK(gaps.areas({}).size() == 4);
  Regions many;
  for (int x = 0; x < 100; ++x)
    for (int y = 0; y < 100; ++y) many.push_back(rectangle(x * 3000, y * 3000, x * 3000 + 2600, y * 3000 + 2600));
  const Object crowd(std::vector<Regions>(3, many), 400);
  const auto areas =
      infill::find_areas(skin(1, 1, 0, 0, 0), {}, {crowd.layers, infill::box_of(crowd.layers), 400}, 1, 1);
  CHECK(areas[0].size() == 10000);
  CHECK(sum(areas[0], &PartAreas::sparse) == Approx(32400));
}
