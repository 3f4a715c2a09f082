// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/program.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using nlohmann::json;

namespace {

/// A box sliced three times: twice alike, once with other infill.
struct Three : Scratch {
  Three() {
    write("box.stl", box_stl(20, 20, 4));
    REQUIRE(weft({"slice", "box.stl", "-o", "a.gcode"}, path()).status == 0);
    REQUIRE(weft({"slice", "box.stl", "-o", "same.gcode", "-j", "1"}, path()).status == 0);
    REQUIRE(weft({"slice", "box.stl", "-s", "infill_sparse_density=40", "-o", "dense.gcode"}, path()).status == 0);
  }
};

}  // namespace

TEST_CASE("weft compare: alike is status 0, differing 8, within a tolerance 0 again") {
  const Three desk;
  const auto same = weft({"compare", "a.gcode", "same.gcode", "--report", "-"}, desk.path());
  INFO(same.err);
  CHECK(same.status == 0);
  CHECK(json::parse(same.out)["same_moves"] == true);
  CHECK(json::parse(same.out)["settings"].empty());
  const auto other = weft({"compare", "a.gcode", "dense.gcode", "--report", "r.json", "-o", "page.html"}, desk.path());
  INFO(other.err);
  CHECK(other.status == 8);
  CHECK(other.out.empty());
  CHECK_THAT(other.err, Contains("they differ") && Contains("plastic"));
  const auto report = json::parse(desk.read("r.json"));
  CHECK(report["alike"] == false);
  CHECK(report["settings"].size() == 1);
  CHECK(report["settings"][0]["key"] == "infill_sparse_density");
  CHECK(report["settings"][0]["b"] == "40%");
  CHECK(report["layers"].size() == 20);
  CHECK(report["figures"][1]["name"] == "plastic");
  CHECK(report["figures"][1]["b"] > report["figures"][1]["a"]);
  CHECK_THAT(desk.read("page.html"), StartsWith("<!doctype html>") && Contains("id=\"pack-1\""));
  CHECK(weft({"compare", "a.gcode", "dense.gcode", "--tolerance", "90"}, desk.path()).status == 0);
  CHECK(weft({"compare", "a.gcode", "dense.gcode", "--tolerance", "0.5"}, desk.path()).status == 8);
}

TEST_CASE("weft compare: files of others, and what cannot be compared") {
  const Scratch scratch;
  scratch.write("a.gcode", "G28\nM83\nG1 Z0.2\nG1 X10 Y10 F6000\nG1 X50 E2 F1800\n");
  scratch.write("b.gcode", "G28\nM83\nG1 Z0.2\nG1 X10 Y10 F6000\nG1 X50 E2 F3600\n");
  const auto run = weft({"compare", "a.gcode", "b.gcode", "--report", "-"}, scratch.path());
  INFO(run.err);
  CHECK(run.status == 8);
  CHECK_THAT(json::parse(run.out)["settings_note"].get<std::string>(), Contains("neither file"));
  scratch.write("none.gcode", "");
  struct Case {
    std::vector<std::string> words;
    int status;
    std::string said;
  };
  const std::vector<Case> cases{{{"compare", "a.gcode"}, 2, "two G-code files"},
                                {{"compare", "a.gcode", "b.gcode", "-o", "p.png"}, 2, "no .html"},
                                {{"compare", "a.gcode", "b.gcode", "--tolerance", "-1"}, 2, "--tolerance"},
                                {{"compare", "a.gcode", "gone.gcode"}, 6, "gone.gcode"},
                                {{"compare", "a.gcode", "none.gcode", "-o", "p.html"}, 6, "no motion"}};
  for (const auto& c : cases) {
    const auto refused = weft(c.words, scratch.path());
    INFO(c.said << ": " << refused.err);
    CHECK(refused.status == c.status);
    CHECK_THAT(refused.err, Contains(c.said));
    CHECK_FALSE(scratch.has("p.html"));
  }
}
