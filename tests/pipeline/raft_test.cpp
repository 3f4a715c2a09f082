// SPDX-License-Identifier: GPL-3.0-or-later
#include "model_of_boxes.h"
#include "plain_job.h"

#include <algorithm>
#include <sstream>
#include <string>

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
  double least_x = 1e9, lowest = 1e9, highest = 0;
};

Extent laid(const std::string& gcode, const std::string& kind) {
  std::istringstream lines(gcode);
  Extent out;
  double z = 0;
  bool own = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(";TYPE:")) own = line == ";TYPE:" + kind;
    if (line.starts_with(";Z:")) z = std::stod(line.substr(3));
    const auto x = line.find(" X"), e = line.find(" E");
    if (!own || !line.starts_with("G1") || x == std::string::npos || e == std::string::npos) continue;
    out.least_x = std::min(out.least_x, std::stod(line.substr(x + 2)));
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
  job.placement.centre = {10'050, 50'000};  // its wall's outer edge at x 0.05
  const auto text = printed(job);  // and nothing of the raft beyond the bed
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
