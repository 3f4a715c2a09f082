// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/support.h"

#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "rectangle.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <catch2/catch.hpp>

using namespace weft;
using test::rectangle;

namespace {

/// Layers of 0.2 mm of a body that grows from outline to outline.
struct Body {
  std::vector<SlicedLayer> layers;
  std::vector<const SlicedLayer*> pointers;

  void add(int count, const Regions& outline, Um height = 200) {
    for (int i = 0; i < count; ++i) {
      const Um z = (layers.empty() ? 0 : layers.back().z) + height;
      layers.push_back({z, height, outline});
    }
  }
  support::Object object() {
    pointers.clear();
    for (const auto& layer : layers) pointers.push_back(&layer);
    support::Object out;
    out.layers = pointers;
    return out;
  }
};

/// A plate of 40 × 20 mm on a post of 4 × 4 mm.
Body tee(int post = 50) {
  Body out;
  out.add(post, {rectangle(-2000, -2000, 2000, 2000)});
  out.add(10, {rectangle(-20000, -10000, 20000, 10000)});
  return out;
}

SupportSettings on(SupportStructure structure = SupportStructure::normal) {
  SupportSettings s;
  s.support_enable = true;
  s.support_structure = structure;
  return s;
}

Regions all_of(const support::SupportLayer& layer) {
  Regions out;
  for (const auto* regions : {&layer.columns, &layer.branches, &layer.roof, &layer.bottom})
    out.insert(out.end(), regions->begin(), regions->end());
  return geometry::unite(out);
}

Regions grown(const Regions& regions, Um by) {
  return geometry::offset(regions, {.by = by, .corner = geometry::Corner::round, .arc_tolerance = 5});
}

support::Plan planned(const SupportSettings& s, Body& body) {
  const auto object = body.object();
  return support::plan(s, object, support::demand(s, object));
}

/// Plastic, about: columns are filled to 15 %, interfaces wholly, branches are one loop of 0.4 mm.
double plastic(const support::Plan& plan) {
  double mm3 = 0;
  for (const auto& layer : plan.layers) {
    double loops = 0;
    for (const auto& branch : layer.branches) loops += perimeter_of(branch.outer) / 1000;
    mm3 += (0.15 * area_mm2(layer.columns) + area_mm2(layer.roof) + area_mm2(layer.bottom) + 0.4 * loops) *
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

/// What of support has nothing below: neither bed, nor support, nor the part within a millimetre.
double floating(const support::Plan& plan, const Body& body, Um aside) {
  double mm2 = 0;
  for (std::size_t k = 1; k < plan.layers.size(); ++k) {
    Regions base = all_of(plan.layers[k - 1]);
    const Um bottom = plan.layers[k].z - plan.layers[k].height;
    for (const auto& layer : body.layers)
      if (layer.z <= bottom && layer.z > bottom - 1000)
        base.insert(base.end(), layer.regions.begin(), layer.regions.end());
    mm2 += area_mm2(geometry::subtract(all_of(plan.layers[k]), grown(geometry::unite(base), aside)));
  }
  return mm2;
}

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

TEST_CASE("support: branches take less than columns under a high table") {
  auto body = tee(150);
  const double columns = plastic(planned(on(SupportStructure::normal), body));
  CHECK(plastic(planned(on(SupportStructure::tree), body)) < 0.8 * columns);
  CHECK(plastic(planned(on(SupportStructure::hybrid), body)) <= columns);
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
  CHECK(support::islands(tee().object()).empty());
}

TEST_CASE("support: moved by microns it only moves") {
  for (const auto structure : {SupportStructure::normal}) {
    auto body = tee();
    const auto here = planned(on(structure), body);
    for (auto& layer : body.layers) layer.regions = moved(layer.regions, {1237, -4711});
    const auto there = planned(on(structure), body);
    REQUIRE(here.layers.size() == there.layers.size());
    for (std::size_t k = 0; k < here.layers.size(); ++k) {
      CHECK(there.layers[k].columns == moved(here.layers[k].columns, {1237, -4711}));
      CHECK(there.layers[k].roof == moved(here.layers[k].roof, {1237, -4711}));
    }
  }
}

TEST_CASE("support: random bodies keep the laws") {
  std::mt19937 random(20);  // any: what fails for one is a fault
  const auto between = [&](int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
  };
  for (int n = 0; n < 20; ++n) {
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
  }
}
