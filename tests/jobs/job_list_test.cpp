// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/job_list.h"

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::jobs;
using Catch::Matchers::Contains;

namespace {
JobList jsonl(std::string_view text) {
  auto list = read_jsonl(text, "orders.jsonl", "orders");
  complete(list);
  return list;
}
JobList csv(std::string_view text) {
  auto list = read_csv(text, "orders.csv", "orders");
  complete(list);
  return list;
}
}  // namespace

TEST_CASE("jobs: a line of JSON is a job, with paths relative to the list") {
  const auto good = jsonl(
      "\xEF\xBB\xBF"
      R"({"id": "a", "models": ["m/part.stl", "/abs.stl"], "profiles": ["p.ini"], "set": {"layer_height": 0.2, "bridges": false}, "center": [10, 20.5], "copies": 3})"
      "\r\n\n"
      R"({"models": ["b.stl"], "output": "deep/b.gcode", "rotate": -45, "scale": "50%", "audit": "annotate"})");
  REQUIRE(good.errors.empty());
  REQUIRE(good.jobs.size() == 2);
  const auto& a = good.jobs[0];
  CHECK(a.where == "orders.jsonl:1");
  CHECK(a.models == std::vector<std::string>{"orders/m/part.stl", "/abs.stl"});
  CHECK(a.profiles == std::vector<std::filesystem::path>{"p.ini"});
  CHECK(a.folder == "orders");
  CHECK(a.settings == std::vector<std::pair<std::string, std::string>>{{"layer_height", "0.2"}, {"bridges", "false"}});
  CHECK(a.output == "a.gcode");
  CHECK(a.placement.centre == Point{10'000, 20'500});
  CHECK(a.placement.copies == 3);
  const auto& b = good.jobs[1];
  CHECK(b.where == "orders.jsonl:3");
  CHECK(b.id == "deep/b");
  CHECK(b.placement.rotate_deg == -45);
  CHECK(b.placement.scale == 0.5);
  CHECK(b.audit == audit::Mode::annotate);
}

TEST_CASE("jobs: everything wrong with a list is told with its line, and nothing is dropped silently") {
  struct Case {
    std::string line, said;
  };
  const std::vector<Case> cases{
      {R"({"models": ["a.stl"], "colour": "red"})", "unknown name 'colour'"},
      {R"({"models": ["a.stl"], "layer_height": 0.2})", "settings belong in \"set\""},
      {R"({"models": ["a.stl"], "models": ["b.stl"]})", "'models' is given twice"},
      {R"({"models": ["a.stl"], "set": {"a": 1, "a": 2}})", "'a' is given twice"},
      {R"({"models": ["a.stl"], "set": [1]})", "not an object"},
      {R"({"models": ["a.stl"], "set": {"a": null}})", "neither text"},
      {R"({"models": []})", "names no model"},
      {R"({"id": "x"})", "names no model"},
      {R"([1])", "not a JSON object"},
      {R"({"models": ["a.stl"])", "not JSON"},
      {R"({"models": ["a.stl"], "copies": 0})", "copies: 0 is outside"},
      {R"({"models": ["a.stl"], "copies": 1.5})", "whole number"},
      {R"({"models": ["a.stl"], "scale": 0})", "factor above 0"},
      {R"({"models": ["a.stl"], "center": [1]})", "center: "},
      {R"({"models": ["a.stl"], "audit": "off"})", "reject, annotate"},
      {R"({"models": ["a.stl"], "output": "../a.gcode"})", "not a file in the folder"},
      {R"({"models": ["a.stl"], "output": "/a.gcode"})", "not a file in the folder"},
      {R"({"models": ["a.stl"], "output": ".weft/a"})", "not a file in the folder"},
      {R"({"models": ["a.stl"], "keep_position": true, "copies": 2})", "contradicts copies"},
      {R"({"models": [""]})", "is empty"},
  };
  for (const auto& c : cases) {
    const auto list = jsonl(R"({"models": ["fine.stl"]})"
                            "\n" +
                            c.line);
    INFO(c.line);
    REQUIRE(list.errors.size() == 1);
    CHECK(list.errors[0].where() == "orders.jsonl:2");
    CHECK_THAT(list.errors[0].problem(), Contains(c.said));
  }
}

