// SPDX-License-Identifier: GPL-3.0-or-later
#include "model_of_boxes.h"
#include "pipeline/pipeline.h"

#include <algorithm>
#include <sstream>
#include <string>

#include <catch2/catch.hpp>

using namespace weft;
using weft::test::Corners;
using weft::test::ModelOfBoxes;

namespace {

/// A gallows with something that hangs from its arm, thicker towards the arm.
std::vector<Corners> gallows(double thin) {
  return {{-3, -3, 0, 3, 3, 20},
          {-3, -3, 20, 20, 3, 24},
          {15 - thin / 2, -thin / 2, 8, 15 + thin / 2, thin / 2, 12},
          {14, -1, 12, 16, 1, 20}};
}

Job job_of(const ModelOfBoxes& model) {
  Job job;
  job.models = {model.path()};
  job.audit = audit::Mode::annotate;
  return job;
}

std::vector<std::string> told(const Job& job, std::string_view code) {
  Report report;
  REQUIRE(run(job, {}, report));
  std::vector<std::string> out;
  for (const auto& warning : report.warnings)
    if (warning.code == code) out.push_back(warning.message);
  return out;
}

bool says(const std::vector<std::string>& lines, std::string_view what) {
  return lines.size() == 1 && lines.front().find(what) != std::string::npos;
}

}  // namespace

TEST_CASE("support: off, what begins in the air is told, where the first bead of it lies", "[support]") {
  const ModelOfBoxes thick(gallows(1));
  const auto of_thick = told(job_of(thick), "support_missing");
  CHECK(says(of_thick, "1 place begins in the air"));
  CHECK(says(of_thick, ", 8.000)"));
  // A tip thinner than any bead is left out: what is printed first above it is what begins in the air.
  const ModelOfBoxes thin(gallows(0.1));
  CHECK(says(told(job_of(thin), "support_missing"), ", 12.000)"));
}

TEST_CASE("support: on, it holds what is printed first above a tip that is too thin for a bead", "[support]") {
  const ModelOfBoxes thin(gallows(0.1));
  Job job = job_of(thin);
  job.settings.support.support_enable = true;
  Report report;
  REQUIRE(run(job, {}, report));
  CHECK(report.support.islands == 1);
  CHECK(report.support.left_mm2 < 0.1);
  CHECK(told(job, "support_missing").empty());
}

TEST_CASE("support: what hangs by its gap above the bed lies on it, and is not told as out of reach") {
  // A shelf whose underside is 0.2 mm above the bed: thin layers begin to hang there, and the gap is as wide.
  const ModelOfBoxes model({{0, 0, 0, 10, 20, 4}, {9, 0, 0.2, 24, 20, 4}});
  Job job = job_of(model);
  job.settings.support.support_enable = true;
  job.settings.layers.layer_height = 100;
  Report report;
  REQUIRE(run(job, {}, report));
  CHECK(report.support.needed_mm2 > 200);
  CHECK(report.support.left_mm2 == 0);
  CHECK(told(job, "support_left").empty());
}

TEST_CASE("support: beside the bed's border it leaves room for the skirt that lies around it", "[support]") {
  // A post with a shelf towards the border, which is where a skirt around the part itself just fits.
  const ModelOfBoxes model({{10, 0, 0, 20, 20, 24}, {0, 0, 20, 20, 20, 24}});
  Job job = job_of(model);
  job.placement.centre = {17'000, 100'000};
  job.settings.support.support_enable = true;
  job.settings.support.support_structure = GENERATE(SupportStructure::hybrid, SupportStructure::tree);
  REQUIRE(job.settings.adhesion.skirt_line_count > 0);
  Report report;
  REQUIRE(run(job, {}, report));
  CHECK(report.audit.verdict == "pass");
  CHECK(report.support.needed_mm2 > 100);
  CHECK(report.support.left_mm2 < 0.05 * report.support.needed_mm2);
}

