// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/priced_report.h"
#include "source.h"

#include <cmath>
#include <sstream>

using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

std::string example(const char* name) {
  return (tests::source / "examples" / name).string();
}

}  // namespace

TEST_CASE("estimate: with --exact it says what slicing says, and writes nothing") {
  const Scratch scratch;
  for (const auto& model : {example("bracket.stl"), example("calibration-tower.stl")}) {
    const auto sliced = report_of(scratch, {"slice", model, "-o", "a.gcode"}, prices);
    std::filesystem::remove(scratch.path() / "a.gcode");
    std::filesystem::remove(scratch.path() / "report.json");
    auto words = std::vector<std::string>{"estimate", model, "--exact", "--report", "-", "-q"};
    words.insert(words.end(), prices.begin(), prices.end());
    const auto run = weft(words, scratch.path());
    REQUIRE(run.status == 0);
    CHECK(scratch.names().empty());
    const auto estimated = json::parse(run.out);
    for (const auto* same :
         {"print_time_s", "filament", "cost", "layers", "height_mm", "features", "travel", "walls"}) {
      INFO(same);
      CHECK(estimated[same] == sliced[same]);
    }
    CHECK(estimated["audit"]["verdict"] == "unaudited");
    CHECK(estimated["gcode_sha256"] == "");
  }
}

TEST_CASE("estimate: a quarter of the layers tells time, filament and cost within four in a hundred") {
  // What people quote by: the error is that of the layers left out, and the parts are of the kind that farms print.
  const Scratch scratch;
  scratch.write("box.stl", box_stl(30, 20, 25));
  for (const auto& model : {example("bracket.stl"), example("calibration-tower.stl"), std::string("box.stl")})
    for (const auto* density : {"0", "20", "100"}) {
      INFO(model << " " << density);
      const std::vector<std::string> set{"--infill-sparse-density", density, "--filament-cost", "20"};
      const auto sliced = report_of(scratch, {"slice", model, "-o", "a.gcode"}, set);
      const auto estimated = report_of(scratch, {"estimate", model}, set);
      CHECK(estimated["print_time_s"].get<double>() == Approx(sliced["print_time_s"].get<double>()).epsilon(0.04));
      CHECK(estimated["filament"]["g"].get<double>() == Approx(sliced["filament"]["g"].get<double>()).epsilon(0.04));
      CHECK(estimated["cost"]["total"].get<double>() == Approx(sliced["cost"]["total"].get<double>()).epsilon(0.04));
      CHECK(estimated["layers"] == sliced["layers"]);
    }
}

TEST_CASE("estimate: the answer is on standard output, the same for any number of threads") {
  const auto one = weft({"estimate", example("bracket.stl"), "-j", "1", "--filament-cost", "20"});
  INFO(one.err);
  REQUIRE(one.status == 0);
  CHECK_THAT(one.out,
             Contains("time      ") && Contains("filament  ") && Contains("cost      ") && Contains("planned"));
  CHECK(weft({"estimate", example("bracket.stl"), "-j", "2", "--filament-cost", "20"}).out == one.out);
}

TEST_CASE("estimate: wrong use and models without anything to print fail as they do for slice") {
  const Scratch scratch;
  scratch.write("flat.stl", box_stl(20, 20, 0.01F));
  CHECK(weft({"estimate"}, scratch.path()).status == 2);
  CHECK(weft({"estimate", "none.stl"}, scratch.path()).status == 6);
  CHECK(weft({"estimate", "flat.stl"}, scratch.path()).status == 4);
  CHECK(weft({"estimate", "flat.stl", "--layer-height", "9"}, scratch.path()).status == 3);
}
