// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/modifier_list.h"

#include <stdexcept>
#include <string>

#include <catch2/catch.hpp>

using namespace weft;

TEST_CASE("meshes with an infill of their own: a list of files, densities and patterns", "[settings]") {
  const auto list = parse_modifier_list(" boss.stl:80, a b/c:d.stl : 5 :gyroid ");
  REQUIRE(list.size() == 2);
  CHECK(list[0].file == "boss.stl");
  CHECK(list[0].density_percent == "80");
  CHECK(list[0].pattern.empty());
  CHECK(list[1].file == "a b/c:d.stl");
  CHECK(list[1].density_percent == "5");
  CHECK(list[1].pattern == "gyroid");
  CHECK(text_of(list) == "boss.stl:80, a b/c:d.stl:5:gyroid");
  CHECK(parse_modifier_list(" ").empty());
}

TEST_CASE("meshes with an infill of their own: what is none is said", "[settings]") {
  const auto problem = [](const char* text) {
    try {
      (void)parse_modifier_list(text);
    } catch (const std::invalid_argument& e) {
      return std::string(e.what());
    }
    return std::string("nothing was thrown");
  };
  for (const char* text : {"boss.stl", "boss.stl:", ":80", "boss.stl:101", "boss.stl:-1", "boss.stl:nan",
                           "boss.stl:gyroid", "boss.stl:80:bees"})
    CHECK(problem(text) == "'" + std::string(text) + "' is not file:% or file:%:pattern with 0 … 100 %");
}
