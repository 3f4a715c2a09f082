// SPDX-License-Identifier: GPL-3.0-or-later
#include "body.h"
#include "support/plastic.h"
#include "support/steady.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::test;

namespace {

/// Plastic, about: columns are filled to 15 %, interfaces wholly, what they lie on to a third, branches are one loop of
/// 0.4 mm.
double plastic(const support::Plan& plan) {
  double mm3 = 0;
  for (const auto& layer : plan.layers) {
    double loops = 0;
    for (const auto& branch : layer.branches) loops += perimeter_of(branch.outer) / 1000;
    mm3 += (0.15 * area_mm2(layer.columns) + area_mm2(layer.roof) + area_mm2(layer.under_roof) / 3 +
            area_mm2(layer.bottom) + 0.4 * loops) *
           to_mm(layer.height);
  }
  return mm3;
}

/// What of support is nearer to the part than that, mm², all layers together.
double too_near(const support::Plan& plan, const Body& body, Um distance) {
  double mm2 = 0;
  for (const auto& level : plan.layers)
    for (const auto& layer : body.layers)
      if (layer.z > level.z - level.height && layer.z - layer.height < level.z)
        mm2 += area_mm2(geometry::intersect(all_of(level), grown(layer.regions, distance)));
  return mm2;
}

/// What of support has nothing below: neither bed, nor support, nor the part within a millimetre. Strands of a roof
/// cross from branch to branch, and on joists what is left in the middle of several: no wider than what is joined.
double floating(const support::Plan& plan, const Body& body, Um aside) {
  constexpr Um crosses = 2900, joined = 2000;
  double mm2 = 0;
  for (std::size_t k = 1; k < plan.layers.size(); ++k) {
    const auto& level = plan.layers[k];
    const Um bottom = level.z - level.height;
    if (bottom <= 0) continue;
    Regions base;
    const auto add = [&](const Regions& more) { base.insert(base.end(), more.begin(), more.end()); };
    for (std::size_t j = 0; j < k; ++j)  // several end at one height where some of them stand on the part
      if (plan.layers[j].z >= bottom && plan.layers[j].z < level.z) add(all_of(plan.layers[j]));
    for (const auto& layer : body.layers)
      if (layer.z <= bottom && layer.z > bottom - 1000) add(layer.regions);
    base = geometry::unite(base);
    const Regions hangs = geometry::subtract(all_of(level), grown(base, aside));
    Regions strands = level.roof;
    strands.insert(strands.end(), level.joists.area.begin(), level.joists.area.end());
    const Regions held = geometry::closing(grown(base, crosses), joined / 2);
    mm2 += area_mm2(geometry::subtract(hangs, geometry::intersect(strands, held)));
  }
  return mm2;
}

/// Of columns: the greatest height of what stands on an area by its width there, where it bends most easily. What
/// stands on several stands on the widest, and the others carry but themselves.
double slenderest(const support::Plan& plan) {
  struct Standing {
    Region region;
    Box box;
    double width_um = 0;
    Um top = 0;
  };
  double most = 0;
  std::vector<Standing> above;
  for (std::size_t k = plan.layers.size(); k-- > 0;) {
    const auto& level = plan.layers[k];
    std::vector<Standing> here;
    for (const Region& region : all_of(level))
      here.push_back({region, box_of(region.outer), support::stiff_width_um(region), level.z});
    for (const Standing& upper : above) {
      Standing* widest = nullptr;
      for (Standing& lower : here)
        if (lower.box.overlaps(upper.box) && (widest == nullptr || lower.width_um > widest->width_um) &&
            !geometry::intersect({lower.region}, {upper.region}).empty())
          widest = &lower;
      if (widest != nullptr) widest->top = std::max(widest->top, upper.top);
    }
    for (const Standing& one : here) most = std::max(most, (one.top - level.z) / one.width_um);
    above = std::move(here);
  }
  return most;
}
constexpr double steady = 11.5;  // ten, and what is missing where steps are coarse

const auto every_structure = {SupportStructure::normal, SupportStructure::tree, SupportStructure::hybrid};

}  // namespace

