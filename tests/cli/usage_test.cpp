// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/program.h"

#include <set>
#include <string>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE("command line: help and version are answers on standard output") {
  for (const auto& words : {std::vector<std::string>{"--help"},
                            {"slice", "--help"},
                            {"settings", "-h"},
                            {"inspect", "--help"},
                            {"preview", "--help"}}) {
    const auto run = weft(words);
    CHECK(run.status == 0);
    CHECK_THAT(run.out, Contains("--profile"));
    CHECK(run.err.empty());
  }
  CHECK_THAT(weft({"--version"}).out, StartsWith("weft "));
}

TEST_CASE("command line: wrong use is status 2 and one line that names the option") {
  struct Case {
    std::vector<std::string> words;
    std::string said;
  };
  const std::vector<Case> cases{
      {{"slize", "part.stl"}, "'slize'"},
      {{"slice"}, "no model was given"},
      {{"slice", "part.stl", "-o", "x", "--layer-heigth", "0.2"}, "did you mean --layer-height?"},
      {{"slice", "part.stl", "-o", "x", "--audit", "off"}, "cannot be turned off"},
      {{"slice", "part.stl", "-o", "x", "--center", "1"}, "X,Y"},
      {{"slice", "part.stl", "-o", "x", "--scale", "0"}, "--scale"},
      {{"slice", "part.stl", "-o", "x", "--copies", "0"}, "--copies"},
      {{"slice", "part.stl", "-o", "x", "--center", "1,1", "--keep-position"}, "--keep-position"},
      {{"slice", "part.stl", "-o", "x", "-s", "layer_height"}, "KEY=VALUE"},
      {{"slice", "part.stl", "-o", "x", "-j", "0"}, "--threads"},
      {{"settings", "--format", "xml"}, "--format"},
      {{"settings", "--log-format", "yaml"}, "--log-format"},
  };
  for (const auto& c : cases) {
    const auto run = weft(c.words);
    INFO(run.err);
    CHECK(run.status == 2);
    CHECK(run.out.empty());
    CHECK_THAT(run.err, StartsWith("weft: error: ") && Contains(c.said));
    CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
  }
}

TEST_CASE("command line: weft alone tells its verbs on standard error, and that it was wrong use") {
  const auto run = weft({});
  CHECK(run.status == 2);
  CHECK(run.out.empty());
  CHECK_THAT(run.err, StartsWith("weft: ") && Contains("weft slice") && Contains("--help"));
}

TEST_CASE("command line: every setting is listed with type, range and meaning") {
  const auto run = weft({"settings", "--format", "json"});
  REQUIRE(run.status == 0);
  const auto rows = nlohmann::json::parse(run.out);
  CHECK(rows.size() > 40);
  for (const auto& row : rows) {
    CHECK_FALSE(row["meaning"].get<std::string>().empty());
    CHECK_FALSE(row["type"].get<std::string>().empty());
    static const std::set<std::string> scopes{"machine", "plate", "tool", "object", "layer", "region"};
    CHECK(scopes.count(row["scope"].get<std::string>()) == 1);
  }
  const auto scope_of = [&](const char* key) {
    const auto row = nlohmann::json::parse(weft({"settings", "--format", "json", key}).out);
    return row[0]["scope"].get<std::string>();
  };
  CHECK(scope_of("material_bed_temperature") == "tool");
  CHECK(scope_of("layer_height") == "layer");
  CHECK(scope_of("wall_line_count") == "region");
  CHECK_THAT(weft({"settings", "retraction_amount"}).out, Contains("; tool)"));
  CHECK_THAT(weft({"settings", "retraction_amount", "--format", "markdown"}).out, Contains("| tool |"));
  CHECK_THAT(weft({"settings", "layer_height"}).out, Contains("0.02 … 2 mm"));
  CHECK(weft({"settings", "layer_hight"}).status == 3);
}

TEST_CASE("settings are listed by section, and by how keys begin", "[cli]") {
  const auto keys = [](const std::string& name) {
    std::vector<std::string> out;
    for (const auto& row : nlohmann::json::parse(weft({"settings", "--format", "json", name}).out))
      out.push_back(row["key"]);
    return out;
  };
  const auto everything = nlohmann::json::parse(weft({"settings", "--format", "json"}).out);
  std::vector<std::string> of_section, alike;
  for (const auto& row : everything) {
    const std::string key = row["key"];
    if (row["section"] == "support") of_section.push_back(key);
    if (key.starts_with("wall_")) alike.push_back(key);
  }
  REQUIRE(of_section.size() > 20);
  REQUIRE(alike.size() > 5);
  CHECK(keys("support") == of_section);
  CHECK(keys("wall_*") == alike);
  CHECK(keys("*").size() == everything.size());
  CHECK(weft({"settings", "nothing_*"}).status == 3);
}

TEST_CASE("command line: --explain says where a value comes from and what it shadows") {
  Scratch scratch;
  scratch.write("a.ini", "layer_height = 0.3\n");
  scratch.write("b.ini", "inherits = a.ini\nlayer_height = 0.25\n");
  const auto run =
      weft({"profile", "show", "b.ini", "-s", "layer_height=0.1", "--explain", "layer_height"}, scratch.path());
  CHECK(run.status == 0);
  CHECK_THAT(run.out, Contains("layer_height = 0.1 mm") && Contains("b.ini:2 = 0.25") && Contains("a.ini:1 = 0.3"));
}

TEST_CASE("command line: with --log-format json every message is an object on a line") {
  const auto run = weft({"profile", "check", "/nonexistent.ini", "--log-format", "json"});
  CHECK(run.status == 6);
  const auto line = nlohmann::json::parse(run.err);
  CHECK(line["level"] == "error");
}

TEST_CASE("command line: every setting has a name of its own in every language") {
  const auto rows_in = [](const std::string& language) {
    const auto run = weft({"settings", "--format", "json", "--lang", language});
    REQUIRE(run.status == 0);
    return nlohmann::json::parse(run.out);
  };
  const auto english = rows_in("en");
  for (const std::string language : {"zh_CN", "zh_TW", "ja", "fr"}) {
    const auto rows = rows_in(language);
    REQUIRE(rows.size() == english.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      INFO(language << " " << rows[i]["key"]);
      CHECK_FALSE(rows[i]["label"].get<std::string>().empty());
      CHECK(rows[i]["label"] != english[i]["label"]);
      CHECK_FALSE(rows[i]["scope"].get<std::string>().empty());
    }
  }
  CHECK(rows_in("zh-Hant")[0] == rows_in("zh_TW")[0]);
  CHECK(rows_in("fr_CA.UTF-8") == rows_in("fr"));
  CHECK_THAT(weft({"settings", "--lang", "fr", "wipe"}).out, Contains("Essuyer pendant la rétraction"));
  const auto wrong = weft({"settings", "--lang", "xx"});
  CHECK(wrong.status == 2);
  CHECK_THAT(wrong.err, Contains("'xx'") && Contains("one of en, fr, ja, zh_CN, zh_TW"));
}
