// SPDX-License-Identifier: GPL-3.0-or-later
// No file that is read is written, and none is written twice: whatever the paths are called.
#include "cli/program.h"

#include <filesystem>

#include <catch2/catch.hpp>

using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

struct Desk {
  Scratch scratch;
  std::string model = box_stl(10, 10, 2);
  Desk() {
    scratch.write("part.stl", model);
    scratch.write("base.ini", "layer_height = 0.2\n");
    scratch.write("my.ini", "inherits = base.ini\n");
    scratch.write("plain", "layer_height = 0.3\n");
    scratch.write("old.gcode", "the old one\n");
    fs::create_directory(scratch.path() / "folder");
    fs::create_symlink("part.stl", scratch.path() / "link.gcode");
    fs::create_hard_link(scratch.path() / "part.stl", scratch.path() / "hard.gcode");
    fs::create_symlink("new.json", scratch.path() / "to-come");  // leads to nothing yet
    fs::create_symlink("loop", scratch.path() / "loop");
  }
  /// Wrong use, that says so, and all is as it was.
  void refuses(std::vector<std::string> words, const std::string& message) const {
    CAPTURE(words, message);
    const auto before = scratch.names();
    const auto run = weft(words, scratch.path());
    CHECK(run.status == 2);
    CHECK_THAT(run.err, Contains(message));
    CHECK((scratch.read("part.stl") == model));
    CHECK(scratch.read("my.ini") == "inherits = base.ini\n");
    CHECK(scratch.read("base.ini") == "layer_height = 0.2\n");
    CHECK(scratch.read("plain") == "layer_height = 0.3\n");
    CHECK(scratch.read("old.gcode") == "the old one\n");
    CHECK(scratch.names() == before);
  }
};

}  // namespace

TEST_CASE("outputs: what a slice reads it never writes") {
  const Desk desk;
  const std::string absolute = (desk.scratch.path() / "folder/../part.stl").string();
  desk.refuses({"slice", "part.stl", "-o", "part.stl"}, "-o: part.stl is named like a model");
  desk.refuses({"slice", "part.stl", "-o", "new.STL"}, "-o: new.STL is named like a model");
  desk.refuses({"slice", "part.stl", "-o", "new.3mf"}, "-o: new.3mf is named like a model");
  desk.refuses({"slice", "part.stl", "-p", "my.ini", "-o", "my.ini"}, "-o: my.ini is named like a profile");
  desk.refuses({"slice", "part.stl", "-o", "out.gcode", "--report", "my.ini"},
               "--report: my.ini is named like a profile");
  desk.refuses({"slice", "part.stl", "-o", "link.gcode"}, "-o: link.gcode is the file part.stl, which is read");
  desk.refuses({"slice", "part.stl", "-o", "hard.gcode"}, "-o: hard.gcode is the file part.stl, which is read");
  desk.refuses({"slice", absolute, "-o", "./folder/../link.gcode"}, "which is read and would be lost");
  desk.refuses({"slice", "part.stl", "-p", "plain", "-o", "plain"}, "-o: plain is read, and would be lost");
  desk.scratch.write("child.ini", "inherits = plain\n");
  desk.refuses({"slice", "part.stl", "-p", "child.ini", "-o", "plain"}, "-o: plain is read, and would be lost");
  desk.scratch.write("tool.ini", "extruders_enabled_count = 2\n[tool 1]\ninherits = plain\n");
  desk.refuses({"slice", "part.stl", "-p", "tool.ini", "-o", "plain"}, "-o: plain is read, and would be lost");
  desk.refuses({"slice", "part.stl", "--tool", "0=plain", "-o", "plain"}, "-o: plain is read, and would be lost");
  desk.refuses({"slice", "part.stl", "-o", "out.gcode", "--report", "link.gcode"},
               "--report: link.gcode is the file part.stl");
  desk.refuses({"slice", "part.stl", "-o", "out.gcode", "--preview", "part.stl"},
               "--preview: part.stl is named like a model");
}

TEST_CASE("outputs: no file is written twice, be it there or not") {
  const Desk desk;
  desk.refuses({"slice", "part.stl", "-o", "x", "--report", "x"}, "--report: x is the file of -o x");
  desk.refuses({"slice", "part.stl", "-o", "x.html", "--preview", "x.html"},
               "--preview: x.html is the file of -o x.html");
  desk.refuses({"slice", "part.stl", "-o", "old.gcode", "--report", "folder/../old.gcode"},
               "is the file of -o old.gcode");
  desk.refuses({"slice", "part.stl", "-o", "new.json", "--report", "to-come"},
               "--report: to-come is the file of -o new.json");
  desk.refuses({"slice", "part.stl", "-o", "-", "--report", "/dev/stdout"},
               "--report: /dev/stdout is the file of -o standard output");
  const auto into = shell("$WEFT slice part.stl -o - >> part.stl", desk.scratch.path());
  CHECK(into.status == 2);
  CHECK((desk.scratch.read("part.stl") == desk.model));
}

TEST_CASE("outputs: every verb keeps what it reads") {
  const Desk desk;
  REQUIRE(weft({"slice", "part.stl", "-o", "good.gcode"}, desk.scratch.path()).status == 0);
  desk.refuses({"audit", "good.gcode", "--report", "good.gcode"}, "--report: good.gcode is read");
  desk.refuses({"verify", "good.gcode", "part.stl", "--report", "link.gcode"}, "is the file part.stl, which is read");
  desk.refuses({"inspect", "part.stl", "--report", "hard.gcode"}, "is the file part.stl, which is read");
  desk.refuses({"inspect", "part.stl", "-o", "hard.gcode"}, "is the file part.stl, which is read");
  desk.refuses({"profile", "show", "my.ini", "-o", "my.ini"}, "-o: my.ini is read");
  desk.refuses({"profile", "show", "my.ini", "-o", "base.ini"}, "-o: base.ini is read");
  desk.refuses({"profile", "diff", "my.ini", "base.ini", "-o", "base.ini"}, "-o: base.ini is read");
  desk.refuses({"settings", "--report", "new.ini"}, "named like a profile");
  fs::copy_file(desk.scratch.path() / "good.gcode", desk.scratch.path() / "good.svg");
  desk.refuses({"preview", "good.svg", "-o", "good.svg"}, "-o: good.svg is read");
  CHECK(weft({"profile", "show", "my.ini", "-o", "new.ini"}, desk.scratch.path()).status == 0);
}

