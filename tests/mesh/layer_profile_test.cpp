// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/layer_profile.h"

#include "core/error.h"

#include <string>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::mesh;

namespace {
std::string problem(const std::string& text) {
  try {
    (void)layer_profiles(text, "a.3mf");
  } catch (const Error& e) {
    CHECK(e.kind() == Error::Kind::model);
    const std::string what = e.what();
    return what.substr(0, what.find("; export"));
  }
  return "nothing was thrown";
}
}  // namespace

TEST_CASE("layer profiles: a line an object, pairs of z and height") {
  const auto profiles =
      layer_profiles("object_id=1|0;0.2;0.2;0.2;10.5;0.07\r\nobject_id=3|0;0.1;5;0.3;\nsomething else\n", "a.3mf");
  REQUIRE(profiles.size() == 2);
  CHECK(profiles.at(1) == std::vector<HeightAt>{{0, 200}, {200, 200}, {10'500, 70}});
  CHECK(profiles.at(3).back() == HeightAt{5'000, 300});
  CHECK(layer_profiles("", "a.3mf").empty());
}

TEST_CASE("layer profiles: what makes none is said with its object") {
  CHECK(problem("object_id=2|0;0.2;3.4;0.2;3.2;0.2") ==
        "a.3mf: layer heights of object 2: z 3.2 mm after 3.4 mm; they must ascend");
  CHECK(problem("object_id=1|0;0.2;x;0.2") == "a.3mf: layer heights of object 1: 'x' is no number");
  CHECK(problem("object_id=1|0;0.2;3") == "a.3mf: layer heights of object 1: they are pairs of z and height");
  CHECK(problem("object_id=1|0;9") == "a.3mf: layer heights of object 1: 9 mm at z 0 mm is outside 0.02 … 2 mm");
  CHECK(problem("object_id=1|0;nan") == "a.3mf: layer heights of object 1: 'nan' is no number");
  CHECK(problem("object_id=1|1e30;0.2") == "a.3mf: layer heights of object 1: z 1e+30 mm is beyond 16 m");
}
