// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/program.h"

#include <catch2/catch.hpp>

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

constexpr const char* two_layers =
    "G28\nM83\n;LAYER_CHANGE\n;Z:0.2\n;HEIGHT:0.2\nG1 Z0.2 F600\n;TYPE:External perimeter\nG1 X10 Y10 F9000\nG1 X30 "
    "Y10 E0.8 F1800\n"
    ";LAYER_CHANGE\n;Z:0.4\n;HEIGHT:0.2\nG1 Z0.4\n;TYPE:Perimeter\nG1 X10 Y20\nG1 X230 Y20 E8\n";

}  // namespace

TEST_CASE("weft preview: the extension tells the kind of picture") {
  const Scratch scratch;
  scratch.write("part.gcode", two_layers);
  for (const auto& [name, start] : {std::pair{"p.svg", "<svg "}, {"p.png", "\x89PNG"}, {"p.html", "<!doctype html>"}}) {
    const auto run = weft({"preview", "part.gcode", "-o", name}, scratch.path());
    INFO(run.err);
    CHECK(run.status == 0);
    CHECK(run.out.empty());
    CHECK_THAT(scratch.read(name), StartsWith(start));
  }
}

TEST_CASE("weft preview: layers are counted from 0, and from the end with a minus") {
  const Scratch scratch;
  scratch.write("part.gcode", two_layers);
  REQUIRE(weft({"preview", "part.gcode", "-o", "first.svg", "--layer", "0"}, scratch.path()).status == 0);
  REQUIRE(weft({"preview", "part.gcode", "-o", "last.svg", "--layer", "-1"}, scratch.path()).status == 0);
  CHECK_THAT(scratch.read("first.svg"), Contains("outer wall") && !Contains("inner wall"));
  CHECK_THAT(scratch.read("last.svg"), Contains("inner wall") && !Contains("outer wall"));
}

TEST_CASE("weft preview: --audit shows the machine and counts what is outside") {
  const Scratch scratch;
  scratch.write("part.gcode", two_layers);
  const auto run = weft({"preview", "part.gcode", "-o", "p.svg", "--layer", "1", "--audit", "--machine-width", "200"},
                        scratch.path());
  CHECK(run.status == 0);
  CHECK_THAT(run.err, Contains("outside"));
  CHECK_THAT(scratch.read("p.svg"), Contains(">outside</text>"));
}

TEST_CASE("weft preview: wrong use and files that cannot be shown") {
  const Scratch scratch;
  scratch.write("part.gcode", two_layers);
  scratch.write("none.gcode", "");
  struct Case {
    std::vector<std::string> words;
    int status;
    std::string said;
  };
  const std::vector<Case> cases{
      {{"preview", "part.gcode"}, 2, "no output"},
      {{"preview", "-o", "p.png"}, 2, "one G-code file"},
      {{"preview", "part.gcode", "-o", "p.jpg"}, 2, "neither .html nor .svg nor .png"},
      {{"preview", "part.gcode", "-o", "p.png", "--layer", "2"}, 2, "layers 0 … 1"},
      {{"preview", "part.gcode", "-o", "p.png", "--colour", "taste"}, 2, "'taste'"},
      {{"preview", "part.gcode", "-o", "p.png", "--size", "1"}, 2, "--size"},
      {{"preview", "part.gcode", "-o", "p.png", "--window", "5x5,5x9"}, 2, "--window"},
      {{"preview", "gone.gcode", "-o", "p.png"}, 6, "gone.gcode"},
      {{"preview", "none.gcode", "-o", "p.png"}, 6, "no motion"},
      {{"preview", "part.gcode", "-o", "nowhere/p.png"}, 6, "nowhere"},
  };
  for (const auto& c : cases) {
    const auto run = weft(c.words, scratch.path());
    INFO(c.said << ": " << run.err);
    CHECK(run.status == c.status);
    CHECK_THAT(run.err, StartsWith("weft: error: ") && Contains(c.said));
    CHECK(run.out.empty());
    CHECK_FALSE(scratch.has("p.png"));
  }
}

TEST_CASE("weft slice: --preview draws the very file it writes, and another extension is refused before any work") {
  const Scratch scratch;
  scratch.write("box.stl", box_stl(20, 20, 2));
  const auto run = weft({"slice", "box.stl", "-o", "box.gcode", "--preview", "box.svg"}, scratch.path());
  INFO(run.err);
  REQUIRE(run.status == 0);
  REQUIRE(weft({"preview", "box.gcode", "-o", "again.svg"}, scratch.path()).status == 0);
  auto body = [&](const char* name) {  // all but the title
    const auto text = scratch.read(name);
    return text.substr(0, text.find("<text"));
  };
  CHECK(body("box.svg") == body("again.svg"));
  CHECK(weft({"slice", "box.stl", "-o", "none.gcode", "--preview", "box.jpg"}, scratch.path()).status == 2);
  CHECK_FALSE(scratch.has("none.gcode"));
}
