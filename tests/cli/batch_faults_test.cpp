// SPDX-License-Identifier: GPL-3.0-or-later
// What goes wrong in one job of a batch, or around it, is that job's: its neighbours are, byte for byte, what they are
// without it, and what is recorded is true.
#include "cli/program.h"
#include "mesh/zip_fixture.h"
#include "sanitized.h"

#include <filesystem>
#include <sstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

constexpr int sound = 8;

/// Sound jobs of some layers each, and what they make undisturbed, in `ref`.
struct Farm {
  Scratch scratch;
  Farm() {
    std::string list;
    for (int i = 0; i < sound; ++i) {
      const auto name = "s" + std::to_string(i);
      scratch.write(name + ".stl", box_stl(10 + static_cast<float>(i), 10, 12));
      list += R"({"models":[")" + name + ".stl\"]}\n";
    }
    scratch.write("ok.jsonl", list);
    REQUIRE(weft({"batch", "ok.jsonl", "-o", "ref", "-q"}, scratch.path()).status == 0);
  }
  /// The list with a line more in its middle.
  void write_with(const std::string& line) const {
    auto list = scratch.read("ok.jsonl");
    std::size_t at = 0;
    for (int i = 0; i < sound / 2; ++i) at = list.find('\n', at) + 1;
    scratch.write("list.jsonl", list.substr(0, at) + line + "\n" + list.substr(at));
  }
  /// How many sound jobs are in the folder as they are in `ref`.
  int right(const std::string& folder) const {
    int out = 0;
    for (int i = 0; i < sound; ++i) {
      const auto name = "/s" + std::to_string(i) + ".gcode";
      out += scratch.read(folder + name) == scratch.read("ref" + name);
    }
    return out;
  }
  /// Exit statuses that the report tells of jobs that did not go well.
  std::vector<int> failures(const std::string& folder) const {
    std::vector<int> out;
    std::istringstream lines(scratch.read(folder + "/report.jsonl"));
    for (std::string line; std::getline(lines, line);)
      if (const auto status = json::parse(line).value("exit_status", -1); status != 0) out.push_back(status);
    return out;
  }
};

}  // namespace

TEST_CASE("batch: a model that breaks off while it is read fails alone, and its neighbours are whole") {
  const Farm farm;
  // A file that can be opened and not be read.
  farm.write_with(R"({"id":"bad","models":["/proc/self/mem"]})");
  for (int again = 0; again < 8; ++again) {
    std::filesystem::remove_all(farm.scratch.path() / "out");
    const auto run = weft({"batch", "list.jsonl", "-o", "out", "-j", "4"}, farm.scratch.path());
    REQUIRE(run.status == 7);
    CHECK_THAT(run.err, Contains("/proc/self/mem: cannot be read: Input/output error; status 6"));
    CHECK(farm.right("out") == sound);
    CHECK((farm.failures("out") == std::vector{6}));
  }
}

TEST_CASE("batch: a standard error that is full, closed or left changes neither a job nor the status") {
  const Farm farm;
  for (const std::string redirection : {"2> /dev/full", "2>&-", "2>&1 | head -1 > /dev/null; exit ${PIPESTATUS[0]}"}) {
    CAPTURE(redirection);
    for (int again = 0; again < 4; ++again) {
      std::filesystem::remove_all(farm.scratch.path() / "out");
      const auto run =
          shell("$WEFT batch ok.jsonl -o out -j 4 -v --progress always " + redirection, farm.scratch.path());
      CHECK(run.status == 0);
      CHECK(farm.right("out") == sound);
      CHECK(farm.failures("out").empty());
    }
  }
}

TEST_CASE("slice: a standard error that is full, closed or left changes neither the G-code nor the status") {
  const Farm farm;
  for (const std::string redirection : {"2> /dev/full", "2>&-", "2>&1 | true; exit ${PIPESTATUS[0]}"}) {
    CAPTURE(redirection);
    const auto run = shell("$WEFT slice s0.stl -o s0.gcode -v --progress always " + redirection, farm.scratch.path());
    CHECK(run.status == 0);
    CHECK((farm.scratch.read("s0.gcode") == farm.scratch.read("ref/s0.gcode")));
  }
  for (const std::string redirection : {"2> /dev/full", "2>&-"}) {
    CAPTURE(redirection);
    CHECK(shell("$WEFT slice none.stl -o none.gcode " + redirection, farm.scratch.path()).status == 6);
    CHECK(!farm.scratch.has("none.gcode"));
  }
}

