// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/program.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using Catch::Matchers::Contains;
using nlohmann::json;

TEST_CASE("sweep: a grid is sliced with shared work done once, and every file is what weft slice makes") {
  Scratch scratch;
  scratch.write("a.stl", box_stl(20, 15, 4));
  const auto run = weft({"sweep", "a.stl", "--vary", "infill_sparse_density=10:30:10", "--vary",
                         "infill_pattern=grid,lines", "-s", "top_layers=2", "-o", "out", "--report", "run.json"},
                        scratch.path());
  INFO(run.err);
  REQUIRE(run.status == 0);
  const auto report = json::parse(scratch.read("run.json"));
  CHECK(report["made"] == 6);
  CHECK(report["cache"]["read"]["made"] == 1);
  CHECK(report["cache"]["slice"]["made"] == 1);
  CHECK(report["cache"]["walls"]["made"] == 1);
  CHECK(report["cache"]["walls"]["from_memory"] == 5);
  CHECK(report["cache"]["infill"]["made"] == 6);
  REQUIRE(weft({"slice", "a.stl", "-s", "infill_sparse_density=20", "-s", "infill_pattern=lines", "-s", "top_layers=2",
                "-o", "one.gcode"},
               scratch.path())
              .status == 0);
  CHECK(scratch.read("out/infill_sparse_density=20_infill_pattern=lines.gcode") == scratch.read("one.gcode"));
  CHECK_THAT(scratch.read("out/index.html"),
             Contains("infill_sparse_density=30,infill_pattern=grid") && Contains("iVBOR"));
  CHECK_THAT(scratch.read("out/infill_sparse_density=20_infill_pattern=lines.gcode.html"), Contains("id=\"pack-0\""));
  CHECK_THAT(scratch.read("out/summary.csv"), Contains("infill_sparse_density,infill_pattern"));
}

TEST_CASE("sweep: a combination that cannot be is refused before the first is sliced") {
  Scratch scratch;
  scratch.write("a.stl", box_stl(10, 10, 2));
  const auto run = weft({"sweep", "a.stl", "--vary", "layer_height=0.2,0.9", "-o", "out"}, scratch.path());
  CHECK(run.status == 3);
  CHECK_THAT(run.err, Contains("--vary layer_height=0.9"));
  CHECK_FALSE(scratch.has("out"));
  for (const auto& words : std::vector<std::vector<std::string>>{
           {"sweep", "a.stl", "-o", "out"},
           {"sweep", "--vary", "layer_height=0.1", "-o", "out"},
           {"sweep", "a.stl", "--vary", "layer_height=0.1:0.2", "-o", "out"},
           {"sweep", "a.stl", "--vary", "layer_height=0.1,0.2", "--zip", "--sample", "3", "-o", "out"},
           {"sweep", "a.stl", "--vary", "layer_height=0.1", "--vary", "layer-height=0.2", "-o", "out"}})
    CHECK(weft(words, scratch.path()).status == 2);
}

TEST_CASE("cache: weft slice with --cache gives the same bytes, the second time from disk") {
  Scratch scratch;
  scratch.write("a.stl", box_stl(20, 15, 4));
  REQUIRE(weft({"slice", "a.stl", "-o", "1.gcode"}, scratch.path()).status == 0);
  for (const auto* name : {"2.gcode", "3.gcode"}) {
    const auto run = weft({"slice", "a.stl", "-o", name, "--cache", "store", "-v"}, scratch.path());
    CHECK(run.status == 0);
    CHECK_THAT(run.err, Contains(name[0] == '2' ? "walls made 1" : "walls made 0, from memory 0, from disk 1"));
    CHECK(scratch.read(name) == scratch.read("1.gcode"));
  }
}