TEST_CASE("support: what reaches out further than the angle allows is wanted, and a gentler slope is not") {
  for (const Um step : {150, 250}) {  // 0.2 mm layers at 50 degrees: 0.238 mm
    Body body;
    for (int i = 0; i < 20; ++i) body.add(1, {rectangle(-10000 - i * step, -10000, 10000 + i * step, 10000)});
    const auto s = on();
    const auto object = body.object();
    const auto demand = support::demand(s, object);
    double mm2 = 0;
    for (const auto& layer : demand) mm2 += area_mm2(layer.wanted);
    INFO(step);
    if (step == 150)
      CHECK(mm2 == 0);
    else
      CHECK(mm2 == Approx(19 * 2 * 0.25 * 20).epsilon(0.02));  // the whole step, not what is beyond the angle
  }
}

TEST_CASE("support: the rim of a slope is held, where each layer asks for a strip thinner than a bead") {
  Body body;
  body.add(30, {rectangle(-5000, -5000, 5000, 5000)});
  for (int i = 1; i <= 15; ++i) body.add(1, {rectangle(-5000 - i * 260, -5000, 5000 + i * 260, 5000)});
  for (const auto structure : every_structure) {
    const auto plan = planned(on(structure), body);
    INFO(static_cast<int>(structure));
    CHECK(plan.figures.needed_mm2 == Approx(15 * 2 * 0.26 * 10).epsilon(0.02));
    CHECK(plan.figures.left_mm2 < 0.02 * plan.figures.needed_mm2);
  }
}

