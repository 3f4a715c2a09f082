// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/program.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using Catch::Matchers::Contains;
using nlohmann::json;

TEST_CASE("infill: meshes that a profile names have an infill of their own, and verify knows what they held") {
  Scratch scratch;
  scratch.write("box.stl", box_stl(30, 30, 8));
  scratch.write("core.stl", box_stl(12, 12, 8));
  scratch.write("my.ini", "infill_modifiers = core.stl:80:gyroid\n");
  const auto slice = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"slice", "box.stl", "--report", "-"};
    words.insert(words.end(), more.begin(), more.end());
    const auto run = weft(words, scratch.path());
    INFO(run.err);
    REQUIRE(run.status == 0);
    return json::parse(run.out);
  };
  const auto without = slice({"-o", "without.gcode"}), with = slice({"-p", "my.ini", "-o", "with.gcode"});
  CHECK(with["features"]["infill"]["mm3"].get<double>() > 1.2 * without["features"]["infill"]["mm3"].get<double>());
  REQUIRE(with["infill_files"].size() == 1);
  CHECK(with["infill_files"][0]["key"] == "infill_modifiers");
  const auto verify = [&] { return weft({"verify", "with.gcode"}, scratch.path()); };
  const auto same = verify();
  INFO(same.err);
  CHECK(same.status == 0);
  scratch.write("core.stl", box_stl(13, 12, 8));
  const auto changed = verify();
  CHECK(changed.status == 3);
  CHECK_THAT(changed.err, Contains("is not the infill_modifiers that with.gcode was made of: its sha256 is another"));
}

TEST_CASE("infill: directions that stand still against the part are turned with it") {
  Scratch scratch;
  scratch.write("box.stl", box_stl(30, 30, 4));
  const auto lines = [&](const std::string& frame) {
    const auto run = weft({"slice", "box.stl", "--rotate", "90", "-s", "infill_pattern=aligned", "-s", "infill_angle=0",
                           "-s", "infill_angle_frame=" + frame, "-o", frame + ".gcode"},
                          scratch.path());
    INFO(run.err);
    REQUIRE(run.status == 0);
    return scratch.read(frame + ".gcode");
  };
  CHECK(lines("plate") != lines("part"));
}
