// SPDX-License-Identifier: GPL-3.0-or-later
// What the shape of a model makes a printer do that nobody would guess from its picture is told.
#include "model_of_boxes.h"
#include "pipeline/estimate.h"

#include <string>
#include <vector>

#include <catch2/catch.hpp>

using namespace weft;
using weft::test::Corners;
using weft::test::ModelOfBoxes;

namespace {

Job job_of(const ModelOfBoxes& model) {
  Job job;
  job.models = {model.path()};
  job.audit = audit::Mode::annotate;
  return job;
}

Report report_of(const Job& job) {
  Report report;
  REQUIRE(run(job, {}, report));
  return report;
}

std::vector<std::string> told(const Job& job, std::string_view code) {
  std::vector<std::string> out;
  for (const auto& warning : report_of(job).warnings)
    if (warning.code == code) out.push_back(warning.message);
  return out;
}

bool says(const std::vector<std::string>& lines, std::string_view what) {
  return lines.size() == 1 && lines.front().find(what) != std::string::npos;
}

}  // namespace

TEST_CASE("shape: a print is as high as what is laid, not as a tip that is thinner than any bead") {
  const ModelOfBoxes model({{-5, -5, 0, 5, 5, 4}, {-0.01, -0.01, 4, 0.01, 0.01, 6}});
  for (const auto& [height, layers] : {std::pair{0.2, 20U}, std::pair{0.1, 40U}}) {
    Job job = job_of(model);
    job.settings.layers.layer_height = from_mm(height);
    const Report report = report_of(job);
    CHECK(report.layers == layers);
    CHECK(report.height_mm == Approx(4));
  }
}

TEST_CASE("shape: what is too thin to be laid is told once, with the place of the longest stretch of its first layer") {
  // Two fins of 0.03 mm on a block, of 30 layers each.
  const ModelOfBoxes model({{-5, -5, 0, 5, 5, 6}, {4.9, -4, 0, 7, -3.97, 6}, {4.9, 3, 0, 9, 3.03, 6}});
  Job job = job_of(model);
  job.placement.centre = {100'000, 100'000};
  job.settings.layers.layer_height = 200;
  const auto lines = told(job, "thin_feature_dropped");
  REQUIRE(lines.size() == 1);
  CHECK(says(lines, "layer 0 (z 0.200)"));
  CHECK(says(lines, ", at 105.0"));  // the middle of the longer fin, x 5 … 9 of a box of -5 … 9 that is put at 100
  CHECK(says(lines, "29 more places up to layer 29"));
  Report report;  // of an estimate that lays the walls of every fourth layer, and of the first two
  estimate(job, {}, {}, report);
  std::vector<std::string> estimated;
  for (const auto& warning : report.warnings)
    if (warning.code == "thin_feature_dropped") estimated.push_back(warning.message);
  CHECK_FALSE(says(estimated, "29 more places"));
  CHECK(says(estimated, "; one of 4 layers was looked at"));
}

TEST_CASE("shape: what gives way to the nozzle is told, and what stands is not") {
  struct Row {
    std::vector<Corners> boxes;
    bool sways;
  };
  const Row rows[] = {
      {{{0, 0, 0, 1, 1, 60}}, true},                        // a pin
      {{{0, 0, 0, 1, 1, 8}}, false},                        // a short one
      {{{-8, -8, 0, 8, 8, 2}, {0, 0, 2, 1, 1, 60}}, true},  // on a foot: the pin is what gives
      {{{0, 0, 0, 1, 80, 60}}, false},                      // a wall is stroked along
      {{{0, 0, 0, 8, 8, 60}}, false},                       // a post
      {{{0, 0, 0, 1, 1, 60}, {30, 0, 0, 31, 1, 60}, {0, 30, 0, 1, 31, 60}, {0, 0, 60, 31, 31, 62}}, true},
      {{{0, 0, 0, 2, 2, 25}, {30, 0, 0, 32, 2, 25}, {0, 30, 0, 2, 32, 25}, {0, 0, 25, 32, 32, 28}}, false},
  };
  for (const auto& [boxes, sways] : rows) {
    const ModelOfBoxes model(boxes);
    const auto lines = told(job_of(model), "part_sways");
    INFO(boxes.back()[5] << " mm, " << boxes.size() << " boxes");
    CHECK(lines.size() == (sways ? 1U : 0U));
  }
  const ModelOfBoxes pin({{-8, -8, 0, 8, 8, 2}, {0, 0, 2, 1, 1, 60}});
  Job job = job_of(pin);
  job.placement.centre = {100'000, 100'000};
  const auto lines = told(job, "part_sways");
  CHECK(says(lines, "58.0 mm of it stand on 1.00 mm² at (100.500, 100.500, 2.000)"));
}
