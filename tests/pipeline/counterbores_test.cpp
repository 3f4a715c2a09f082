// SPDX-License-Identifier: GPL-3.0-or-later
// A hole that begins over a wider one: what is printed of it, from the model to the report.
#include "model_of_boxes.h"
#include "pipeline/pipeline.h"

#include <string>
#include <vector>

#include <catch2/catch.hpp>

using namespace weft;
using weft::test::Corners;
using weft::test::ModelOfBoxes;

namespace {

/// A frame around a square hole, mm.
std::vector<Corners> frame(double half, double low, double high) {
  return {{-10, -10, low, 10, -half, high},
          {-10, half, low, 10, 10, high},
          {-10, -half, low, -half, half, high},
          {half, -half, low, 10, half, high}};
}

/// A plate of 4 mm with a hole of 3 mm, which is 7 mm wide below 1.6 mm.
std::vector<Corners> counterbored() {
  auto out = frame(3.5, 0, 1.6);
  for (const auto& box : frame(1.5, 1.6, 4)) out.push_back(box);
  return out;
}

Report report_of(const ModelOfBoxes& model, CounterboreHoleBridging how) {
  Job job;
  job.models = {model.path()};
  job.audit = audit::Mode::annotate;
  job.settings.layers.layer_height = 200;
  job.settings.layers.counterbore_hole_bridging = how;
  Report report;
  REQUIRE(run(job, {}, report));
  return report;
}

std::vector<std::string> told(const Report& report) {
  std::vector<std::string> out;
  for (const auto& warning : report.warnings)
    if (warning.code == "counterbore_holes_closed") out.push_back(warning.message);
  return out;
}

}  // namespace

TEST_CASE("counterbores: what lies between the strips is not printed, and nothing is told of it") {
  const ModelOfBoxes model(counterbored());
  const auto rings = report_of(model, CounterboreHoleBridging::none),
             strips = report_of(model, CounterboreHoleBridging::partial);
  CHECK(rings.walls.whole_over_air_mm > 4 * 3);  // the hole's own wall, at least
  CHECK(strips.layers == rings.layers);
  CHECK(strips.filament_mm3 < rings.filament_mm3);
  CHECK(told(rings).empty());
  CHECK(told(strips).empty());
}

TEST_CASE("counterbores: a hole that a layer closes is told with its place") {
  const ModelOfBoxes model(counterbored());
  const auto lines = told(report_of(model, CounterboreHoleBridging::sacrificial));
  REQUIRE(lines.size() == 1);
  CHECK(lines.front().find("a hole over a wider one") != std::string::npos);
  CHECK(lines.front().find("to be drilled out") != std::string::npos);
}