TEST_CASE("jobs: two jobs of one id or one output are refused, naming both lines") {
  const auto ids =
      jsonl("{\"models\": [\"x/a.stl\"]}\n{\"models\": [\"y/a.stl\"], \"output\": \"b.gcode\", \"id\": \"a\"}\n");
  REQUIRE(ids.errors.size() == 1);
  CHECK_THAT(ids.errors[0].what(), Contains("orders.jsonl:2") && Contains("orders.jsonl:1"));
  const auto outputs = jsonl(
      "{\"id\": \"a\", \"models\": [\"a.stl\"], \"output\": \"d/../o.gcode\"}\n{\"id\": \"b\", \"models\": "
      "[\"a.stl\"], \"output\": \"o.gcode\"}\n");
  REQUIRE(outputs.errors.size() == 1);
  CHECK_THAT(outputs.errors[0].what(), Contains("output 'o.gcode'"));
}

TEST_CASE("jobs: a CSV has fields and settings as columns") {
  const auto list =
      csv("id,models,profiles,layer_height,machine_start_gcode,center\r\n"
          "a,a.stl;b.stl,p.ini,0.2,\"G28\nM117 \"\"hello, you\"\"\",\"10,20\"\n"
          "\n"
          "b, c.stl ,,,,\n");
  INFO((list.errors.empty() ? "" : list.errors[0].what()));
  REQUIRE(list.errors.empty());
  REQUIRE(list.jobs.size() == 2);
  CHECK(list.jobs[0].models == std::vector<std::string>{"orders/a.stl", "orders/b.stl"});
  CHECK(list.jobs[0].settings == std::vector<std::pair<std::string, std::string>>{
                                     {"layer_height", "0.2"}, {"machine_start_gcode", "G28\nM117 \"hello, you\""}});
  CHECK(list.jobs[0].placement.centre == Point{10'000, 20'000});
  CHECK(list.jobs[1].where == "orders.csv:5");  // a cell and a blank line took two
  CHECK(list.jobs[1].models == std::vector<std::string>{"orders/c.stl"});
  CHECK(list.jobs[1].settings.empty());
}

TEST_CASE("jobs: a CSV with an unknown column, a missing cell or an open quote is refused") {
  CHECK_THROWS_WITH(csv("id,models,layer_heigth\na,a.stl,0.2\n"),
                    Contains("orders.csv:1") && Contains("did you mean 'layer_height'?"));
  CHECK_THROWS_WITH(csv("id,models,id\n"), Contains("given twice"));
  CHECK_THROWS_WITH(csv("id,models\na,\"a.stl\n\n"), Contains("orders.csv:2") && Contains("quote"));
  const auto list = csv("id,models\na,a.stl\nb\n");
  REQUIRE(list.errors.size() == 1);
  CHECK_THAT(list.errors[0].what(), Contains("orders.csv:3") && Contains("1 cells"));
}

TEST_CASE("job lists: free fields are kept as they stand, and a job has a time limit of its own") {
  const auto list = jobs::read_jsonl(
      R"({"id": "a", "models": ["a.stl"], "label": "Grün, 2nd", "priority": 3, "due": "2026-12-01", "x-rush": true, "timeout": 90})"
      "\n"
      R"({"id": "b", "models": ["a.stl"], "x-parts": [1, 2]})"
      "\n"
      R"({"id": "c", "models": ["a.stl"], "timeout": 0})"
      "\n"
      R"({"id": "d", "models": ["a.stl"], "x-": 1})",
      "l.jsonl", {});
  REQUIRE(list.jobs.size() == 1);
  using Fields = std::vector<std::pair<std::string, std::string>>;
  CHECK(list.jobs[0].free_fields ==
        Fields{{"label", "\"Grün, 2nd\""}, {"priority", "3"}, {"due", "\"2026-12-01\""}, {"x-rush", "true"}});
  CHECK(list.jobs[0].timeout_s == 90);
  REQUIRE(list.errors.size() == 3);
  CHECK_THAT(list.errors[0].what(), Contains("x-parts"));
  CHECK_THAT(list.errors[1].what(), Contains("timeout"));
  CHECK_THAT(list.errors[2].what(), Contains("unknown name 'x-'"));
  const auto table = jobs::read_csv("id,models,label,x-rush,timeout\na,a.stl,\"one, two\",,5\n", "l.csv", {});
  REQUIRE(table.errors.empty());
  REQUIRE(table.jobs.size() == 1);
  CHECK(table.jobs[0].free_fields == Fields{{"label", "\"one, two\""}});
  CHECK(table.jobs[0].timeout_s == 5);
}

