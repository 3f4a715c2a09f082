// SPDX-License-Identifier: GPL-3.0-or-later
#include "layers.h"

#include <set>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::travel;

namespace {

std::vector<LayerInput> stack(std::size_t layers) {
  std::vector<LayerInput> inputs;
  for (std::size_t i = 0; i < layers; ++i) inputs.push_back(sample::layer(sample::plate(), i));
  return inputs;
}

std::vector<Extrude> extrusions(const LayerPlan& plan) {
  std::vector<Extrude> all;
  for (const auto& step : plan.steps)
    if (const auto* e = std::get_if<Extrude>(&step)) all.push_back(*e);
  return all;
}

double length_um(const Extrude& e) {
  double sum = 0;
  for (std::size_t i = 1; i < e.path.size(); ++i) sum += distance(e.path[i - 1].at, e.path[i].at);
  return sum;
}

}  // namespace

TEST_CASE("travel: every bead of a layer is printed exactly once, closed ones end where they began", "[travel][law]") {
  const auto type = GENERATE(SeamType::sharpest_corner, SeamType::aligned, SeamType::shortest, SeamType::back,
                             SeamType::random, SeamType::user);
  TravelSettings settings;
  settings.z_seam_type = type;
  settings.seam_gap_distance = length(0);
  const auto inputs = stack(3);
  const auto plans = plan(settings, {}, inputs);
  for (std::size_t i = 0; i < plans.size(); ++i) {
    const Beads& beads = inputs[i].objects[0].beads;
    const auto printed = extrusions(plans[i]);
    REQUIRE(printed.size() == beads.size());
    double asked = 0, got = 0;
    for (const auto& b : beads) asked += 1000 * length_mm(b);
    for (const auto& e : printed) got += length_um(e);
    CHECK(got == Approx(asked).epsilon(1e-5));
    std::multiset<std::size_t> want_sizes, got_sizes;
    int closed = 0, want_closed = 0;
    for (const auto& b : beads) want_closed += b.closed ? 1 : 0;
    for (const auto& e : printed) closed += e.path.front() == e.path.back() ? 1 : 0;
    CHECK(closed == want_closed);
  }
}

TEST_CASE("travel: a part is finished before the next is begun, its walls first and inner before outer",
          "[travel][law]") {
  const auto plans = plan({}, {}, stack(2));
  for (const auto& p : plans) {
    int changes = 0;
    bool island = false, first = true, fill_seen = false;
    for (const auto& e : extrusions(p)) {
      const Point at = e.path[e.path.size() / 2].at;
      const bool here = at.x > 21000 && at.x < 24000 && at.y > 19000;
      if (!first && here != island) ++changes, fill_seen = false;
      island = here, first = false;
      if (e.role == Role::infill)
        fill_seen = true;
      else
        CHECK_FALSE(fill_seen);
    }
    CHECK(changes == 1);
  }
}

TEST_CASE(
    "travel: a bridge is laid before the walls that hang over the same gap, one over sparse infill after its walls",
    "[travel]") {
  const auto roles_of = [](bool gap, bool below_walls) {
    auto input = sample::layer({sample::rectangle(0, 0, 20000, 10000)}, 1, 800, 7);
    for (Bead& bead : input.objects[0].beads)
      if (bead.role == Role::infill) bead.role = Role::bridge;
    if (gap)
      input.objects[0].over_air = {sample::rectangle(5000, below_walls ? 0 : 3000, 15000, below_walls ? 10000 : 7000)};
    std::vector<LayerInput> inputs{sample::layer({sample::rectangle(0, 0, 20000, 10000)}), std::move(input)};
    std::vector<Role> roles;
    for (const Extrude& e : extrusions(plan({}, {}, std::move(inputs))[1])) roles.push_back(e.role);
    return roles;
  };
  for (const bool gap : {false, true})
    for (const bool below_walls : {false, true}) {
      const auto roles = roles_of(gap, below_walls);
      const auto walls = std::count_if(roles.begin(), roles.end(), [](Role role) { return is_wall(role); });
      CAPTURE(gap, below_walls);
      REQUIRE(walls == 3);
      CHECK(is_wall(roles.front()) == !(gap && below_walls));
      CHECK(is_wall(roles.back()) == (gap && below_walls));
    }
}

