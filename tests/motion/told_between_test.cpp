// SPDX-License-Identifier: GPL-3.0-or-later
// What is told between moves: pressure advance, and a fan in time.
#include "motion/fan_lead.h"
#include "motion/motion.h"
#include "motion/pressure_advance.h"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::motion;

namespace {

Extrude line(Um from, Um to, double speed_mm_s, Role role = Role::inner_wall) {
  return {.path = {{{from, 0}, 400, 1.F}, {{to, 0}, 400, 1.F}}, .role = role, .height = 200, .speed_mm_s = speed_mm_s};
}
std::vector<double> advances(const LayerPlan& layer) {
  std::vector<double> out;
  for (const Step& step : layer.steps)
    if (const auto* told = std::get_if<SetPressureAdvance>(&step)) out.push_back(told->seconds);
  return out;
}

}  // namespace

TEST_CASE("pressure advance: it goes through what was measured, is monotone between, and stays beyond") {
  const PressureRows rows{
      {0.06, 2, 1000, {}}, {0.04, 8, 1000, {}}, {0.035, 16, 1000, {}}, {0.05, 2, 5000, {}}, {0.03, 8, 5000, {}}};
  CHECK(pressure_advance_s(rows, 2, 1000, 200) == Approx(0.06));
  CHECK(pressure_advance_s(rows, 8, 1000, 200) == Approx(0.04));
  CHECK(pressure_advance_s(rows, 16, 1000, 200) == Approx(0.035));
  CHECK(pressure_advance_s(rows, 1, 500, 200) == Approx(0.06));
  CHECK(pressure_advance_s(rows, 50, 1000, 200) == Approx(0.035));
  CHECK(pressure_advance_s(rows, 8, 3000, 200) == Approx(0.035));
  double before = 1;
  for (double q = 1; q < 20; q += 0.25) {
    const double now = pressure_advance_s(rows, q, 1000, 200);
    CHECK(now <= before + 1e-12);
    before = now;
  }
  const PressureRows by_height{{0.06, 5, 1000, 100}, {0.02, 5, 1000, 300}};
  CHECK(pressure_advance_s(by_height, 5, 1000, 200) == Approx(0.04));
  CHECK(pressure_advance_s({{0.05, 5, 1000, {}}}, 1, 9000, 100) == 0.05);
}