TEST_CASE("jobs: a line that is nested deeper than it can mean anything is refused with its line") {
  const std::string deep(100'000, '[');
  const auto list = jsonl("{\"models\": [\"a.stl\"]}\n{\"models\": " + deep + "\n");
  REQUIRE(list.errors.size() == 1);
  CHECK(list.errors[0].where() == "orders.jsonl:2");
  CHECK_THAT(list.errors[0].what(), Contains("is more than 64 levels deep"));
  std::string objects;
  for (int i = 0; i < 100'000; ++i) objects += "{\"a\":";
  CHECK_THAT(jsonl(objects).errors.at(0).what(), Contains("64 levels"));
}

TEST_CASE("jobs: a number that no machine holds is refused with its line") {
  const auto list = jsonl(R"({"models": ["a.stl"], "copies": 1e400})");
  REQUIRE(list.errors.size() == 1);
  CHECK_THAT(list.errors[0].what(), Contains("orders.jsonl:1: holds a number that is too large"));
  CHECK(!csv("models,copies\na.stl,1e400\n").errors.empty());
  CHECK(!csv("models,copies\na.stl,-5\n").errors.empty());
}

TEST_CASE("jobs: the cells of a CSV may be separated by semicolons, as spreadsheets do where the comma is decimal") {
  const auto list = csv("id;models;copies\na;x.stl,y.stl;3\n\"b;c\";z.stl;\n");
  REQUIRE(list.errors.empty());
  REQUIRE(list.jobs.size() == 2);
  CHECK(list.jobs[0].models == std::vector<std::string>{"orders/x.stl", "orders/y.stl"});
  CHECK(list.jobs[0].placement.copies == 3);
  CHECK(list.jobs[1].id == "b;c");
}

TEST_CASE("jobs: no output is called like a report of the run") {
  for (const std::string name : {"report.jsonl", "summary.csv", "junit.xml", "./junit.xml", "report-2-of-3.jsonl",
                                 "index.html", "report.jsonl/a.gcode", "x/../index.html/a"}) {
    CAPTURE(name);
    const auto list = jsonl(R"({"models": ["a.stl"], "output": ")" + name + "\"}");
    REQUIRE(list.errors.size() == 1);
    CHECK_THAT(list.errors[0].what(), Contains("is the name of a report"));
  }
  CHECK(jsonl(R"({"models": ["a.stl"], "output": "deep/report.jsonl"})").errors.empty());
}

TEST_CASE("jobs: no output is called like what a killed run leaves, which the next one removes") {
  CHECK_THAT(jsonl(R"({"models": ["a.stl"], "output": "a.gcode.weft-abcdef"})").errors.at(0).what(),
             Contains("is named like a file that is not whole"));
  for (const std::string name : {".weft-abcdef", "a.weft-abcde", "a.weft-abcdefg", "a.weft-abcdef/b"}) {
    CAPTURE(name);
    CHECK(jsonl(R"({"models": ["a.stl"], "output": ")" + name + "\"}").errors.empty());
  }
}

TEST_CASE("jobs: a text with the character 0, at which a system would cut it off, is refused with its line") {
  for (const std::string line :
       {R"({"models": ["a.stl\u0000b"]})", R"({"models": ["a.stl"], "output": "a\u0000b"})",
        R"({"models": ["a.stl"], "id": "a\u0000"})", R"({"models": ["a.stl"], "label": "a\u0000"})",
        R"({"models": ["a.stl"], "set": {"machine_name": "\u0000"}})", R"({"models": [{"file": "a\u0000.stl"}]})"}) {
    CAPTURE(line);
    CHECK_THAT(jsonl(line).errors.at(0).what(), Contains("a text holds the character 0"));
  }
  CHECK_THAT(read_csv(std::string("models,output\na.stl,b\0c\n", 24), "list", {}).errors.at(0).what(),
             Contains("a text holds the character 0"));
}

TEST_CASE("jobs: braces that make more patterns than anyone has models are refused at once") {
  std::string bomb;
  for (int i = 0; i < 40; ++i) bomb += "{a,b}";
  CHECK_THROWS_WITH(read_jobs({bomb}), Contains("its braces make more than 10000 patterns"));
}