TEST_CASE("support: what of a support mesh has no room is told, and what has is not") {
  const ModelOfBoxes model(gallows(1));
  struct Row {
    const char* mesh;
    const char* says;
  };
  const Row rows[] = {{"box:-3,6,0,3,10,12", ""},
                      {"box:-3,6,0,3,10,60", "what is higher than 24 mm lies above"},
                      {"box:-3,6,0,300,10,12", "lies beyond the print surface"}};
  for (const auto& [mesh, what] : rows) {
    INFO(mesh);
    Job job = job_of(model);
    job.placement.centre = {100'000, 100'000};
    job.marks = {{.model = 0, .kind = mesh::MarkKind::support, .source = mesh}};
    const auto lines = told(job, "support_mesh_cut");
    CHECK(lines.size() == (*what ? 1U : 0U));
    if (*what) CHECK(says(lines, what));
  }
}

TEST_CASE("support: by hand, it is told when nothing is marked") {
  const ModelOfBoxes model(gallows(1));
  Job job = job_of(model);
  job.settings.support.support_enable = true;
  CHECK(told(job, "support_unasked").empty());
  job.settings.support.support_auto = false;
  CHECK(says(told(job, "support_unasked"), "there is no enforcer"));
  job.marks = {{.model = 0, .kind = mesh::MarkKind::support_enforcer, .source = "box:5,-2,19,10,2,21"}};
  CHECK(told(job, "support_unasked").empty());
}

TEST_CASE("support: of copies the report tells what all of them need, as it tells their plastic") {
  const ModelOfBoxes model(gallows(1));
  Job job = job_of(model);
  job.settings.support.support_enable = true;
  Report one, three;
  REQUIRE(run(job, {}, one));
  job.placement.copies = 3;
  REQUIRE(run(job, {}, three));
  CHECK(three.support.needed_mm2 == Approx(3 * one.support.needed_mm2));
  CHECK(three.support.contact_mm2 == Approx(3 * one.support.contact_mm2));
  CHECK(three.support.islands == 3 * one.support.islands);
  CHECK(three.support.tips == 3 * one.support.tips);
}

TEST_CASE("support: an enforcer that meets no downward face is told, and one that does is not", "[support]") {
  const ModelOfBoxes model(gallows(1));
  for (const auto& [mark, idle] : {std::pair{"box:-1,-1,30,1,1,31", true}, std::pair{"box:5,-2,19,10,2,21", false}}) {
    Job job = job_of(model);
    job.settings.support.support_enable = true;
    job.settings.support.support_auto = false;
    job.marks = {{.model = 0, .kind = mesh::MarkKind::support_enforcer, .source = mark}};
    INFO(mark);
    CHECK(says(told(job, "support_enforcer_idle"), "meets no downward face") == idle);
  }
}

TEST_CASE("support: beside what needs none no layer begins that prints nothing", "[support]") {
  // Between two shelves, each held from below, there is a height of the upper one's own at which nothing is held.
  const ModelOfBoxes shelves({{-14, -10, 0, -4, 10, 25}, {-4, -10, 5, 36, 10, 8}, {-4, -10, 13, 36, 10, 16}});
  Job job = job_of(shelves);
  job.settings.support.support_enable = true;
  job.settings.support.support_structure = SupportStructure::normal;
  Report report;
  const auto out = run(job, {}, report);
  REQUIRE(out);
  REQUIRE(report.support.needed_mm2 > 100);
  std::istringstream lines{std::string(out->gcode())};
  int layers = 0, idle = 0;
  bool lays = true;
  for (std::string line; std::getline(lines, line);) {
    if (line == ";LAYER_CHANGE") ++layers, idle += !lays, lays = false;
    lays = lays ||
           (line.starts_with("G1 ") && line.find(" E") != std::string::npos && line.find(" X") != std::string::npos);
  }
  CHECK(layers > 150);
  CHECK(idle == 0);
}