TEST_CASE("pressure advance: each bead gets what its flow asks for, where that is another") {
  Rules rules;
  rules.machine.firmware = Firmware::klipper;
  rules.cooling.cool_min_layer_time = 0;
  rules.speeds.speed_wall_x = 100, rules.speeds.speed_bridge = 20;
  rules.material.material_max_volumetric_speed = 100;
  rules.material.pressure_advance_model = {{0.06, 1.6, 1500, {}}, {0.03, 8, 1500, {}}};
  const LayerPlan layer{
      .z = 400,
      .height = 200,
      .steps = {line(0, 200'000, 0), line(200'000, 400'000, 0), line(400'000, 600'000, 0, Role::bridge)}};
  const auto told = advances(plan_layer(rules, layer, Point3{0, 0, 400}).plan);
  REQUIRE(told.size() == 2);
  CHECK(told[0] == Approx(0.03).margin(0.002));  // 0.4 × 0.2 × 100 = 8 mm³/s, less near its ends
  CHECK(told[1] == Approx(0.06).margin(0.0005));
  rules.material.pressure_advance_step = 0.05;
  CHECK(advances(plan_layer(rules, layer, Point3{0, 0, 400}).plan).size() == 1);
  // Other firmware empties its planner for it: without a way between, nothing is told.
  rules.material.pressure_advance_step = 0.004;
  rules.machine.firmware = Firmware::marlin2;
  CHECK(advances(plan_layer(rules, layer, Point3{0, 0, 400}).plan).empty());
  auto with_way = layer;
  with_way.steps.insert(with_way.steps.begin() + 2, {Retract{}, Travel{{Point3{400'000, 9'000, 400}}}, Prime{}});
  std::get<Extrude>(with_way.steps.back()).path.front().at.y = 9'000;
  const auto planned = plan_layer(rules, with_way, Point3{0, 100, 400}).plan;
  REQUIRE(advances(planned).size() == 2);
  for (std::size_t i = 0; i + 1 < planned.steps.size(); ++i)
    if (std::holds_alternative<SetPressureAdvance>(planned.steps[i]))
      CHECK((std::holds_alternative<Travel>(planned.steps[i + 1]) ||
             std::holds_alternative<Prime>(planned.steps[i + 1])));
}

TEST_CASE("fan lead: a fan is told to turn faster so long before, also in the middle of a bead, and slower in time") {
  TimedSteps steps;
  const auto at_10 = [&](Um from, Um to) { steps.add(line(from, to, 10), static_cast<float>((to - from) / 10'000.0)); };
  steps.add(SetFan{0.5});
  at_10(0, 50'000);  // 5 s
  steps.add(SetFan{1});
  at_10(50'000, 60'000);
  steps.add(SetFan{0.5});
  at_10(60'000, 160'000);
  lead_fan(2, steps);
  double time = 0;
  std::vector<std::pair<double, double>> told;
  double length = 0;
  for (std::size_t i = 0; i < steps.steps.size(); ++i) {
    if (const auto* fan = std::get_if<SetFan>(&steps.steps[i])) told.emplace_back(time, fan->share);
    if (const auto* bead = std::get_if<Extrude>(&steps.steps[i]))
      length += distance(bead->path.front().at, bead->path.back().at);
    time += static_cast<double>(steps.seconds[i]);
  }
  REQUIRE(told.size() == 3);
  CHECK(told[0] == std::pair(0.0, 0.5));
  CHECK(told[1].first == Approx(3));
  CHECK(told[1].second == 1);
  CHECK(told[2].first == Approx(6));
  CHECK(told[2].second == 0.5);
  CHECK(length == Approx(160'000));
  CHECK(time == Approx(16));
}

TEST_CASE("fan lead: a bead that is cut keeps its speeds, arcs and plastic") {
  Extrude bead{.path = {}, .role = Role::outer_wall, .height = 200, .speed_mm_s = 10};
  for (int i = 0; i <= 8; ++i) bead.path.push_back({{1000 * i, i % 2 * 100}, 400 + i, 1.F});
  for (int i = 0; i < 8; ++i) bead.segment_speed_mm_s.push_back(static_cast<float>(10 + i));
  bead.arcs = {{0, 3, {}, true}, {5, 8, {1, 2}, false}};
  const auto [a, b] = split(bead, 4);
  CHECK(a.path.size() + b.path.size() == bead.path.size() + 1);
  CHECK(a.path.back() == b.path.front());
  CHECK(a.segment_speed_mm_s.size() == 4);
  CHECK(b.segment_speed_mm_s.front() == 14.F);
  REQUIRE(a.arcs.size() == 1);
  REQUIRE(b.arcs.size() == 1);
  CHECK((b.arcs[0].first == 1 && b.arcs[0].last == 4));
}

TEST_CASE("speeds: along a curve outermost walls keep the speed of its slowest corner") {
  Rules rules;
  rules.cooling.cool_min_layer_time = 0;
  rules.machine.firmware = Firmware::marlin2;
  rules.machine.machine_max_jerk = 3;
  rules.speeds.speed_wall_0 = 120;
  Extrude circle{.path = {}, .role = Role::outer_wall, .height = 200};
  for (int i = 0; i <= 40; ++i) {
    const double a = 2 * std::numbers::pi * i / 40;
    circle.path.push_back({{rounded(8000 * std::cos(a)), rounded(8000 * std::sin(a))}, 400, 1.F});
  }
  const LayerPlan layer{.z = 400, .height = 200, .steps = {circle}};
  const auto speeds_of = [&] {
    const auto planned = plan_layer(rules, layer, Point3{8000, 0, 400}).plan;
    std::vector<double> out;
    for (const Step& step : planned.steps)
      if (const auto* bead = std::get_if<Extrude>(&step)) {
        out.assign(bead->path.size() - 1, bead->speed_mm_s);
        for (std::size_t i = 0; i < bead->segment_speed_mm_s.size(); ++i)
          out[i] = static_cast<double>(bead->segment_speed_mm_s[i]);
      }
    return out;
  };
  for (const double v : speeds_of()) CHECK(v == 120);
  rules.speeds.speed_curvature_even = 100;
  const auto even = speeds_of();
  const double least = *std::min_element(even.begin(), even.end()), most = *std::max_element(even.begin(), even.end());
  CHECK(most <= 1.02 * least);
  // A turn of 9° changes both axes by up to 0.157 v: 3 mm/s of jerk at 19 mm/s.
  CHECK(least == Approx(3 / (2 * std::sin(std::numbers::pi / 40))).epsilon(0.1));
  rules.speeds.speed_curvature_even = 50;
  CHECK(speeds_of().front() == Approx((120 + least) / 2));
}

TEST_CASE("speeds: walls that hang with more than half of their width have an acceleration of their own") {
  Rules rules;
  rules.speeds.acceleration_enabled = true;
  rules.speeds.acceleration_overhang = 300;
  Extrude near = line(0, 20'000, 0, Role::outer_wall), far = line(20'000, 40'000, 0, Role::outer_wall);
  near.air_quarters = 2, far.air_quarters = 3;
  const auto planned = plan_layer(rules, {.z = 400, .height = 200, .steps = {near, far}}, Point3{0, 0, 400}).plan;
  std::vector<double> found;
  for (const Step& step : planned.steps)
    if (const auto* bead = std::get_if<Extrude>(&step)) found.push_back(bead->acceleration_mm_s2);
  CHECK(found == std::vector<double>{1500, 300});
}