TEST_CASE("travel: the walls of one contour follow each other", "[travel]") {
  const auto plans = plan({}, {}, stack(1));
  const auto printed = extrusions(plans[0]);
  for (std::size_t i = 1; i < printed.size(); ++i)
    if (printed[i].role == Role::outer_wall) {
      CHECK(printed[i - 1].role == Role::inner_wall);
      CHECK(distance(printed[i - 1].path.back().at, printed[i].path.front().at) < 2 * sample::width);
    }
}

TEST_CASE("travel: a travel that leaves the part is retracted, one inside is combed and not retracted", "[travel]") {
  TravelSettings settings;
  settings.retraction_combing_max_detour.reset();
  const auto plans = plan(settings, {}, stack(4));
  bool retracted = false, arrived = false;  // from the start G-code: that way is retracted, though no wall is there
  for (const auto& p : plans) {
    for (const auto& step : p.steps) {
      if (std::holds_alternative<Retract>(step)) retracted = true;
      if (std::holds_alternative<Prime>(step)) retracted = false;
      if (const auto* t = std::get_if<Travel>(&step); t && std::exchange(arrived, true))
        CHECK(t->crosses_wall == retracted);
    }
  }
  const auto c = sample::count(plans);
  CHECK(c.crossings == 4);  // to and from the island: once a layer, the next layer begins where this one ended
  TravelSettings off;
  off.retraction_combing = Combing::off;
  CHECK(sample::count(plan(off, {}, stack(4))).retractions > 4 * c.retractions);
  RetractionSettings never;
  never.retraction_enable = false;
  CHECK(sample::count(plan({}, never, stack(4))).retractions == 0);
}

TEST_CASE("travel: moving a plate by whole microns moves its plan", "[travel][law]") {
  const Point by = GENERATE(Point{1, 0}, Point{-70001, 90001});
  auto there = stack(3);
  for (auto& layer : there)
    for (auto& object : layer.objects) {
      object.outline = moved(object.outline, by);
      for (auto& bead : object.beads)
        for (auto& j : bead.path) j.at = j.at + by;
    }
  const auto a = plan({}, {}, stack(3)), b = plan({}, {}, there);
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto ea = extrusions(a[i]), eb = extrusions(b[i]);
    REQUIRE(ea.size() == eb.size());
    for (std::size_t k = 0; k < ea.size(); ++k) CHECK(ea[k].path.front().at + by == eb[k].path.front().at);
  }
  CHECK(sample::count(a).travel_mm == Approx(sample::count(b).travel_mm).epsilon(1e-9));
}

TEST_CASE("travel: monotonic lines keep their order, or have it turned around as a whole unless they are seen",
          "[travel][law]") {
  const Role role = GENERATE(Role::solid_infill, Role::top_skin);
  for (const Um turned : {0, 1}) {
    auto input = sample::layer({sample::rectangle({0, 0}, {20000, 20000})}, 0, 400, 7);
    for (auto& bead : input.objects[0].beads)
      if (bead.role == Role::infill) bead.role = role;
    if (turned != 0) std::reverse(input.objects[0].beads.begin(), input.objects[0].beads.end());
    std::vector<Um> ys;
    for (const auto& e : extrusions(plan({}, {}, {input})[0]))
      if (e.role == role) ys.push_back(e.path.front().at.y);
    REQUIRE(ys.size() > 40);
    const bool up = std::is_sorted(ys.begin(), ys.end()), down = std::is_sorted(ys.rbegin(), ys.rend());
    CHECK((up || down));
    if (role == Role::top_skin) CHECK(up == (turned == 0));
  }
}

TEST_CASE("travel: objects are labelled, their index is the plate's", "[travel]") {
  LayerInput input = sample::layer({sample::rectangle({0, 0}, {10000, 10000})});
  input.objects.push_back(sample::object({sample::rectangle({20000, 0}, {30000, 10000})}));
  input.objects[0].object = 4;
  input.objects[1].object = 9;
  input.adhesion.push_back(
      sample::closed_bead(sample::rectangle({-3000, -3000}, {33000, 13000}).outer, Role::skirt, 0, 0));
  const auto plans = plan({}, {}, {input});
  std::vector<std::uint32_t> labels;
  bool skirt_first = false;
  for (const auto& step : plans[0].steps) {
    if (const auto* s = std::get_if<ObjectStart>(&step)) labels.push_back(s->object);
    if (const auto* e = std::get_if<Extrude>(&step); e && e->role == Role::skirt) skirt_first = labels.empty();
  }
  CHECK(skirt_first);
  CHECK((labels == std::vector<std::uint32_t>{4, 9} || labels == std::vector<std::uint32_t>{9, 4}));
}
