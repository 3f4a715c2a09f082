// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/program.h"
#include "sanitized.h"

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

/// Three boxes and a list that prints them in four ways, one of which cannot be.
struct Orders {
  Scratch scratch;
  Orders() {
    scratch.write("a.stl", box_stl(10, 10, 4));
    scratch.write("b.stl", box_stl(20, 5, 6));
    scratch.write(
        "jobs.jsonl",
        R"({"id": "one", "models": ["a.stl"]})"
        "\n"
        R"({"id": "two", "models": ["a.stl", "b.stl"], "set": {"layer_height": 0.3, "infill_sparse_density": 50}, "output": "deep/two.gcode"})"
        "\n"
        R"({"id": "three", "models": ["b.stl"], "copies": 3, "rotate": 30})"
        "\n"
        R"({"id": "far", "models": ["b.stl"], "center": [900, 900]})"
        "\n");
  }
  Run batch(std::vector<std::string> more = {}) const {
    std::vector<std::string> words{"batch", "jobs.jsonl", "-o", "out"};
    words.insert(words.end(), more.begin(), more.end());
    return weft(words, scratch.path());
  }
  std::vector<json> reports(const std::string& name = "out/report.jsonl") const {
    std::vector<json> out;
    std::istringstream lines(scratch.read(name));
    for (std::string line; std::getline(lines, line);) out.push_back(json::parse(line));
    return out;
  }
};

/// Two boxes, and between them a plate of islands: much in one layer, more than 100 MB of it.
struct Plates : Orders {
  static constexpr int enough_for_boxes_mb = 30;

  Plates() {
    scratch.write("bed.ini", "machine_width = 400\nmachine_depth = 400\n");
    scratch.write("islands.stl", boxes_stl(0.5F, 0.5F, 0.2F, 200, 1));
    scratch.write("list.jsonl", R"({"id": "one", "models": ["a.stl"]})"
                                "\n"
                                R"({"id": "islands", "models": ["islands.stl"], "profiles": ["bed.ini"]})"
                                "\n"
                                R"({"id": "two", "models": ["b.stl"]})"
                                "\n");
  }
  Run batch(const char* folder, std::vector<std::string> more) const {
    more.insert(more.begin(), {"batch", "list.jsonl", "-o", folder, "-j", "1"});
    return weft(more, scratch.path());
  }
  std::set<std::string> names(const char* folder) const {
    std::set<std::string> out;
    for (const auto& entry : std::filesystem::directory_iterator(scratch.path() / folder))
      out.insert(entry.path().filename().string());
    return out;
  }
  /// What is in the folder `whole`, from a run without limits, stands in the other too.
  void check_made(const std::string& folder, const std::vector<std::string>& ids) const {
    for (const auto& id : ids)
      CHECK((scratch.read(folder + "/" + id + ".gcode") == scratch.read("whole/" + id + ".gcode")));
  }
};

}  // namespace

TEST_CASE("batch: every job is what weft slice makes of it, and one that fails keeps no other from being made") {
  const Orders o;
  const auto run = o.batch();
  INFO(run.err);
  CHECK(run.status == 7);
  CHECK(run.out.empty());
  CHECK_THAT(run.err, Contains("far (jobs.jsonl:4)") && Contains("status 5"));

  REQUIRE(weft({"slice", "a.stl", "-o", "1.gcode"}, o.scratch.path()).status == 0);
  REQUIRE(weft({"slice", "a.stl", "b.stl", "-s", "layer_height=0.3", "-s", "infill_sparse_density=50", "-o", "2.gcode"},
               o.scratch.path())
              .status == 0);
  REQUIRE(weft({"slice", "b.stl", "--copies", "3", "--rotate", "30", "-o", "3.gcode"}, o.scratch.path()).status == 0);
  CHECK(o.scratch.read("out/one.gcode") == o.scratch.read("1.gcode"));
  CHECK(o.scratch.read("out/deep/two.gcode") == o.scratch.read("2.gcode"));
  CHECK(o.scratch.read("out/three.gcode") == o.scratch.read("3.gcode"));
  CHECK_FALSE(o.scratch.has("out/far.gcode"));

  const auto reports = o.reports();
  REQUIRE(reports.size() == 4);
  CHECK(reports[0]["id"] == "one");
  CHECK(reports[0]["status"] == "ok");
  CHECK(reports[0]["layers"] == 20);
  CHECK(reports[3]["exit_status"] == 5);
  CHECK_THAT(o.scratch.read("out/summary.csv"),
             Contains("\ntwo,deep/two.gcode,ok,0,") && Contains(",layer_height,infill_sparse_density\n"));
  CHECK_THAT(o.scratch.read("out/junit.xml"),
             Contains("tests=\"4\" failures=\"1\" errors=\"0\"") && Contains("<failure type=\"exit status 5\""));
}