TEST_CASE("support: a bridge between two rests is left out, one longer than allowed is not") {
  for (const Um span : {10'000, 30'000}) {
    Body body;
    body.add(20, {rectangle(0, 0, 5000, 10000), rectangle(5000 + span, 0, 10000 + span, 10000)});
    body.add(5, {rectangle(0, 0, 10000 + span, 10000)});
    const auto plan = planned(on(), body);
    INFO(span);
    CHECK(plan.layers.empty() == (span == 10'000));
    CHECK((plan.figures.bridged_mm2 > 0) == (span == 10'000));
    auto always = on();
    always.support_bridges = true;
    CHECK_FALSE(planned(always, body).layers.empty());
  }
}

TEST_CASE("support: the gap above is the one that is set, to the micron") {
  for (const auto structure : every_structure)
    for (const Um gap : {0, 100, 137, 200, 250, 300}) {
      auto body = tee();
      auto s = on(structure);
      s.support_top_distance = gap;
      const auto plan = planned(s, body);
      INFO(gap);
      REQUIRE_FALSE(plan.layers.empty());
      CHECK(plan.layers.back().z == 50 * 200 - gap);
      CHECK_FALSE(all_of(plan.layers.back()).empty());
      Um below = 0;
      for (const auto& layer : plan.layers) {
        CHECK(layer.z - layer.height == below);
        CHECK((layer.height >= 100 && layer.height <= 300));  // a quarter to three quarters of the nozzle
        below = layer.z;
      }
    }
}

TEST_CASE("support: synchronised layers end where the part's do, and the gap is no smaller") {
  auto body = tee();
  auto s = on();
  s.support_synchronize_layers = true, s.support_top_distance = 137;
  const auto plan = planned(s, body);
  REQUIRE_FALSE(plan.layers.empty());
  CHECK(plan.layers.back().z == 49 * 200);
  for (const auto& layer : plan.layers) CHECK(layer.z % 200 == 0);
}

TEST_CASE("support: beside the part there is the distance that is set, and every area rests") {
  for (const auto structure : every_structure) {
    auto body = tee();
    const auto plan = planned(on(structure), body);
    INFO(static_cast<int>(structure));
    REQUIRE_FALSE(plan.layers.empty());
    CHECK(too_near(plan, body, 195) == 0);
    CHECK(floating(plan, body, 300) < 0.01);
    CHECK(plan.figures.left_mm2 < 0.01 * plan.figures.needed_mm2);
  }
}

TEST_CASE("support: beside a wall a column leans towards what it holds below the roof, and the roof lies on it") {
  auto body = tee();
  const auto plan = planned(on(SupportStructure::normal), body);
  const auto first =
      std::find_if(plan.layers.begin(), plan.layers.end(), [](const auto& l) { return !l.roof.empty(); });
  REQUIRE(first - plan.layers.begin() > 3);
  const auto beside = [&](const support::SupportLayer& layer) {  // how near it comes to the post, µm
    Um nearest = 1'000'000;
    for (const Region& region : all_of(layer))
      for (const Ring& ring : geometry::rings_of({region}))
        for (const Point p : ring)
          if (std::abs(p.x) < 4000 && std::abs(p.y) < 4000)
            nearest = std::min(nearest, std::max(std::abs(p.x), std::abs(p.y)) - 2000);
    return nearest;
  };
  CHECK(beside(*(first - 1)) - beside(*first) <= 260);
  CHECK(beside(*(first - 1)) < 600);  // where nothing is held it is 700
  CHECK(beside(*(first - 3)) > 690);
  CHECK(beside(plan.layers.back()) < 300);
}

TEST_CASE("support: branches take less than columns under a high table") {
  auto body = tee(150);
  const double columns = plastic(planned(on(SupportStructure::normal), body));
  CHECK(plastic(planned(on(SupportStructure::tree), body)) < 0.8 * columns);
  CHECK(plastic(planned(on(SupportStructure::hybrid), body)) <= columns);
}

TEST_CASE("support: a column stands on a slope of the part that is steep, also where it does not end in the open") {
  for (const double slope : {50.0, 55.0, 60.0, 65.0, 70.0, 75.0}) {
    Body body;  // a wall that leans back below a shelf that reaches no further than its foot
    const double foot = 15000, back = 11000;
    const int steps = static_cast<int>((foot - back) * std::tan(slope * 3.14159265 / 180) / 200);
    for (int i = 0; i < steps; ++i)
      body.add(1, {rectangle(-5000, -6000, static_cast<Um>(foot - i * (foot - back) / steps), 6000)});
    body.add(20, {rectangle(-5000, -6000, static_cast<Um>(back), 6000)});
    body.add(5, {rectangle(-5000, -6000, static_cast<Um>(foot), 6000)});
    for (const auto structure : every_structure) {
      const auto plan = planned(on(structure), body);
      INFO(slope << " degrees, structure " << static_cast<int>(structure));
      CHECK(plan.figures.left_mm2 < 0.05 * plan.figures.needed_mm2);
      CHECK(too_near(plan, body, 195) == 0);
      CHECK(floating(plan, body, 300) < 0.05);
    }
  }
}

TEST_CASE("support: thin strips high up stand on branches where these take less") {
  Body body;  // the inside of a dome
  const Region around = rectangle(-29000, -29000, 29000, 29000);
  for (int i = 0; i < 200; ++i) {
    const double radius = 27000 * std::sqrt(1 - std::pow(i / 202.0, 2));
    Ring hole;
    for (int k = 0; k < 48; ++k)
      hole.push_back({static_cast<Um>(radius * std::cos(k * 3.14159265 / 24)),
                      static_cast<Um>(radius * std::sin(k * 3.14159265 / 24))});
    body.add(1, geometry::subtract({around}, {{hole, {}}}));
  }
  body.add(10, {around});
  const auto taken = [&](SupportStructure structure) {
    auto s = on(structure);
    s.gradual_support_infill_steps = 0;  // with fewer lines below columns take hardly more here
    return support::plastic_mm3(s, 400, planned(s, body));
  };
  INFO(taken(SupportStructure::tree));
  CHECK(taken(SupportStructure::hybrid) < 0.8 * taken(SupportStructure::normal));
}

TEST_CASE("support: of the plate alone nothing stands on the part, and what it cannot reach is told") {
  Body body;  // a table over a wider foot
  body.add(10, {rectangle(-30000, -20000, 30000, 20000)});
  body.add(40, {rectangle(-2000, -2000, 2000, 2000)});
  body.add(10, {rectangle(-20000, -10000, 20000, 10000)});
  for (const auto structure : every_structure) {
    auto s = on(structure);
    s.support_type = SupportType::buildplate;
    const auto from_plate = planned(s, body);
    INFO(static_cast<int>(structure));
    CHECK(from_plate.figures.left_mm2 > 0);
    for (const auto& layer : from_plate.layers)
      CHECK(geometry::intersect(all_of(layer), {rectangle(-30000, -20000, 30000, 20000)}).empty());
    s.support_type = SupportType::everywhere;
    const auto everywhere = planned(s, body);
    CHECK(everywhere.figures.left_mm2 < 1);
    CHECK(floating(everywhere, body, 300) < 0.01);
  }
}

TEST_CASE("support: what stands on the part begins the gap above it that is set, to the micron") {
  for (const auto structure : every_structure)
    for (const Um gap : {0, 100, 137, 200, 251, 333}) {
      Body body;
      body.add(10, {rectangle(-30000, -20000, 30000, 20000)});
      body.add(40, {rectangle(-2000, -2000, 2000, 2000)});
      body.add(5, {rectangle(-20000, -10000, 20000, 10000)});
      auto s = on(structure);
      s.support_bottom_distance = gap;
      const auto plan = planned(s, body);
      INFO(static_cast<int>(structure) << ", gap " << gap);
      REQUIRE_FALSE(plan.layers.empty());
      Um lowest = 1'000'000;
      for (const auto& layer : plan.layers) {
        if (all_of(layer).empty()) continue;
        lowest = std::min(lowest, layer.z - layer.height);
        CHECK((layer.height >= 100 && layer.height <= 300));
      }
      CHECK(lowest == 2000 + gap);
      CHECK(plan.figures.on_part_mm2 > 0);
    }
}

TEST_CASE("support: a column as thin as a bead begins the gap above the part, too") {
  const Region left = rectangle(-10000, -15000, -1000, 15000), right = rectangle(1000, -15000, 10000, 15000);
  for (const int walls : {40, 41, 42}) {  // levels end below their top
    Body body;
    body.add(10, {rectangle(-10000, -15000, 10000, 15000)});
    body.add(walls, {left, right});
    body.add(5, {rectangle(-10000, -15000, 10000, 15000)});
    auto s = on();
    s.support_bridges = true;
    const auto plan = planned(s, body);
    REQUIRE_FALSE(plan.layers.empty());
    Um lowest = 1'000'000;
    for (const auto& layer : plan.layers)
      if (!all_of(layer).empty()) lowest = std::min(lowest, layer.z - layer.height);
    CHECK(lowest == 2200);
  }
}

TEST_CASE("support: columns on the part stand on feet as high as a bead may sag, not so floors or what is slender") {
  const auto feet_under = [](const SupportSettings& s, Um half_wide, int high) {
    Body body;
    body.add(10, {rectangle(-30000, -20000, 30000, 20000)});
    body.add(high, {rectangle(-30000, -20000, -26000, 20000)});
    body.add(5, {rectangle(-30000, -20000, -26000, 20000), rectangle(-26000, -half_wide, 20000, half_wide)});
    const auto plan = planned(s, body);
    Um top = 0;
    double mm2 = 0;
    for (const auto& layer : plan.layers)
      if (!layer.feet.empty()) top = std::max(top, layer.z - 2000), mm2 = std::max(mm2, area_mm2(layer.feet));
    return std::pair(top, mm2);
  };
  const auto [top, mm2] = feet_under(on(), 8000, 40);
  CHECK(mm2 > 500);
  CHECK((top >= 200 + 266 && top <= 200 + 600));
  auto s = on();
  s.support_bottom_enable = true;
  CHECK(feet_under(s, 8000, 40).first == 0);
  CHECK(feet_under(on(), 1000, 200).first == 0);
}

TEST_CASE("support: conical columns get narrower downwards and keep their least width") {
  auto body = tee(100);
  auto s = on();
  s.support_conical_enabled = false;
  const auto straight = planned(s, body);
  s.support_conical_enabled = true, s.support_brim_width = 0;
  s.support_conical_min_width = 4000;
  const auto leaning = planned(s, body);
  const auto area = [](const support::Plan& plan, std::size_t k) { return area_mm2(all_of(plan.layers[k])); };
  CHECK(area(leaning, 1) < 0.6 * area(straight, 1));
  CHECK_FALSE(geometry::opening(all_of(leaning.layers[1]), 1800).empty());
  CHECK(floating(leaning, body, 300) < 0.01);
  s.support_conical_angle = -20;
  CHECK(area(planned(s, body), 1) > 1.2 * area(straight, 1));
}

TEST_CASE("support: conical columns that are high stand as wide as they need, and slender ones get wider") {
  for (const int post : {50, 200, 400, 700}) {
    auto body = tee(post);
    auto s = on();
    s.support_conical_enabled = true, s.support_brim_width = 0;
    INFO("post of " << post << " layers");
    CHECK(slenderest(planned(s, body)) < 9);
    Body arm;  // a bracket 2 mm wide
    arm.add(post, {rectangle(-2000, -2000, 2000, 2000)});
    arm.add(10, {rectangle(-2000, -1000, 20000, 1000)});
    CHECK(slenderest(planned(s, arm)) < steady);
  }
}

TEST_CASE("support: a tiny overhang stands on a tower as thick as is set, whose top is as steep as is set") {
  Body body;
  body.add(60, {rectangle(0, 0, 10000, 10000)});
  body.add(10, {rectangle(0, 0, 10000, 10000), rectangle(16000, 5000, 16800, 5800)});
  for (const auto structure : every_structure) {
    auto s = on(structure);
    s.support_use_towers = true, s.support_tower_diameter = 4000, s.support_brim_width = 0;
    const auto plan = planned(s, body);
    INFO(static_cast<int>(structure));
    REQUIRE(plan.layers.size() > 20);
    CHECK(area_mm2(all_of(plan.layers[2])) == Approx(12.57).epsilon(0.05));
    // A millimetre below the tip it is that by the tangent of 65 degrees wider on each side.
    const Um top = plan.layers.back().z;
    for (const auto& layer : plan.layers) {
      const Box box = box_of(all_of(layer));
      const double wide = std::min(4.0, 0.8 + 2 * to_mm(top - layer.z) / std::tan(65 * 3.14159265 / 180));
      CHECK(to_mm(box.size().x) == Approx(std::max(1.6, wide)).margin(0.1));  // nothing is thinner than two lines
    }
    CHECK(floating(plan, body, 300) < 0.01);
  }
}

TEST_CASE("support: on a slope it begins in steps as high and no wider than is set") {
  Body body;  // 40 mm wide below, a layer 0.5 mm less than the one below it, and a roof over it
  for (int i = 0; i < 30; ++i) body.add(1, {rectangle(-20000, -5000, 20000 - i * 500, 5000)});
  body.add(20, {rectangle(-20000, -5000, -18000, 5000)});
  body.add(5, {rectangle(-20000, -5000, 20000, 5000)});
  auto s = on();
  const auto near = planned(s, body);
  s.support_bottom_stair_step_height = 1000;
  const auto stairs = planned(s, body);
  std::vector<Um> begins;  // where support reaches to, level by level
  for (const auto& layer : stairs.layers) {
    const Regions area = all_of(layer);
    if (layer.z < 2000 && !area.empty()) begins.push_back(box_of(area).min.x);
  }
  std::sort(begins.begin(), begins.end());
  begins.erase(std::unique(begins.begin(), begins.end(), [](Um a, Um b) { return b - a < 600; }), begins.end());
  CHECK(begins.size() <= 3);  // of two millimetres' height
  double a = 0, b = 0;
  for (const auto& layer : near.layers) a += area_mm2(all_of(layer));
  for (const auto& layer : stairs.layers) b += area_mm2(all_of(layer));
  CHECK(b < a);
}

TEST_CASE("support: what blockers mark is passed through, unless it is to be avoided") {
  auto body = tee();
  std::vector<Regions> blocked(body.layers.size());
  for (std::size_t i = 10; i < 20; ++i) blocked[i] = {rectangle(5000, -10000, 12000, 10000)};
  for (const auto structure : every_structure)
    for (const bool avoided : {false, true}) {
      auto s = on(structure);
      s.support_blockers_avoided = avoided;
      auto object = body.object();
      object.blocked = blocked;
      const auto plan = support::plan(s, object, support::demand(s, object));
      double inside = 0;
      for (const auto& layer : plan.layers)
        if (layer.z - layer.height >= 2200 && layer.z <= 3800)
          inside += area_mm2(geometry::intersect(all_of(layer), blocked[10]));
      INFO(static_cast<int>(structure) << avoided);
      CHECK((inside > 0) == !avoided);
    }
}

TEST_CASE("support: it stays in its room") {
  auto body = tee();
  for (const auto structure : every_structure) {
    auto object = body.object();
    const Regions room{rectangle(-15000, -9000, 15000, 15000)};
    object.room = &room;
    const auto s = on(structure);
    const auto plan = support::plan(s, object, support::demand(s, object));
    REQUIRE_FALSE(plan.layers.empty());
    for (const auto& layer : plan.layers) CHECK(geometry::subtract(all_of(layer), grown(room, 2)).empty());
  }
}

TEST_CASE("support: blockers take demand away, enforcers add it, and where both are the enforcer has it") {
  auto body = tee();
  const auto s = on();
  auto object = body.object();
  const auto free = support::demand(s, object);
  std::vector<Regions> half(body.layers.size(), Regions{rectangle(-30000, -30000, 0, 30000)});
  object.blocked = half;
  const auto blocked = support::demand(s, object);
  CHECK(area_mm2(blocked[50].wanted) == Approx(area_mm2(free[50].wanted) / 2).epsilon(0.01));
  CHECK(geometry::intersect(blocked[50].wanted, half[50]).empty());
  object.enforced = half;
  const auto both = support::demand(s, object);
  CHECK(area_mm2(both[50].wanted) == Approx(area_mm2(free[50].wanted)).epsilon(0.01));
  auto marked_only = s;
  marked_only.support_auto = false;
  object.blocked = {};
  CHECK(area_mm2(support::demand(marked_only, object)[50].wanted) ==
        Approx(area_mm2(free[50].wanted) / 2).epsilon(0.01));
}

TEST_CASE("support: what begins inside a tube is an island, and the tube around it is none") {
  const Regions tube = geometry::subtract({rectangle(0, 0, 20000, 20000)}, {rectangle(1000, 1000, 19000, 19000)});
  Body body;
  body.add(30, tube);
  Regions both = tube;
  both.push_back(rectangle(5000, 5000, 15000, 15000));  // larger than the tube's wall
  body.add(5, both);
  const auto found = support::islands(body.object());
  REQUIRE(found.size() == 1);
  CHECK(found[0].at.x >= 5000);
}

TEST_CASE("support: an island asks for support however small it is, and is told where support is off") {
  Body body;
  body.add(30, {rectangle(0, 0, 10000, 10000)});
  body.add(10, {rectangle(0, 0, 10000, 10000), rectangle(15000, 0, 15500, 500)});
  const auto plan = planned(on(), body);
  CHECK_FALSE(plan.layers.empty());
  const auto found = support::islands(body.object());
  REQUIRE(found.size() == 1);
  CHECK(found[0].layer == 30);
  CHECK(found[0].at.x >= 15000);
  auto other = tee();
  CHECK(support::islands(other.object()).empty());
  std::vector<Regions> steps;  // as walls know them
  for (std::size_t i = 0; i < body.layers.size(); ++i)
    steps.push_back(i == 0 ? Regions{} : geometry::subtract(body.layers[i].regions, body.layers[i - 1].regions));
  std::vector<const Regions*> known;
  for (const auto& step : steps) known.push_back(&step);
  auto told = body.object();
  told.over_air = known;
  const auto same = support::islands(told);
  REQUIRE(same.size() == 1);
  CHECK((same[0].layer == found[0].layer && same[0].at == found[0].at));
  const auto wanted = support::demand(on(), told), asked = support::demand(on(), body.object());
  for (std::size_t i = 0; i < wanted.size(); ++i) CHECK(wanted[i].wanted == asked[i].wanted);
}

TEST_CASE("support: moved by microns it only moves") {
  for (const auto structure : every_structure) {
    auto body = tee();
    const auto here = planned(on(structure), body);
    for (auto& layer : body.layers) layer.regions = moved(layer.regions, {1237, -4711});
    const auto there = planned(on(structure), body);
    INFO(static_cast<int>(structure));
    REQUIRE(here.layers.size() == there.layers.size());
    for (std::size_t k = 0; k < here.layers.size(); ++k) {
      const auto &was = here.layers[k], &is = there.layers[k];
      for (const auto kind : {&support::SupportLayer::columns, &support::SupportLayer::branches,
                              &support::SupportLayer::roof, &support::SupportLayer::bottom})
        CHECK(is.*kind == moved(was.*kind, {1237, -4711}));
      CHECK(is.joists.area == moved(was.joists.area, {1237, -4711}));
    }
  }
}

TEST_CASE("support: branches lean no further than is set") {
  for (const double angle : {20.0, 40.0}) {
    auto body = tee(100);
    auto s = on(SupportStructure::tree);
    s.support_tree_angle = angle, s.support_brim_width = 0;
    const auto plan = planned(s, body);
    INFO(angle);
    REQUIRE(plan.layers.size() > 50);
    bool leans = false;
    for (std::size_t k = 1; k < plan.layers.size(); ++k) {
      const Um by = static_cast<Um>(plan.layers[k].height * std::tan(angle * 3.14159265 / 180)) + 5;
      const Regions below = all_of(plan.layers[k - 1]);
      CHECK(area_mm2(geometry::subtract(plan.layers[k].branches, grown(below, by))) < 0.01);
      leans = leans || !geometry::subtract(plan.layers[k].branches, grown(below, by / 2)).empty();
    }
    CHECK(leans);
  }
}

TEST_CASE("support: under a slope every layer is held its gap below, and levels are as high as they may be") {
  constexpr Um steps = 40;
  Body body;
  body.add(50, {rectangle(-10000, -10000, 10000, 10000)});
  for (int i = 1; i <= steps; ++i) body.add(1, {rectangle(-10000 - i * 400, -10000, 10000 + i * 400, 10000)});
  for (const auto structure : every_structure)
    for (const Um gap : {0, 150, 200}) {
      auto s = on(structure);
      s.support_top_distance = gap;
      const auto plan = planned(s, body);
      INFO(static_cast<int>(structure) << ", gap " << gap);
      for (int i = 2; i <= steps; ++i) {
        const auto& layer = body.layers[static_cast<std::size_t>(49 + i)];
        const Um top = layer.z - layer.height - gap;
        Regions there;
        for (const auto& level : plan.layers)
          if (level.z == top)
            for (const Region& region : all_of(level)) there.push_back(region);
        const Regions rim{rectangle(-10000 - i * 400, -9000, -9600 - i * 400, 9000)};
        CHECK(area_mm2(geometry::intersect(there, rim)) >
              (structure == SupportStructure::normal ? 0.35 : 0.1) * area_mm2(rim));
      }
      CHECK(too_near(plan, body, 195) == 0);
      std::vector<Um> heights;
      for (const auto& level : plan.layers) heights.push_back(level.height);
      CHECK(*std::min_element(heights.begin(), heights.end()) >= 100);
      CHECK(*std::max_element(heights.begin(), heights.end()) <= 300);
      std::size_t low = 0;  // below the slope there is nothing that asks for levels lower than they may be
      for (const auto& level : plan.layers) low += level.z < 9000 && level.height < 270;
      CHECK(low <= 1);
    }
}

TEST_CASE("support: columns reach no further than what they hold, also at its corners") {
  Body body = tee();
  const auto s = on();
  const auto plan = planned(s, body);
  REQUIRE(!plan.layers.empty());
  for (std::size_t k = 1; k < plan.layers.size(); ++k) {  // the first spreads on the bed
    const Box box = box_of(all_of(plan.layers[k]));
    CHECK(box.min.x >= -20030);
    CHECK(box.min.y >= -10030);
    CHECK(box.max.x <= 20030);
    CHECK(box.max.y <= 10030);
  }
}

TEST_CASE("support: random bodies keep the laws") {
  const char* const many = std::getenv("WEFT_SUPPORT_BODIES");  // bash: WEFT_SUPPORT_BODIES=200 test_support
  const int bodies = many != nullptr ? std::atoi(many) : 20;
  std::mt19937 random(20);  // any: what fails for one is a fault
  const auto between = [&](int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
  };
  for (int n = 0; n < bodies; ++n) {
    Body body;
    for (int piece = 0, pieces = between(2, 5); piece < pieces; ++piece) {
      Regions outline;
      for (int r = 0, count = between(1, 3); r < count; ++r) {
        const Um x = between(-15000, 10000), y = between(-15000, 10000);
        outline.push_back(rectangle(x, y, x + between(2000, 12000), y + between(2000, 12000)));
      }
      body.add(between(5, 25), geometry::unite(outline));
    }
    double by_columns = 0;  // left by the first, which is normal
    for (const auto structure : every_structure) {
      const auto plan = planned(on(structure), body);
      INFO("body " << n << ", structure " << static_cast<int>(structure));
      CHECK(too_near(plan, body, 195) == 0);
      CHECK(floating(plan, body, 300) < 0.05);
      if (structure == SupportStructure::normal) by_columns = plan.figures.left_mm2;
      CHECK(plan.figures.left_mm2 <= by_columns + 0.02 * plan.figures.needed_mm2 + 0.5);
    }
    auto straight = on(SupportStructure::normal);
    straight.support_conical_enabled = false;
    const auto plan = planned(straight, body);
    INFO("body " << n << ", columns as wide below as above");
    CHECK(too_near(plan, body, 195) == 0);
    CHECK(floating(plan, body, 300) < 0.05);
    // What is between walls has no room to stand on a wider foot.
    auto leaning = straight;
    leaning.support_conical_enabled = true;
    const auto conical = planned(leaning, body);
    INFO("and narrower below");
    CHECK(too_near(conical, body, 195) == 0);
    CHECK(floating(conical, body, 300) < 0.05);
    CHECK(slenderest(conical) <= std::max(steady, 1.02 * slenderest(plan)));
  }
}
