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

TEST_CASE("weft preview: a window beside everything that is printed is told, and where the layer lies") {
  const Scratch scratch;
  scratch.write("part.gcode", two_layers);
  const auto beside =
      weft({"preview", "part.gcode", "-o", "p.png", "--layer", "0", "--window", "500x500,510x510"}, scratch.path());
  CHECK(beside.status == 0);
  CHECK_THAT(beside.err, Contains("--window shows nothing: layer 0 prints from "));
  const auto there = weft({"preview", "part.gcode", "-o", "p.png", "--window", "-999x-999,999x999"}, scratch.path());
  CHECK(there.status == 0);
  CHECK(there.err.empty());
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
      {{"preview", "part.gcode", "-o", "p.png", "--view", "above"}, 2, "'above'"},
      {{"preview", "part.gcode", "-o", "p.png", "--view", "0,0,0"}, 2, "--view"},
      {{"preview", "part.gcode", "-o", "p.png", "--view", "1,2"}, 2, "--view"},
      {{"preview", "part.gcode", "-o", "p.svg", "--view", "iso"}, 2, "--view"},
      {{"preview", "part.gcode", "-o", "p.png", "--layers", "0:1"}, 2, "--layers"},
      {{"preview", "part.gcode", "-o", "p.png", "--view", "iso", "--layers", "1:0"}, 2, "layers 0 … 1"},
      {{"preview", "part.gcode", "-o", "p.png", "--view", "iso", "--layers", "0:2"}, 2, "'0:2'"},
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

TEST_CASE("weft preview: solids are the same picture on one thread and on four, and a range of layers another one") {
  const Scratch scratch;
  scratch.write("part.gcode", two_layers);
  const auto draw = [&](const std::string& name, std::vector<std::string> more) {
    std::vector<std::string> words{"preview", "part.gcode", "-o", name, "--view", "iso", "--size", "200"};
    words.insert(words.end(), more.begin(), more.end());
    const auto run = weft(words, scratch.path());
    INFO(run.err);
    CHECK(run.status == 0);
    return scratch.read(name);
  };
  const auto one = draw("a.png", {"-j", "1"});
  CHECK_THAT(one, StartsWith("\x89PNG"));
  CHECK(one == draw("b.png", {"-j", "4"}));
  CHECK(one == draw("c.png", {"--layers", "0:-1"}));
  CHECK(one != draw("d.png", {"--layers", "0:0"}));
}

TEST_CASE("weft preview: a page takes machine and model from what the file says of itself") {
  const Scratch scratch;
  scratch.write("box.stl", box_stl(20, 20, 2));
  REQUIRE(weft({"slice", "box.stl", "-o", "box.gcode"}, scratch.path()).status == 0);
  REQUIRE(weft({"preview", "box.gcode", "-o", "with.html"}, scratch.path()).status == 0);
  CHECK_THAT(scratch.read("with.html"), Contains("id=\"model-0\"") && Contains("id=\"pack-0\""));
  scratch.write("box.stl", box_stl(21, 20, 2));  // another one by that name is none
  REQUIRE(weft({"preview", "box.gcode", "-o", "without.html"}, scratch.path()).status == 0);
  CHECK_THAT(scratch.read("without.html"), !Contains("id=\"model-0\""));
}

TEST_CASE("weft slice: thumbnails of the toolpaths are other pictures in the same file, whatever the threads") {
  const Scratch scratch;
  scratch.write("box.stl", box_stl(20, 20, 2));
  const auto slice = [&](const char* content, const char* threads) {
    const auto run = weft({"slice", "box.stl", "-s", std::string("thumbnail_content=") + content, "-s",
                           "thumbnails=48x48", "-j", threads, "-o", "box.gcode"},
                          scratch.path());
    INFO(run.err);
    REQUIRE(run.status == 0);
    return scratch.read("box.gcode");
  };
  const auto moves = [](const std::string& text) {
    const auto from = text.find(";LAYER_CHANGE");
    return text.substr(from, 2000);
  };
  const auto model = slice("model", "2"), paths = slice("toolpaths", "2");
  CHECK_THAT(paths, Contains("; thumbnail begin 48x48"));
  const auto picture = [](const std::string& text) {
    const auto from = text.find("; thumbnail begin");
    return text.substr(from, text.find("; thumbnail end") - from);
  };
  CHECK(picture(model) != picture(paths));
  CHECK(moves(model) == moves(paths));
  CHECK(paths == slice("toolpaths", "1"));
}
