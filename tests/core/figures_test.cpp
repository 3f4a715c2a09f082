// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/figures.h"

#include <catch2/catch.hpp>

using namespace weft;

TEST_CASE("core: a short duration has its two greatest units") {
  CHECK(short_duration(0) == "0 s");
  CHECK(short_duration(59.4) == "59 s");
  CHECK(short_duration(59.6) == "1m 00s");
  CHECK(short_duration(303) == "5m 03s");
  CHECK(short_duration(3599.7) == "1h 00m");
  CHECK(short_duration(26 * 3600 + 5 * 60 + 59) == "26h 05m");
}

TEST_CASE("core: a figure of a report has three decimals") {
  CHECK(rounded3(1.23449) == 1.234);
  CHECK(rounded3(-0.0006) == -0.001);
}
