// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/core_fields.h"

#include <catch2/catch.hpp>

using namespace weft;

namespace {
struct Three {
  int a = 0;
  std::vector<std::string> b;
  Point c;
};
struct None {};
}  // namespace

namespace weft {
template <>
inline constexpr auto fields<Three> = listed(&Three::a, &Three::b, &Three::c);
template <>
inline constexpr auto fields<None> = listed<None>();
}  // namespace weft

TEST_CASE("core: fields are counted, so that one more in the struct than in its list is refused") {
  STATIC_REQUIRE(field_count<Three>() == 3);
  STATIC_REQUIRE(field_count<None>() == 0);
  STATIC_REQUIRE(field_count<Region>() == 2);
  STATIC_REQUIRE(std::tuple_size_v<decltype(fields<Point3>)> == 3);
  STATIC_REQUIRE(HasFields<Three>);
  STATIC_REQUIRE(HasFields<const None>);
  STATIC_REQUIRE_FALSE(HasFields<Box>);
}

TEST_CASE("core: a walk visits every field once, in order, and can write") {
  Three v{7, {"x"}, {3, 4}};
  std::string seen;
  for_each_field(v, [&](auto& field) {
    if constexpr (std::is_same_v<decltype(field), int&>)
      seen += "int ", field = 8;
    else if constexpr (std::is_same_v<decltype(field), Point&>)
      seen += "point";
    else
      seen += "texts ";
  });
  CHECK(seen == "int texts point");
  CHECK(v.a == 8);
}

TEST_CASE("core: values are the same when every field is") {
  const Three a{1, {"b"}, {2, 3}};
  for (const auto& other : {Three{0, {"b"}, {2, 3}}, Three{1, {}, {2, 3}}, Three{1, {"b"}, {2, 4}}})
    CHECK_FALSE(same_fields(a, other));
  CHECK(same_fields(a, Three{1, {"b"}, {2, 3}}));
}
