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

TEST_CASE("examples: objects one after the other, of a tool each, change it once between them") {
  const fs::path root = tests::source;
  Scratch scratch;
  const auto box = (root / "examples/box.stl").string();
  std::vector<std::string> words{"slice", box, box + "@T1"};
  for (const char* profile : {"profiles/printers/marlin-220.ini", "profiles/materials/pla.ini",
                              "examples/two-filaments.ini", "examples/one-at-a-time.ini"})
    words.insert(words.end(), {"-p", (root / profile).string()});
  words.insert(words.end(), {"-o", "one.gcode", "--report", "one.json"});
  const auto run = weft(words, scratch.path());
  INFO(run.err);
  REQUIRE(run.status == 0);
  const auto report = nlohmann::json::parse(scratch.read("one.json"));
  CHECK(report["tools"][1]["changes"] == 1);
  CHECK(report["layers"].get<int>() > 1.9 * report["height_mm"].get<double>() / 0.2);  // of both objects, each its own
}

TEST_CASE("printers: two filaments pass the audit on each printer that comes with weft") {
  const fs::path root = tests::source;
  Scratch scratch;
  const auto box = (root / "examples/box.stl").string();
  std::size_t passed = 0;
  for (const auto& entry : fs::directory_iterator(root / "profiles/printers")) {
    const auto file = entry.path();
    const auto stem = file.stem().string();
    if (stem.ends_with("-0.25") || stem.ends_with("-0.8")) continue;  // as those without
    INFO(file.filename().string());
    std::vector<std::string> words{"slice", box, box + "@T1"};
    for (const auto& profile : {file, root / "profiles/materials/pla.ini", root / "profiles/quality/draft.ini",
                                root / "examples/two-filaments.ini"})
      words.insert(words.end(), {"-p", profile.string()});
    words.insert(words.end(), {"-s", "thumbnails=", "-s", "skirt_line_count=0", "-o", "two.gcode"});
    const auto run = weft(words, scratch.path());
    INFO(run.err);
    // A printer whose T is a macro must be told where that leaves the nozzle.
    const bool macro = run.status == 5 && run.err.find("opaque: T1") != std::string::npos;
    CHECK((run.status == 0 || macro));
    passed += run.status == 0 ? 1U : 0U;
  }
  CHECK(passed >= 20);
}
