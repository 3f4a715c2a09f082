// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/heat.h"

#include <algorithm>

#include <catch2/catch.hpp>

using namespace weft;
using tools::Change;
using tools::Heating;

namespace {

/// Two hot ends at 210 and 230 °C that get hotter by 2 °C/s, and stand by 40 °C below.
std::vector<Settings> two_nozzles() {
  std::vector<Settings> out(2);
  out[1].material.material_print_temperature = 230;
  return out;
}

/// T0, T1 … in turn, each for so many seconds.
std::vector<Change> in_turn(int changes, double seconds) {
  std::vector<Change> out;
  for (int i = 0; i < changes; ++i) out.push_back({i * seconds, static_cast<ToolId>(i % 2), false});
  return out;
}

}  // namespace

TEST_CASE("heat: a nozzle that waits for long is cooled, and heated so long before that it is hot in time", "[tools]") {
  const auto plan = tools::heat_plan(two_nozzles(), in_turn(4, 100));
  // T0 waits from 100 to 200 s: 40 °C take 20 s. T1 likewise from 200 to 300 s. T0 is done at 300 s.
  CHECK(std::count(plan.heatings.begin(), plan.heatings.end(), Heating{100, 0, 170}) == 1);
  CHECK(std::count(plan.heatings.begin(), plan.heatings.end(), Heating{180, 0, 210}) == 1);
  CHECK(std::count(plan.heatings.begin(), plan.heatings.end(), Heating{200, 1, 190}) == 1);
  CHECK(std::count(plan.heatings.begin(), plan.heatings.end(), Heating{280, 1, 230}) == 1);
  CHECK(std::count(plan.heatings.begin(), plan.heatings.end(), Heating{300, 0, 0}) == 1);
  CHECK(std::is_sorted(plan.heatings.begin(), plan.heatings.end(),
                       [](const Heating& a, const Heating& b) { return a.s < b.s; }));
}

TEST_CASE("heat: a nozzle that waits for less than the window stays hot", "[tools]") {
  const auto plan = tools::heat_plan(two_nozzles(), in_turn(6, 40));  // 50 s is the window
  REQUIRE(plan.heatings.size() == 1);                                 // T0 is done with at 200 s
  CHECK(plan.heatings.front() == Heating{200, 0, 0});
  CHECK(plan.cold_at_start.empty());
}

TEST_CASE("heat: a nozzle is cold before its first use when there is time to heat it", "[tools]") {
  const std::vector<Change> late{{0, 0, true}, {600, 1, false}};
  auto all = two_nozzles();
  const auto plan = tools::heat_plan(all, late);
  CHECK(plan.cold_at_start == std::vector<ToolId>{1});
  // From a room's 25 °C to 230 °C: 102.5 s.
  CHECK(std::count(plan.heatings.begin(), plan.heatings.end(), Heating{600 - 102.5, 1, 230}) == 1);
  all[1].tools.machine_nozzle_heat_up_speed = 0.3;  // 683 s
  CHECK(tools::heat_plan(all, late).cold_at_start.empty());
}

TEST_CASE("heat: filaments that share a nozzle leave it hot", "[tools]") {
  auto all = two_nozzles();
  all[0].tools.tool_nozzles = all[1].tools.tool_nozzles = 0;
  CHECK(tools::heat_plan(all, in_turn(5, 1000)).heatings.empty());
}

TEST_CASE("heat: a standby temperature that is no lower, or that takes longer to leave than there is, is none",
          "[tools]") {
  auto all = two_nozzles();
  all[0].tools.material_standby_temperature = 210;
  all[1].tools.material_standby_temperature = 230;
  const auto only_off = [](const tools::HeatPlan& plan) {
    return std::all_of(plan.heatings.begin(), plan.heatings.end(), [](const Heating& h) { return h.celsius == 0; });
  };
  CHECK(only_off(tools::heat_plan(all, in_turn(4, 100))));
  all = two_nozzles();
  for (auto& tool : all) tool.tools.machine_nozzle_heat_up_speed = 0.3;  // 40 °C take 133 s
  CHECK(only_off(tools::heat_plan(all, in_turn(4, 100))));
}
