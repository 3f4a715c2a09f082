// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/program.h"
#include "source.h"

#include <algorithm>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using Catch::Matchers::Contains;
namespace fs = std::filesystem;

TEST_CASE("printers: the example passes the audit on each printer that comes with weft") {
  const fs::path root = tests::source;
  Scratch scratch;
  std::size_t printers = 0;
  for (const auto& entry : fs::directory_iterator(root / "profiles/printers")) {
    const auto file = entry.path();
    INFO(file.filename().string());
    const auto stem = file.stem().string();
    const std::string nozzle = stem.ends_with("-0.25") ? "-0.25" : stem.ends_with("-0.8") ? "-0.8" : "";
    const auto run = weft({"slice", (root / "examples/box.stl").string(), "-p", file.string(), "-p",
                           (root / "profiles/materials/pla.ini").string(), "-p",
                           (root / ("profiles/quality/standard" + nozzle + ".ini")).string(), "-s", "thumbnails=", "-o",
                           "box.gcode", "--report", "box.json"},
                          scratch.path());
    INFO(run.err);
    CHECK(run.status == 0);
    if (run.status != 0) continue;
    const auto report = nlohmann::json::parse(scratch.read("box.json"));
    CHECK(report["audit"]["verdict"] == "pass");
    CHECK(report["layers"].get<int>() >= 50);
    ++printers;
  }
  CHECK(printers >= 25);
}