TEST_CASE("outputs: a batch writes no file that one of its jobs reads") {
  const Desk desk;
  desk.scratch.write("jobs", R"({"models": ["part.stl"], "output": "part.stl"})"
                             "\n");
  desk.refuses({"batch", "jobs", "-o", "."}, "jobs:1: output ./part.stl is named like a model");
  desk.scratch.write("jobs", R"({"models": ["part.stl"], "profiles": ["plain"], "output": "a.gcode"})"
                             "\n"
                             R"({"models": ["part.stl"], "output": "plain"})"
                             "\n");
  desk.refuses({"batch", "jobs", "-o", "."}, "jobs:2: output ./plain is the file plain, which is read");
  desk.scratch.write("jobs", R"({"models": ["part.stl"], "output": "jobs"})"
                             "\n");
  desk.refuses({"batch", "jobs", "-o", "."}, "jobs:1: output ./jobs is the file jobs, which is read");
  desk.scratch.write("jobs", R"({"models": ["part.stl"], "output": "hard.gcode"})"
                             "\n");
  desk.refuses({"batch", "jobs", "-o", "."}, "jobs:1: output ./hard.gcode is the file part.stl, which is read");
  desk.refuses({"batch", "jobs", "-o", "results", "--report", "jobs"}, "--report: jobs is read");
}

TEST_CASE("outputs: what cannot be resolved leaves a report over no file that might have been read") {
  const Scratch scratch;
  scratch.write("part.stl", box_stl(10, 10, 0.4F));
  scratch.write("child.ini", "inherits = base\n");
  scratch.write("base", "no_such_key = 1\n");
  for (const std::string verb : {"slice", "estimate"}) {
    CAPTURE(verb);
    CHECK(weft({verb, "part.stl", "-p", "child.ini", "--report", "base"}, scratch.path()).status == 3);
    CHECK(scratch.read("base") == "no_such_key = 1\n");
    scratch.write("old.json", "{\"status\": \"ok\"}\n");  // an earlier report
    for (const std::string report : {"old.json", "new.json"}) {
      CHECK(weft({verb, "part.stl", "-p", "child.ini", "--report", report}, scratch.path()).status == 3);
      CHECK_THAT(scratch.read(report), Contains("no_such_key"));
    }
    std::filesystem::remove(scratch.path() / "new.json");
  }
}

TEST_CASE("outputs: the reports of a run are written over none of its files, its list included") {
  Scratch scratch;
  scratch.write("part.stl", box_stl(10, 10, 0.4F));
  const std::string list = R"({"models": ["part.stl"]})"
                           "\n";
  const std::string table = "models\npart.stl\n", profile = "layer_height = 0.2\n";
  scratch.write("report.jsonl", list);
  scratch.write("report-a.jsonl", list);
  scratch.write("summary.csv", table);
  scratch.write("junit.xml", profile);
  const std::vector<std::vector<std::string>> runs{
      {"batch", "report.jsonl", "-o", "."},
      {"batch", "report-a.jsonl", "-o", "./", "--name", "a"},
      {"batch", "summary.csv", "-o", "."},
      {"batch", "summary.csv", "-o", ".", "--collect"},
      {"batch", "part.stl", "-p", "junit.xml", "-o", "."},
      {"sweep", "part.stl", "-p", "junit.xml", "--vary", "layer_height=0.1,0.2", "-o", "."},
      {"batch", "part.stl", "-o", "out", "--report", "out/summary.csv"}};
  std::filesystem::create_directory(scratch.path() / "out");
  for (const auto& words : runs) {
    CAPTURE(words);
    const auto run = weft(words, scratch.path());
    CHECK(run.status == 2);
    CHECK_THAT(run.err, Contains("would be lost") || Contains("is the file of"));
    CHECK(!scratch.has("part.gcode"));
  }
  CHECK(scratch.read("report.jsonl") == list);
  CHECK(scratch.read("report-a.jsonl") == list);
  CHECK(scratch.read("summary.csv") == table);
  CHECK(scratch.read("junit.xml") == profile);
}

TEST_CASE("outputs: devices take any number of results") {
  const Desk desk;
  CHECK(weft({"slice", "part.stl", "-o", "/dev/null", "--report", "/dev/null"}, desk.scratch.path()).status == 0);
}

TEST_CASE("outputs: a name that the settings give the result is no file that is read either") {
  const Scratch scratch;
  scratch.write("part.stl", box_stl(10, 10, 2));
  const auto before = scratch.read("part.stl");
  for (const std::string name : {"part.stl", "PART.STL", "my.ini"}) {
    const auto run = weft({"slice", "part.stl", "-s", "output_filename_format=" + name}, scratch.path());
    CHECK(run.status == 2);
    CHECK_THAT(run.err, Contains("output_filename_format: "));
  }
  scratch.write("raw", before);
  CHECK(weft({"slice", "raw", "-s", "output_filename_format=raw"}, scratch.path()).status == 2);
  CHECK((scratch.read("raw") == before));
  CHECK((scratch.read("part.stl") == before));
}
