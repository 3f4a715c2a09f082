// SPDX-License-Identifier: GPL-3.0-or-later
#include "adhesion/raft.h"

#include "model_of_boxes.h"
#include "plain_job.h"

#include <algorithm>
#include <sstream>
#include <string>
#include <tuple>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::literals;
using weft::test::ModelOfBoxes;

namespace {

std::string printed(const Job& job) {
  Report report;
  const auto passed = run(job, {}, report);
  REQUIRE(passed);
  return std::string(passed->gcode());
}

/// Where lines of a kind are laid, mm.
struct Extent {
  double least_x = 1e9, lowest = 1e9, highest = 0, filament = 0;
};

/// @param up_to  mm above the bed
Extent laid(const std::string& gcode, const std::string& kind, double up_to = 1e9) {
  std::istringstream lines(gcode);
  Extent out;
  double z = 0;
  bool own = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(";TYPE:")) own = line == ";TYPE:" + kind;
    if (line.starts_with(";Z:")) z = std::stod(line.substr(3));
    const auto x = line.find(" X"), y = line.find(" Y"), e = line.find(" E");
    const bool moves = x != std::string::npos || y != std::string::npos;
    if (!own || z > up_to || !line.starts_with("G1") || !moves || e == std::string::npos) continue;
    out.filament += std::stod(line.substr(e + 2));
    if (x != std::string::npos) out.least_x = std::min(out.least_x, std::stod(line.substr(x + 2)));
    out.lowest = std::min(out.lowest, z), out.highest = std::max(out.highest, z);
  }
  return out;
}

}  // namespace

TEST_CASE("raft: at the border of the bed it lies under the outermost walls, too") {
  const ModelOfBoxes model({{0, 0, 0, 20, 20, 2}});
  Job job = test::plain_job({model.path()}, 100_mm);
  auto& adhesion = job.settings.adhesion;
  adhesion.adhesion_type = AdhesionType::raft, adhesion.skirt_line_count = 0;  // which would lie beyond the bed
  job.placement.centre = {10'050, 50'000};                                     // its wall's outer edge at x 0.05
  const auto text = printed(job);                                              // and nothing of the raft beyond the bed
  CHECK(laid(text, "External perimeter").least_x == Approx(0.05 + 0.2).margin(0.05));
  for (const char* kind : {"Support material", "Support material interface"}) {
    INFO(kind);
    CHECK(laid(text, kind).least_x > 0.1);
    CHECK(laid(text, kind).least_x < 0.4);
  }
}

TEST_CASE("raft: the skirt lies around it, on the bed alone") {
  const ModelOfBoxes model({{0, 0, 0, 10, 10, 2}});
  Job job = test::plain_job({model.path()});
  job.settings.adhesion.adhesion_type = AdhesionType::raft;
  const auto gap = to_mm(job.settings.adhesion.skirt_gap);
  auto text = printed(job);
  const Extent raft = laid(text, "Support material"), skirt = laid(text, "Skirt/Brim");
  CHECK(skirt.least_x == Approx(raft.least_x - gap).margin(0.6));
  CHECK(skirt.highest == Approx(raft.lowest));
  CHECK(text.find(";TYPE:Skirt/Brim") < text.find(";TYPE:Support material"));

  job.placement.copies = 2;  // what is printed after others stands as high as they do
  auto& plate = job.settings.plate;
  plate.print_sequence = PrintSequence::one_at_a_time;
  plate.machine_head_profile = "0: -10x-10, 10x-10, 10x10, -10x10";
  plate.gantry_height = 50_mm;
  text = printed(job);
  CHECK(laid(text, "Skirt/Brim").highest == Approx(raft.lowest));
  CHECK(laid(text, "Support material").lowest == Approx(raft.lowest));

  job.settings.adhesion.skirt_line_count = 0;
  CHECK(printed(job).find(";TYPE:Skirt/Brim") == std::string::npos);
}

TEST_CASE("raft: its surface is dense under the parts alone, and support stands on lines with air between") {
  const ModelOfBoxes tee({{-3, -10, 0, 3, 10, 8}, {-30, -10, 7, 30, 10, 9}});
  Job job = test::plain_job({tee.path()});
  auto& s = job.settings;
  s.adhesion.adhesion_type = AdhesionType::raft;
  s.support.support_enable = true, s.support.support_structure = SupportStructure::normal;
  const auto layers = adhesion::raft_layers(s.raft, s.machine.nozzle_diameter, s.layers.layer_height);
  const double top = to_mm(layers.back().z) + 0.001, below = to_mm(layers[1].z) + 0.001, middle = 100;
  const auto text = printed(job);
  const auto dense = laid(text, "Support material interface", top), open = laid(text, "Support material", top);
  CHECK(dense.least_x == Approx(middle - 3 - to_mm(s.raft.raft_margin)).margin(0.6));
  CHECK(open.highest == Approx(to_mm(layers.back().z)));
  // Two layers of lines at every second place, on either side of the dense part.
  const double area_mm2 = 2 * (30.0 - 3 - to_mm(s.raft.raft_margin)) * 20, thick = 2 * to_mm(s.layers.layer_height);
  const double filament_mm2 = 3.14159265 / 4 * 1.75 * 1.75;
  const double laid_mm = (open.filament - laid(text, "Support material", below).filament);
  const double density = laid_mm * filament_mm2 / (area_mm2 * thick);
  CHECK(density == Approx(0.6).margin(0.1));  // the loop around, and half of what is inside
  // The support's first layer lies on them: nothing is left out between.
  const auto first = laid(text, "Support material", top + to_mm(s.layers.layer_height) + 0.15);
  CHECK(first.highest > top);
  CHECK(first.filament > open.filament);
}

TEST_CASE("raft: where it lifts a part out of the machine, that is what the user is told") {
  const auto post = [](double height, Report& report) {
    const ModelOfBoxes model({{0, 0, 0, 20, 20, height}});
    Job job = test::plain_job({model.path()}, 100_mm);
    job.settings.adhesion.skirt_line_count = 0, job.settings.adhesion.adhesion_type = AdhesionType::raft;
    return run(job, {}, report).has_value();
  };
  Report report;
  CHECK(post(97, report));
  CHECK_FALSE(post(99.6, report));
  CHECK_THAT(report.error, Catch::Matchers::Contains("the raft lifts the print by"));
  CHECK_THROWS_WITH(post(103, report), Catch::Matchers::Contains("too high"));  // without it as well
}
