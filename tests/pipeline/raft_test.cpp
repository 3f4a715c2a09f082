// SPDX-License-Identifier: GPL-3.0-or-later
#include "model_of_boxes.h"
#include "pipeline/pipeline.h"

#include <algorithm>
#include <sstream>
#include <string>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::literals;
using weft::test::ModelOfBoxes;

namespace {

/// The least X at which lines of that kind are laid, mm.
double least_x(const std::string& gcode, const std::string& kind) {
  std::istringstream lines(gcode);
  double out = 1e9;
  bool own = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(";TYPE:")) own = line == ";TYPE:" + kind;
    const auto x = line.find(" X"), e = line.find(" E");
    if (own && line.starts_with("G1") && x != std::string::npos && e != std::string::npos)
      out = std::min(out, std::stod(line.substr(x + 2)));
  }
  return out;
}

}  // namespace

TEST_CASE("raft: at the border of the bed it lies under the outermost walls, too") {
  const ModelOfBoxes model({{0, 0, 0, 20, 20, 2}});
  Job job;
  job.models = {model.path()};
  auto& s = job.settings;
  s.machine.machine_width = s.machine.machine_depth = s.machine.machine_height = 100_mm;
  s.machine.home_position = Ring{{0, 0}};
  s.gcode.machine_start_gcode = "G28";
  s.adhesion.adhesion_type = AdhesionType::raft;
  job.placement.centre = {10'050, 50'000};  // its wall's outer edge at x 0.05
  Report report;
  const auto passed = run(job, {}, report);  // and nothing of the raft beyond the bed
  REQUIRE(passed);
  const std::string text{passed->gcode()};
  CHECK(least_x(text, "External perimeter") == Approx(0.05 + 0.2).margin(0.05));
  for (const char* kind : {"Support material", "Support material interface"}) {
    INFO(kind);
    CHECK(least_x(text, kind) > 0.1);
    CHECK(least_x(text, kind) < 0.4);
  }
}
