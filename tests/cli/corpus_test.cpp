// SPDX-License-Identifier: GPL-3.0-or-later
// Real models as a farm slices them: audited, reproducible, and what the file says of itself is true.
#include "corpus.h"

#include "cli/program.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using nlohmann::json;

TEST_CASE(
    "corpus: every model passes the audit, gives the same bytes for any number of threads, with and without a cache, "
    "and verifies",
    "[corpus]") {
  for (const auto* name : {"MINI-minda-holder", "MINI-x-carriage", "benchy", "fandisk", "stanford-bunny"}) {
    const auto model = corpus("models/" + std::string(name) + ".stl");
    if (!model) return;
    CAPTURE(name);
    Scratch scratch;
    std::string first;
    for (const auto* threads : {"1", "2", "3", "8"}) {
      const auto run =
          weft({"slice", model->string(), "-o", "out.gcode", "-j", threads, "--report", "-"}, scratch.path());
      INFO(run.err);
      REQUIRE(run.status == 0);
      const auto report = json::parse(run.out);
      CHECK(report["audit"]["verdict"] == "pass");
      if (first.empty()) first = report["gcode_sha256"];
      CHECK(report["gcode_sha256"] == first);
    }
    for (const auto* threads : {"3", "2"}) {  // the cache cold, then warm
      const auto run =
          weft({"slice", model->string(), "-o", "cached.gcode", "-j", threads, "--cache", "cache", "--report", "-"},
               scratch.path());
      INFO(run.err);
      REQUIRE(run.status == 0);
      CHECK(json::parse(run.out)["gcode_sha256"] == first);
    }
    CHECK(weft({"verify", "out.gcode", model->string()}, scratch.path()).status == 0);
  }
}

TEST_CASE("corpus: gyroid curves through a corner of the outline do not lose count of their ends", "[corpus]") {
  const auto model = corpus("models/fandisk.stl");
  if (!model) return;
  Scratch scratch;
  for (const auto* height : {"0.32", "0.3", "0.28"}) {
    const auto run = weft({"slice", model->string(), "-o", "out.gcode", "-s", "layer_height=" + std::string(height),
                           "-s", "infill_pattern=gyroid", "-s", "infill_sparse_density=10"},
                          scratch.path());
    INFO(run.err);
    CHECK(run.status == 0);
  }
}
