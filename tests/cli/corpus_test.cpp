// Real models as a farm slices them: audited, reproducible, and what the file says of itself is true.
#include <nlohmann/json.hpp>

#include <catch2/catch.hpp>

#include "cli/program.h"
#include "corpus.h"

using nlohmann::json;

TEST_CASE("corpus: every model passes the audit, gives the same bytes for any number of threads, and verifies", "[corpus]") {
  for (const auto* name : {"MINI-minda-holder", "MINI-x-carriage", "benchy", "fandisk", "stanford-bunny"}) {
    const auto model = corpus("models/" + std::string(name) + ".stl");
    if (!model) return;
    CAPTURE(name);
    Scratch scratch;
    std::string first;
    for (const auto* threads : {"1", "2", "3", "8"}) {
      const auto run = weft({"slice", model->string(), "-o", "out.gcode", "-j", threads, "--report", "-"}, scratch.path());
      INFO(run.err);
      REQUIRE(run.status == 0);
      const auto report = json::parse(run.out);
      CHECK(report["audit"]["verdict"] == "pass");
      if (first.empty()) first = report["gcode_sha256"];
      CHECK(report["gcode_sha256"] == first);
    }
    CHECK(weft({"verify", "out.gcode", model->string()}, scratch.path()).status == 0);
  }
}
