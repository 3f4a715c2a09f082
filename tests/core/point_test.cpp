// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/hash.h"
#include "core/polygon.h"

#include <cmath>

#include <catch2/catch.hpp>

using namespace weft;

TEST_CASE("core: a length is rounded to the nearest micron as std::lround does", "[law]") {
  for (const double whole : {0.0, 1.0, 7.0, 16'777'215.0, 2'147'483'646.0})
    for (const double rest : {0.0, 0.25, 0.49999999, 0.5, 0.50000001, 0.75})
      for (const double um : {whole + rest, -whole - rest}) {
        CAPTURE(um);
        CHECK(rounded(um) == static_cast<Um>(std::lround(um)));
      }
  CHECK(rounded(std::nextafter(0.5, 0.0)) == 0);
  CHECK(rounded(std::nextafter(-0.5, 0.0)) == 0);
}

TEST_CASE("core: a literal in millimetres is whole microns") {
  STATIC_REQUIRE(0.45_mm == 450);
  STATIC_REQUIRE(20_mm == 20000);
  CHECK(from_mm(-0.0125) == -13);
}

TEST_CASE("core: orient is exact at the corners of the lattice") {
  const Point a{-max_coord, -max_coord}, b{max_coord, max_coord};
  CHECK(orient(a, b, {0, 0}) == 0);
  CHECK(orient(a, b, {0, 1}) > 0);
  CHECK(orient(a, b, {1, 0}) < 0);
}

TEST_CASE("core: area counts holes as missing") {
  const Region frame{{{0, 0}, {10000, 0}, {10000, 10000}, {0, 10000}},
                     {{{2000, 2000}, {2000, 8000}, {8000, 8000}, {8000, 2000}}}};
  CHECK(area_mm2(frame) == Approx(64.0));
  CHECK(perimeter_of(frame.outer) == Approx(40000));
}

TEST_CASE("core: a point is inside, on or outside of a ring") {
  const Ring triangle{{0, 0}, {4000, 0}, {2000, 3000}};
  CHECK(side_of(triangle, {2000, 1000}) == Side::inside);
  CHECK(side_of(triangle, {1000, 1500}) == Side::on);
  CHECK(side_of(triangle, {4000, 0}) == Side::on);
  CHECK(side_of(triangle, {5000, 0}) == Side::outside);
  CHECK(side_of(triangle, {0, 3000}) == Side::outside);
}

TEST_CASE("core: what lies in a hole of a region is outside of it") {
  const Region frame{{{0, 0}, {9000, 0}, {9000, 9000}, {0, 9000}},
                     {{{1000, 1000}, {1000, 3000}, {3000, 3000}, {3000, 1000}},
                      {{5000, 5000}, {5000, 8000}, {8000, 8000}, {8000, 5000}}}};
  CHECK(side_of(frame, {4000, 4000}) == Side::inside);
  CHECK(side_of(frame, {2000, 2000}) == Side::outside);
  CHECK(side_of(frame, {6000, 7000}) == Side::outside);
  CHECK(side_of(frame, {8000, 7000}) == Side::on);
  CHECK(side_of(frame, {0, 7000}) == Side::on);
  CHECK(side_of(frame, {9001, 7000}) == Side::outside);
}

TEST_CASE("core: sha256 agrees with FIPS 180-4, example B.1") {
  CHECK(sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}
