// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/value.h"

#include <stdexcept>
#include <string>

#include <catch2/catch.hpp>

using namespace weft;

namespace {

template <class T>
T read(const char* text) {
  T out;
  value::parse(text, Unit::none, out);
  return out;
}
template <class T>
std::string problem(const char* text) {
  try {
    (void)read<T>(text);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "nothing was thrown";
}

}  // namespace

TEST_CASE("settings: ranges of heights are sorted, apart, and read as they are printed", "[settings]") {
  const auto bands = read<HeightBands>("5-20:0.3; 0 - 5 : 0.1 mm;");
  REQUIRE(bands.size() == 2);
  CHECK(bands[0] == HeightBand{0, 5'000, 100});
  CHECK(bands[1] == HeightBand{5'000, 20'000, 300});
  const auto text = value::print(bands, Unit::none);
  CHECK(text == "0-5:0.1; 5-20:0.3");
  CHECK(read<HeightBands>(text.c_str()) == bands);
  CHECK(read<HeightBands>("").empty());
  CHECK(problem<HeightBands>("5-20:0.2; 18-30:0.1") == "5-20 and 18-30 overlap");
  CHECK(problem<HeightBands>("5-5:0.2") == "5-5 ends where it begins");
  CHECK(problem<HeightBands>("0-5:9") == "9 mm is outside 0.02 … 2 mm");
  CHECK(problem<HeightBands>("0:5") == "'0:5' is not a list of from-to:height in mm such as 0-5:0.1; 5-20:0.3");
  CHECK(problem<HeightBands>("-1-5:0.2") ==
        "'-1-5:0.2' is not a list of from-to:height in mm such as 0-5:0.1; 5-20:0.3");
}

TEST_CASE("settings: rows of pressure advance say which row is wrong, and how a comma is meant", "[settings]") {
  const auto rows = read<PressureRows>("0.04, 3.96, 3000; 0.033,3.96,10000 ;");
  REQUIRE(rows.size() == 2);
  CHECK(rows[1].mm_s2 == 10000);
  CHECK(value::print(rows, Unit::none) == "0.04, 3.96, 3000; 0.033, 3.96, 10000");
  CHECK(read<PressureRows>("0.04, 3.96, 3000, 0.2")[0].height == 200);
  CHECK(problem<PressureRows>("0.04,3,1000; 0.04,8,1000; 0,04,3.96,3000") ==
        "row 3: \"0,04\" is no number; write 0.04");
  CHECK(problem<PressureRows>("0,04,3,96,3000") == "row 1: \"0,04\" is no number; write 0.04");
  CHECK(problem<PressureRows>("0.04, 3") ==
        "row 1: 2 numbers; a row is an advance in s, mm³/s, mm/s², or these and mm");
  CHECK(problem<PressureRows>("0.04, x, 3") == "row 1: \"x\" is no number");
  CHECK(problem<PressureRows>("0.04, 0, 3") == "row 1: 0 mm³/s is not above 0, up to 500");
  CHECK(problem<PressureRows>("9, 1, 3") == "row 1: 9 s is outside 0 … 2 s");
  CHECK(problem<PressureRows>("0.1, 1, 3; 0.1, 1, 3, 0.2") ==
        "row 2: rows with the height of a layer and rows without do not go together");
}