TEST_CASE("batch: a job that is unchanged and whose G-code is there is not run again") {
  const Orders o;
  o.batch();
  const auto again = [&](std::vector<std::string> more = {}) {
    more.insert(more.end(), {"--report", "run.json"});
    o.batch(more);
    return json::parse(o.scratch.read("run.json"));
  };
  auto run = again();
  CHECK(run["made"] == 0);
  CHECK(run["unchanged"] == 3);
  CHECK(run["failed"] == 1);

  std::ofstream(o.scratch.path() / "out/one.gcode") << "spoiled";
  CHECK(again()["made"] == 1);
  std::filesystem::remove(o.scratch.path() / "out/deep/two.gcode");
  CHECK(again()["made"] == 1);
  o.scratch.write("b.stl", box_stl(20, 5, 7));
  CHECK(again()["made"] == 2);
  CHECK(again({"-s", "wall_line_count=2"})["made"] == 3);
  CHECK(again({"-s", "wall_line_count=2"})["made"] == 0);
}

TEST_CASE("batch: a list with one bad line is refused whole, before the first job") {
  const Orders o;
  o.scratch.write("bad.jsonl", R"({"models": ["a.stl"]})"
                               "\n"
                               R"({"models": ["gone.stl"]})"
                               "\n"
                               R"({"id": "x", "models": ["a.stl"], "set": {"layer_hight": 1}})"
                               "\n");
  const auto run = weft({"batch", "bad.jsonl", "-o", "out"}, o.scratch.path());
  CHECK(run.status == 3);
  CHECK_THAT(run.err, Contains("bad.jsonl:2: gone.stl") &&
                          Contains("bad.jsonl:3: unknown setting 'layer_hight'; did you mean 'layer_height'?"));
  CHECK_FALSE(o.scratch.has("out"));
}

TEST_CASE("batch: models, a folder and a pattern are lists too") {
  const Orders o;
  std::filesystem::create_directory(o.scratch.path() / "parts");
  for (const auto* name : {"parts/x.stl", "parts/y.STL"}) o.scratch.write(name, box_stl(5, 5, 2));
  o.scratch.write("parts/notes.txt", "not a model");
  CHECK(weft({"batch", "parts", "-o", "1"}, o.scratch.path()).status == 0);
  CHECK(o.scratch.has("1/x.gcode"));
  CHECK(o.scratch.has("1/y.gcode"));
  CHECK(weft({"batch", "parts/*.stl", "a.stl", "-o", "2"}, o.scratch.path()).status == 0);
  CHECK(o.scratch.has("2/x.gcode"));
  CHECK(o.scratch.has("2/a.gcode"));
  CHECK_FALSE(o.scratch.has("2/y.gcode"));
  CHECK(weft({"batch", "nothing/*.stl", "-o", "3"}, o.scratch.path()).status == 2);
  o.scratch.write("list.csv", "models,layer_height\na.stl,0.1\nb.stl,\n");
  CHECK(weft({"batch", "list.csv", "-o", "4"}, o.scratch.path()).status == 0);
  CHECK(o.scratch.has("4/b.gcode"));
}

