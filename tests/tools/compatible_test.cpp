// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compatible.h"

#include "core/error.h"

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::literals;
using Catch::Matchers::Contains;

namespace {

/// PLA and PETG in one nozzle.
std::vector<Settings> pla_and_petg() {
  std::vector<Settings> out(2);
  for (auto& tool : out) tool.tools.tool_nozzles = 0;
  out[1].material.material_type = "PETG";
  out[1].material.material_print_temperature = 240;
  return out;
}

std::string doubts(const std::vector<Settings>& tools, std::vector<tools::ToolInUse> use = {{0, 200}, {1, 200}}) {
  std::string out;
  for (const auto& notice : tools::compatibility(tools, use)) out += notice.code + ": " + notice.message + "\n";
  return out;
}

std::string refusal(const std::vector<Settings>& tools, Um highest = 200) {
  try {
    (void)tools::compatibility(tools, {{0, highest}, {1, highest}});
  } catch (const Error& error) {
    CHECK(error.kind() == Error::Kind::settings);
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("compatible: temperatures count by the ranges of filaments, not by their kinds", "[tools]") {
  auto all = pla_and_petg();
  CHECK(doubts(all).empty());  // no range is known
  all[0].tools.material_print_temperature_max = 230;
  CHECK_THAT(doubts(all), Contains("T1 (PETG) is printed at 240 °C") && Contains("T0 (PLA)") && Contains("230 °C"));
  CHECK(doubts(all, {{0, 200}}).empty());  // the other prints nothing
  all[1].tools.tool_nozzles = 1;
  CHECK(doubts(all).empty());
  all = pla_and_petg();
  all[1].tools.material_print_temperature_min = 220;
  CHECK_THAT(doubts(all), Contains("T0 (PLA) is printed at 210 °C") && Contains("melts at 220 °C"));
}

TEST_CASE("compatible: beds more than 15 degrees apart are told with both names", "[tools]") {
  auto all = pla_and_petg();
  all[1].material.material_bed_temperature = 75;
  CHECK(doubts(all).empty());
  all[1].material.material_bed_temperature = 76;
  CHECK_THAT(doubts(all), Contains("T0 (PLA) wants a bed of 60 °C, T1 (PETG) one of 76 °C"));
}

TEST_CASE("compatible: what wears a nozzle out, and what does not hold on the plate", "[tools]") {
  auto all = pla_and_petg();
  all[1].tools.material_nozzle_hardness = 40;
  CHECK(doubts(all).empty());  // nobody knows the nozzle
  all[1].tools.machine_nozzle_hardness = 2;
  CHECK_THAT(doubts(all), Contains("nozzle_hardness: ") && Contains("40 HRC") && Contains("has 2"));
  all[1].tools.machine_nozzle_hardness = 55;
  CHECK(doubts(all).empty());
  all[0].tools.machine_bed_plate = "smooth PEI";
  all[1].tools.material_plates = "textured PEI, Smooth pei";
  CHECK(doubts(all).empty());
  all[1].tools.material_plates = "textured PEI";
  CHECK_THAT(doubts(all), Contains("T1 (PETG) holds on textured PEI, and the bed's plate is smooth PEI"));
}

TEST_CASE("compatible: filaments of other thickness do not go through one nozzle", "[tools]") {
  auto all = pla_and_petg();
  all[1].material.filament_diameter = 1900;
  CHECK(refusal(all).empty());
  all[1].material.filament_diameter = 2850;
  CHECK_THAT(refusal(all), Contains("filament_diameter: T0 (PLA) and T1 (PETG) share a nozzle") && Contains("2.85"));
  all[1].tools.tool_nozzles = 1;
  CHECK(refusal(all).empty());
}

TEST_CASE("compatible: no layer is higher than the nozzle that prints it", "[tools]") {
  auto all = pla_and_petg();
  all[1].machine.nozzle_diameter = 250;
  CHECK(refusal(all, 250).empty());
  CHECK_THAT(refusal(all, 300), Contains("T1 (PETG) prints layers of 0.3 mm, and its nozzle is 0.25 mm wide"));
}
