// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures and grids that infill is laid by are inputs like models: never written, never passed over.
#include "cli/program.h"

#include <filesystem>

#include <catch2/catch.hpp>

using Catch::Matchers::Contains;

namespace {

/// A grey picture of 2 × 2 in text.
std::string picture(int left, int right) {
  const auto row = std::to_string(left) + " " + std::to_string(right) + "\n";
  return "P2\n2 2\n255\n" + row + row;
}

struct Desk {
  Scratch scratch;
  Desk() {
    scratch.write("part.stl", box_stl(20, 20, 3));
    scratch.write("grey.pgm", picture(40, 40));
    scratch.write("grey.ini", "infill_density_image = grey.pgm\n");
  }
  std::string gcode(const std::string& name) const {  // without its header
    const auto text = scratch.read(name);
    return text.substr(std::min(text.find("\n;LAYER_CHANGE"), text.size()));
  }
};

}  // namespace

TEST_CASE("field files: no result is written over one, whichever way it is named") {
  const Desk desk;
  const std::vector<std::vector<std::string>> ways{{"-s", "infill_density_image=grey.pgm"},
                                                   {"--infill-density-image", "grey.pgm"},
                                                   {"-p", "grey.ini"},
                                                   {"--for", "part", "infill_density_image=grey.pgm"},
                                                   {"--modifier", "box:0,0,0,5,5,2", "infill_density_image=grey.pgm"}};
  for (const auto& way : ways)
    for (const std::string option : {"-o", "--report", "--preview"}) {
      std::vector<std::string> words{"slice", "part.stl"};
      words.insert(words.end(), way.begin(), way.end());
      CAPTURE(way, option);
      desk.scratch.write("grey.png", desk.scratch.read("grey.pgm"));  // a preview is of that name; content tells
      for (auto& word : words)
        if (option == "--preview")
          if (const auto at = word.find("grey.pgm"); at != std::string::npos) word.replace(at, 8, "grey.png");
      desk.scratch.write("grey.ini", option == "--preview" ? "infill_density_image = grey.png\n"
                                                           : "infill_density_image = grey.pgm\n");
      words.insert(words.end(), {option, option == "--preview" ? "./grey.png" : "./grey.pgm"});
      if (option != "-o") words.insert(words.end(), {"-o", "part.gcode"});
      const auto run = weft(words, desk.scratch.path());
      CHECK(run.status == 2);
      CHECK_THAT(run.err, Contains("would be lost; name another file"));
      CHECK(desk.scratch.read("grey.pgm") == picture(40, 40));
      CHECK(desk.scratch.read("grey.png") == picture(40, 40));
      CHECK(!desk.scratch.has("part.gcode"));
    }
}

TEST_CASE("field files: a batch writes over none, and finds them beside its list") {
  const Desk desk;
  std::filesystem::create_directory(desk.scratch.path() / "orders");
  desk.scratch.write("orders/dots.pgm", picture(200, 20));
  desk.scratch.write("orders/list.jsonl", R"({"models": ["../part.stl"], "output": "dots.pgm",)"
                                          R"( "set": {"infill_density_image": "dots.pgm"}})"
                                          "\n");
  const auto lost = weft({"batch", "orders/list.jsonl", "-o", "orders"}, desk.scratch.path());
  CHECK(lost.status == 2);
  CHECK_THAT(lost.err, Contains("would be lost; name another file"));
  CHECK(desk.scratch.read("orders/dots.pgm") == picture(200, 20));

  REQUIRE(weft({"slice", "part.stl", "-s", "infill_density_image=orders/dots.pgm", "-o", "one.gcode", "-q"},
               desk.scratch.path())
              .status == 0);
  desk.scratch.write("orders/list.csv", "models,infill_density_image,output\n../part.stl,dots.pgm,csv.gcode\n");
  desk.scratch.write(
      "orders/list.jsonl",
      R"({"models": ["../part.stl"], "output": "a.gcode", "set": {"infill_density_image": "dots.pgm"}})"
      "\n"
      R"({"models": [{"file": "../part.stl", "set": {"infill_density_image": "dots.pgm"}}], "output": "b.gcode"})"
      "\n");
  for (const std::string list : {"orders/list.csv", "orders/list.jsonl"})
    REQUIRE(weft({"batch", list, "-o", "out", "-q"}, desk.scratch.path()).status == 0);
  for (const std::string made : {"out/csv.gcode", "out/a.gcode"}) CHECK((desk.gcode(made) == desk.gcode("one.gcode")));
}

TEST_CASE("field files: a job is made again when what its infill is laid by has changed") {
  const Desk desk;
  desk.scratch.write("list.jsonl",
                     R"({"id": "plate", "models": ["part.stl"], "set": {"infill_density_image": "grey.pgm"}})"
                     "\n"
                     R"({"id": "one", "models": [{"file": "part.stl", "set": {"infill_density_image": "grey.pgm"}}]})"
                     "\n"
                     R"({"id": "none", "models": ["part.stl"]})"
                     "\n");
  const std::vector<std::string> words{"batch", "list.jsonl", "-o", "out"};
  REQUIRE(weft(words, desk.scratch.path()).status == 0);
  CHECK_THAT(weft(words, desk.scratch.path()).err, Contains("0 made, 3 unchanged"));
  const auto before = desk.gcode("out/plate.gcode");
  desk.scratch.write("grey.pgm", picture(220, 20));
  CHECK_THAT(weft(words, desk.scratch.path()).err, Contains("2 made, 1 unchanged"));
  CHECK((desk.gcode("out/plate.gcode") != before));
}

TEST_CASE("field files: they are bounded to the folder of profiles like what names them") {
  const Desk desk;
  std::filesystem::create_directory(desk.scratch.path() / "root");
  desk.scratch.write("root/sly.ini", "infill_density_image = ../grey.pgm\n");
  desk.scratch.write("list.jsonl", R"({"models": ["part.stl"], "set": {"infill_density_image": "grey.pgm"}})"
                                   "\n");
  const std::string slice = "$WEFT slice part.stl --profile-root root -o a.gcode ";
  for (const std::string& script : {slice + "-p root/sly.ini", slice + "-s infill_density_image=grey.pgm",
                                    slice + "--for part infill_density_image=none.pgm",
                                    std::string("$WEFT batch list.jsonl --profile-root root -o out")}) {
    CAPTURE(script);
    const auto run = shell(script, desk.scratch.path());
    CHECK(run.status == 6);
    CHECK_THAT(run.err, Contains("grey.pgm: lies outside the folder") || Contains("none.pgm: lies outside the folder"));
  }
  CHECK(!desk.scratch.has("a.gcode"));
}

TEST_CASE("field files: what was made by another picture does not verify, and that is said") {
  const Desk desk;
  REQUIRE(weft({"slice", "part.stl", "-s", "infill_density_image=grey.pgm", "-o", "a.gcode", "-q"}, desk.scratch.path())
              .status == 0);
  CHECK(weft({"verify", "a.gcode", "part.stl"}, desk.scratch.path()).status == 0);
  desk.scratch.write("grey.pgm", picture(220, 20));
  const auto run = weft({"verify", "a.gcode", "part.stl"}, desk.scratch.path());
  CHECK(run.status == 3);
  CHECK_THAT(run.err, Contains("grey.pgm: is not the infill_density_image that a.gcode was made of"));
}