TEST_CASE("a standard output that is full or closed is status 6, whatever was to be said there") {
  const Scratch scratch;
  for (const std::string words : {"--version", "--help", "slice --help", "verify --help", "settings layer_height"})
    for (const std::string redirection : {"> /dev/full", ">&-"}) {
      CAPTURE(words, redirection);
      const auto run = shell("$WEFT " + words + " " + redirection, scratch.path());
      CHECK(run.status == 6);
      CHECK_THAT(run.err, Contains("standard output: cannot be written"));
    }
}

TEST_CASE("batch: a model larger than memory fails alone, at once, and says why") {
  const Farm farm;
  farm.scratch.write("huge.obj", "v 0 0 0\n");
  std::filesystem::resize_file(farm.scratch.path() / "huge.obj", std::uintmax_t{1} << 40);  // of which nothing is there
  farm.write_with(R"({"id":"huge","models":["huge.obj"]})");
  const auto run = weft({"batch", "list.jsonl", "-o", "out", "-j", "4"}, farm.scratch.path());
  CHECK(run.status == 7);
  CHECK_THAT(run.err, Contains("huge (list.jsonl:5): stopped: alone it needs more than"));
  CHECK(farm.right("out") == sound);
  CHECK((farm.failures("out") == std::vector{130}));
}

TEST_CASE("batch: a project that is damaged, or asks for what no printer can, fails alone like any model") {
  const Farm farm;
  farm.scratch.write("cut.3mf", std::string("PK\3\4 and no more"));
  std::string config =
      "; generated by PrusaSlicer 2.9.0\n\n; perimeters = 5\n; fill_density = 33%\n"
      "; start_gcode = G28 {no_such_name}\n";
  for (int k = 0; k < 20; ++k) config += "; made_up_" + std::to_string(k) + " = 1\n";  // a real one has hundreds
  farm.scratch.write("odd.3mf", fixtures::three_mf("<model/>", {{"Metadata/Slic3r_PE.config", config}}));
  farm.scratch.write("torn.3mf", fixtures::three_mf("<model/>", {{"Metadata/Slic3r_PE.config", config.substr(0, 50)}}));
  farm.write_with(R"({"id":"cut","models":["cut.3mf"]})"
                  "\n"
                  R"({"id":"odd","models":["odd.3mf"]})"
                  "\n"
                  R"({"id":"torn","models":["torn.3mf"]})");
  for (int again = 0; again < 2; ++again) {  // it is no other at the second run
    const auto run = weft({"batch", "list.jsonl", "-o", "out"}, farm.scratch.path());
    CHECK(run.status == 7);
    CHECK_THAT(run.err, Contains("cut (list.jsonl:5): cut.3mf: damaged archive"));
    CHECK_THAT(run.err, Contains("odd (list.jsonl:6): ") && Contains("no_such_name"));
    CHECK_THAT(run.err, Contains("torn (list.jsonl:7): torn.3mf: its settings cannot be read"));
    CHECK(farm.right("out") == sound);
    CHECK((farm.failures("out") == std::vector{4, 3, 3}));
  }
}

TEST_CASE("batch: what a version recorded that could take part of a print for a whole one is made again") {
  const Farm farm;
  REQUIRE(weft({"batch", "ok.jsonl", "-o", "out", "-q"}, farm.scratch.path()).status == 0);
  for (const auto& entry : std::filesystem::directory_iterator(farm.scratch.path() / "out/.weft/jobs")) {
    const auto name = "out/.weft/jobs/" + entry.path().filename().string();
    auto record = json::parse(farm.scratch.read(name));
    REQUIRE(record["format"] > 1);
    record["format"] = 1;
    farm.scratch.write(name, record.dump());
  }
  const auto run = weft({"batch", "ok.jsonl", "-o", "out"}, farm.scratch.path());
  CHECK(run.status == 0);
  CHECK_THAT(run.err, Contains("8 made, 0 unchanged"));
}