TEST_CASE("batch: shares make together what one run makes, and --collect merges their reports") {
  const Orders o;
  for (const auto* share : {"1/3", "2/3", "3/3"}) o.batch({"--shard", share});
  CHECK(o.scratch.has("out/report-2-of-3.jsonl"));
  const auto collected = o.batch({"--collect"});
  CHECK(collected.status == 7);
  CHECK_THAT(collected.err, Contains("4 jobs: 3 there, 1 failed, 0 not run"));
  CHECK(o.reports().size() == 4);
  std::filesystem::remove(o.scratch.path() / "out/one.gcode");
  CHECK_THAT(o.batch({"--collect"}).err, Contains("2 there, 1 failed, 1 not run"));
  CHECK(o.reports()[0]["status"] == "missing");
}

TEST_CASE("batch: G-code that was changed after it was made is not there for --collect, and is made again") {
  const Orders o;
  o.batch();
  const auto made = o.scratch.read("out/one.gcode");
  std::filesystem::resize_file(o.scratch.path() / "out/one.gcode", made.size() / 2);
  CHECK_THAT(o.batch({"--collect"}).err, Contains("2 there, 1 failed, 1 not run"));
  CHECK(o.reports()[0]["status"] == "missing");
  CHECK_THAT(o.batch().err, Contains("1 made, 2 unchanged"));
  CHECK(o.scratch.read("out/one.gcode") == made);
  // A copy has another stamp, and is looked into.
  std::filesystem::copy_file(o.scratch.path() / "out/one.gcode", o.scratch.path() / "out/copy");
  std::filesystem::rename(o.scratch.path() / "out/copy", o.scratch.path() / "out/one.gcode");
  CHECK_THAT(o.batch({"--collect"}).err, Contains("3 there, 1 failed, 0 not run"));
}

TEST_CASE("batch: a job whose output is named otherwise than the last time is made under its new name") {
  const Orders o;
  o.scratch.write("list.jsonl", R"({"id": "a", "models": ["a.stl"], "output": "old.gcode"})");
  CHECK(weft({"batch", "list.jsonl", "-o", "out"}, o.scratch.path()).status == 0);
  o.scratch.write("list.jsonl", R"({"id": "a", "models": ["a.stl"], "output": "new.gcode"})");
  const auto run = weft({"batch", "list.jsonl", "-o", "out"}, o.scratch.path());
  CHECK(run.status == 0);
  CHECK_THAT(run.err, Contains("1 made, 0 unchanged"));
  CHECK(o.scratch.read("out/new.gcode") == o.scratch.read("out/old.gcode"));
}

TEST_CASE("batch: a scheduler's environment tells the share") {
  const Orders o;
  ::setenv("CI_NODE_INDEX", "2", 1);
  ::setenv("CI_NODE_TOTAL", "3", 1);
  const auto run = o.batch();
  const auto all = o.batch({"--shard", "1/1"});
  ::unsetenv("CI_NODE_INDEX");
  ::unsetenv("CI_NODE_TOTAL");
  CHECK_THAT(run.err, Contains("GitLab parallel job: share 2 of 3"));
  CHECK(o.scratch.has("out/report-2-of-3.jsonl"));
  CHECK(o.reports().size() == 4);
}

