// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/number.h"

#include "core/disjoint_sets.h"
#include "core/parts.h"

#include <cstdint>
#include <string_view>
#include <vector>

#include <catch2/catch.hpp>

using namespace weft;

TEST_CASE("a number is the whole of a text, or there is none", "[number]") {
  CHECK(as_number<int>("-12") == -12);
  CHECK(as_number<unsigned>("7") == 7U);
  CHECK(as_number<double>("2.5e1") == 25.0);
  CHECK(as_number<std::uint32_t>("fF8000", 16) == 0xff8000U);
  for (const std::string_view text : {"", " 1", "1 ", "+1", "1,5", "0x10", "one"}) {
    CAPTURE(text);
    CHECK_FALSE(as_number<int>(text));
    CHECK_FALSE(as_number<double>(text));
  }
  CHECK_FALSE(as_number<int>("1.0"));
  CHECK_FALSE(as_number<unsigned>("-1"));
  CHECK_FALSE(as_number<std::int8_t>("128"));
  CHECK_FALSE(as_number<double>("1e999"));
  CHECK_FALSE(as_number<int>("12", 2));
}

TEST_CASE("a text has one part more than separators", "[number]") {
  using Parts = std::vector<std::string_view>;
  CHECK(parts("a,b,c", ',') == Parts{"a", "b", "c"});
  CHECK(parts(" a , ,b", ',') == Parts{" a ", " ", "b"});
  CHECK(parts("", ';') == Parts{""});
  CHECK(parts(";", ';') == Parts{"", ""});
  CHECK(parts("a,b", ';') == Parts{"a,b"});
}

TEST_CASE("joined numbers are one set, named by its least", "[number]") {
  DisjointSets sets(6);
  CHECK(sets.of(5) == 5);
  sets.join(5, 3);
  sets.join(4, 1);
  CHECK(sets.of(5) == 3);
  CHECK(sets.of(4) == 1);
  sets.join(3, 4);
  for (const std::size_t i : {1U, 3U, 4U, 5U}) CHECK(sets.of(i) == 1);
  CHECK(sets.of(0) == 0);
  CHECK(sets.of(2) == 2);
}
