// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/pattern_list.h"

#include <stdexcept>
#include <string>

#include <catch2/catch.hpp>

using namespace weft;

TEST_CASE("patterns by density: a list from each density on", "[settings]") {
  const auto list = parse_pattern_list(" 0:honeycomb, 30 : grid,70:concentric ");
  REQUIRE(list.size() == 3);
  CHECK(list[0].pattern == InfillPattern::honeycomb);
  CHECK(list[1].density == Approx(0.3));
  CHECK(list[2].pattern == InfillPattern::concentric);
  CHECK(parse_pattern_list("").empty());
  CHECK(parse_pattern_list("  ").empty());
}

TEST_CASE("patterns by density: what is none is said", "[settings]") {
  const auto problem = [](const char* text) {
    try {
      (void)parse_pattern_list(text);
    } catch (const std::invalid_argument& e) {
      return std::string(e.what());
    }
    return std::string("nothing was thrown");
  };
  CHECK(problem("grid") == "'grid' is not %:pattern with 0 … 100 %");
  CHECK(problem("101:grid") == "'101:grid' is not %:pattern with 0 … 100 %");
  CHECK(problem("0:bees") == "'bees' is no pattern");
  CHECK(problem("30:grid, 30:lines") == "30 % is not more than the 30 % before");
  CHECK(problem("0:lightning") == "'lightning' looks at the whole object and cannot be one of several");
}