TEST_CASE(
    "batch: a job that takes longer than it may is stopped, leaves nothing behind, and is made when it may take "
    "longer") {
  const Plates o;
  REQUIRE(o.batch("whole", {}).status == 0);
  // A limit that has passed when a job asks for the first time, on a machine of any speed. That jobs ask all the time,
  // also within a layer, is told by the tests of the pipeline.
  const std::vector<std::string> at_once{"--job-timeout", "1e-9"};
  const auto run = o.batch("out", at_once);
  INFO(run.err);
  CHECK(run.status == 7);
  CHECK_THAT(run.err,
             Contains("islands (list.jsonl:2): stopped after 1e-09 s; give it more with --job-timeout; status 130"));
  const auto reports = o.reports("out/report.jsonl");
  REQUIRE(reports.size() == 3);
  for (const auto& report : reports) {
    CHECK(report["exit_status"] == 130);
    CHECK(report["status"] == "failed");
  }
  CHECK(o.names("out") == std::set<std::string>{".weft", "junit.xml", "report.jsonl", "summary.csv"});
  CHECK(o.batch("out", {}).status == 0);
  o.check_made("out", {"one", "islands", "two"});

  // A sweep's jobs share what they have in common: who waits for a job that is stopped goes on with it.
  std::vector<std::string> words{"sweep", "islands.stl", "-p", "bed.ini", "--vary", "infill_sparse_density=10,20",
                                 "-o",    "swept"};
  words.insert(words.end(), at_once.begin(), at_once.end());
  const auto sweep = weft(words, o.scratch.path());
  INFO(sweep.err);
  CHECK(sweep.status == 7);
  const auto swept = o.reports("swept/report.jsonl");
  REQUIRE(swept.size() == 2);
  for (const auto& report : swept) CHECK(report["exit_status"] == 130);
}

TEST_CASE("batch: a job that is stopped within its only layer keeps no other from being made") {
  if (sanitized) {
    WARN("SKIPPED: sanitizers take more memory than the limit that tells these jobs apart");
    return;
  }
  const Plates o;
  REQUIRE(o.batch("whole", {}).status == 0);
  const auto run = o.batch("out", {"--max-memory", std::to_string(Plates::enough_for_boxes_mb) + "M"});
  INFO(run.err);
  CHECK(run.status == 7);
  CHECK_THAT(run.err, Contains("islands (list.jsonl:2): stopped: alone it needs more than"));
  CHECK(o.reports("out/report.jsonl")[1]["exit_status"] == 130);
  CHECK(o.names("out") ==
        std::set<std::string>{".weft", "junit.xml", "one.gcode", "report.jsonl", "summary.csv", "two.gcode"});
  o.check_made("out", {"one", "two"});
}

TEST_CASE("batch: a signal ends a run within a layer, and what is made stays") {
  const Plates o;
  REQUIRE(o.batch("whole", {}).status == 0);
  // The islands are begun when the one before is there.
  const auto ended = shell(
      "$WEFT batch list.jsonl -o out -j 1 & job=$!; until [ -f out/one.gcode ]; do sleep 0.02; done; kill -TERM $job; "
      "wait $job",
      o.scratch.path());
  INFO(ended.err);
  CHECK(ended.status == 130);
  CHECK_THAT(ended.err, Contains("what is made stays"));
  CHECK(o.reports("out/report.jsonl")[1]["status"] == "missing");
  o.check_made("out", {"one"});
}

TEST_CASE("batch: with --resume what was refused is not tried again") {
  const Orders o;
  o.batch();
  std::filesystem::remove(o.scratch.path() / "out/one.gcode");
  const auto run = o.batch({"--resume", "--log-format", "json"});
  CHECK(run.status == 7);
  CHECK(o.scratch.has("out/one.gcode"));
  std::istringstream lines(run.err);
  for (std::string line; std::getline(lines, line);) CHECK(json::parse(line).contains("level"));
}

TEST_CASE("batch: too little memory for one job fails that job, not the run") {
  const Orders o;
  const auto run = o.batch({"--max-memory", "1M"});
  INFO(run.err);
  CHECK(run.status == 7);
  CHECK_THAT(run.err, Contains("--max-memory"));
}

TEST_CASE("batch: wrong use is status 2") {
  const Orders o;
  for (const auto& more : std::vector<std::vector<std::string>>{
           {"--shard", "4/3"}, {"--shard", "auto/3"}, {"--max-memory", "much"}, {"--job-timeout", "0"}})
    CHECK(o.batch(more).status == 2);
  CHECK(weft({"batch", "-o", "x"}, o.scratch.path()).status == 2);
  CHECK(weft({"batch", "jobs.jsonl"}, o.scratch.path()).status == 2);
  CHECK(weft({"batch", "gone.jsonl", "-o", "x"}, o.scratch.path()).status == 6);
}
