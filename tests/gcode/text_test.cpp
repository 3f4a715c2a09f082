// SPDX-License-Identifier: GPL-3.0-or-later
#include "gcode/text.h"

#include "gcode/header.h"
#include "gcode/layer_text.h"

#include <cmath>
#include <cstdlib>
#include <random>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::gcode;

namespace {
std::string mm(Um v) {
  return std::move(Text(4).length(v)).take();
}
std::string filament(std::int64_t v) {
  return std::move(Text(4).filament(v)).take();
}
}  // namespace

TEST_CASE("gcode: numbers are as short as they can be") {
  CHECK(mm(0) == "0");
  CHECK(mm(100 + 200) == ".3");  // 0.1 + 0.2
  CHECK(mm(1) == ".001");
  CHECK(mm(-1) == "-.001");
  CHECK(mm(10) == ".01");
  CHECK(mm(1000) == "1");
  CHECK(mm(-1000) == "-1");
  CHECK(mm(1050) == "1.05");
  CHECK(mm(-12'345) == "-12.345");
  CHECK(mm(220'000) == "220");
  CHECK(mm(max_coord) == "16777.216");
  CHECK(std::move(Text(4).spelled(-50)).take() == "-0.05");
  CHECK(std::move(Text(4).spelled(0)).take() == "0");
  CHECK(std::move(Text(4).spelled(12'300)).take() == "12.3");
  CHECK(filament(0) == "0");
  CHECK(filament(1) == ".00001");
  CHECK(filament(-80'000) == "-.8");
  CHECK(filament(123'456'789) == "1234.56789");
}

TEST_CASE("gcode: a number is read back as it was meant") {
  std::mt19937 random(3);
  std::uniform_int_distribution<Um> any(-max_coord, max_coord);
  for (int i = 0; i < 20'000; ++i) {
    const Um v = any(random);
    CHECK(std::lround(std::strtod(mm(v).c_str(), nullptr) * 1000) == v);
    CHECK(std::llround(std::strtod(filament(v).c_str(), nullptr) * 1e5) == v);
  }
}

TEST_CASE("gcode: speeds are whole mm/min, never more than was asked, never zero") {
  CHECK(feed_of(30) == 1800);
  CHECK(feed_of(0.1 + 0.2) == 18);
  CHECK(feed_of(33.333) == 1999);
  CHECK(feed_of(1e-9) == 1);
}

TEST_CASE("gcode: durations read as PrusaSlicer writes them") {
  CHECK(duration(0) == "0s");
  CHECK(duration(59.6) == "1m 0s");
  CHECK(duration(3723) == "1h 2m 3s");
  CHECK(duration(86400) == "1d 0h 0m 0s");
}
