// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/program.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

/// What weft inspect says of the model behind these words.
json facts(const Scratch& scratch, std::vector<std::string> words) {
  words.insert(words.begin(), {"inspect", "--format", "json"});
  const auto run = weft(words, scratch.path());
  INFO(run.err);
  REQUIRE(run.status == 0);
  return json::parse(run.out)[0];
}

json sliced(const Scratch& scratch, std::vector<std::string> words) {
  words.insert(words.begin(), {"slice", "-o", "out.gcode", "--report", "-"});
  const auto run = weft(words, scratch.path());
  INFO(run.err);
  REQUIRE(run.status == 0);
  return json::parse(run.out);
}

}  // namespace

TEST_CASE("transforms: inspect shows what becomes of a model") {
  Scratch scratch;
  scratch.write("box.stl", box_stl(30, 20, 10));
  const auto size = [&](const std::vector<std::string>& words) {
    auto all = words;
    all.push_back("box.stl");
    return facts(scratch, all)["objects"][0]["size"];
  };
  CHECK(size({"--rotate-x", "90"}) == json({30, 10, 20}));
  CHECK(size({"--rotate-y", "-90"}) == json({10, 20, 30}));
  CHECK(size({"--scale", "1,2,0.5"}) == json({30, 40, 5}));
  CHECK(size({"--unit", "cm"}) == json({300, 200, 100}));
  CHECK(size({"--unit", "inch", "--scale", "0.5"}) == json({381, 254, 127}));
  CHECK(size({"--mirror", "x,y"}) == json({30, 20, 10}));
  CHECK(size({"--scale-to-fit", "60,100,100"}) == json({60, 40, 20}));
  CHECK(size({"--rotate-x", "90", "--scale-to-fit", "15,100,100"}) == json({15, 5, 10}));
  CHECK(size({"--orient", "face:1,0,0"}) == json({10, 20, 30}));
  const auto cut = facts(scratch, {"box.stl", "--cut", "4"});
  REQUIRE(cut["objects"].size() == 2);
  CHECK(cut["objects"][0]["size"] == json({30, 20, 4}));
  CHECK(cut["objects"][1]["volume_mm3"].get<double>() == Approx(3600));
  CHECK(cut["transforms"] == json({"cut 4"}));
}

TEST_CASE("transforms: a slice is of the model as it is turned, and the report says so") {
  Scratch scratch;
  scratch.write("box.stl", box_stl(30, 20, 10));
  const auto lying = sliced(scratch, {"box.stl", "--rotate-x", "90", "--rotate", "45"});
  CHECK(lying["layers"] == 100);
  CHECK(lying["models"][0]["transforms"] == json({"rotate_x 90"}));
  const auto plain = sliced(scratch, {"box.stl"});
  CHECK_FALSE(plain["models"][0].contains("transforms"));
  const auto cut = sliced(scratch, {"box.stl", "--cut", "7"});
  CHECK(cut["layers"] == 35);
  CHECK(sliced(scratch, {"box.stl", "--cut", "7", "--cut-keep", "upper"})["layers"] == 15);
}

TEST_CASE("transforms: bodies of a file are placed each by itself, and files as one") {
  Scratch scratch;
  scratch.write("nine.stl", boxes_stl(5, 5, 5, 3, 8));
  scratch.write("box.stl", box_stl(5, 5, 5));
  const auto objects = [&](std::vector<std::string> words) {
    words.insert(words.end(), {"-s", "firmware=klipper", "-s", "gcode_label_objects=firmware"});
    sliced(scratch, words);
    const auto gcode = scratch.read("out.gcode");
    int count = 0;
    for (auto at = gcode.find("EXCLUDE_OBJECT_DEFINE"); at != gcode.npos;
         at = gcode.find("EXCLUDE_OBJECT_DEFINE", at + 1))
      ++count;
    return count;
  };
  CHECK(objects({"nine.stl"}) == 1);
  CHECK(objects({"nine.stl", "--split"}) == 9);
  CHECK(objects({"nine.stl", "--cut", "2"}) == 2);
  CHECK(objects({"nine.stl", "box.stl"}) == 2);
  CHECK(objects({"nine.stl", "box.stl", "--merge"}) == 1);
}

TEST_CASE("transforms: a job's line takes them, and a G-code says how it was made") {
  Scratch scratch;
  scratch.write("box.stl", box_stl(30, 20, 10));
  scratch.write("jobs.jsonl", R"({"id": "a", "models": ["box.stl"], "rotate_x": 90, "scale": [1, 1, 2], "mirror": "x"})"
                              "\n");
  const auto batch = weft({"batch", "jobs.jsonl", "-o", "out"}, scratch.path());
  INFO(batch.err);
  REQUIRE(batch.status == 0);
  const auto gcode = scratch.read("out/a.gcode");
  CHECK_THAT(gcode, Contains("; weft_placement = scale=1,1,2 mirror=x rotate_x=90"));
  sliced(scratch, {"box.stl", "--cut", "7", "--mirror", "y", "--rotate-y", "90", "--scale-to-fit", "20,20,20"});
  const auto again = weft({"verify", "out.gcode"}, scratch.path());
  INFO(again.err);
  CHECK(again.status == 0);
  scratch.write("bad.jsonl", R"({"models": ["box.stl"], "cut_keep": "upper"})"
                             "\n");
  const auto bad = weft({"batch", "bad.jsonl", "-o", "none"}, scratch.path());
  CHECK(bad.status == 2);
  CHECK_THAT(bad.err, Contains("nothing is cut"));
}

TEST_CASE("transforms: nonsense is status 2, names the option and helps") {
  Scratch scratch;
  scratch.write("box.stl", box_stl(30, 20, 10));
  const auto refused = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"slice", "box.stl", "-o", "out.gcode"});
    const auto run = weft(words, scratch.path());
    CHECK(run.status == 2);
    CHECK_FALSE(scratch.has("out.gcode"));
    return run.err;
  };
  CHECK_THAT(refused({"--unit", "yard"}), Contains("--unit: 'yard' is not one of") && Contains("--unit inch"));
  CHECK_THAT(refused({"--mirror", "q"}), Contains("--mirror"));
  CHECK_THAT(refused({"--cut", "10"}), Contains("--cut") && Contains("10.000 mm high"));
  CHECK_THAT(refused({"--cut-keep", "lower"}), Contains("--cut-keep: nothing is cut"));
  CHECK_THAT(refused({"--orient", "face:0,0,0"}), Contains("--orient: 0,0,0 is no direction"));
}
