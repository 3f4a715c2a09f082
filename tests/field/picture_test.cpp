// SPDX-License-Identifier: GPL-3.0-or-later
#include "field/grid.h"
#include "settings_error.h"

#include <cstdint>
#include <vector>

#include <catch2/catch.hpp>

using namespace weft;
using test::settings_error;

namespace {

std::string problem_of(const std::string& bytes, const std::string& path = "a.pgm") {
  return settings_error([&] { (void)field::read_picture(bytes, path); });
}

void put(std::string& to, std::uint32_t v) {
  for (int k = 3; k >= 0; --k) to += static_cast<char>(v >> 8 * k & 0xFF);
}

void put_chunk(std::string& to, const std::string& name, const std::string& data) {
  put(to, static_cast<std::uint32_t>(data.size()));
  std::uint32_t crc = 0xFFFFFFFF;
  for (const char c : name + data) {
    crc ^= static_cast<std::uint8_t>(c);
    for (int k = 0; k < 8; ++k) crc = crc >> 1 ^ ((crc & 1) != 0 ? 0xEDB88320 : 0);
  }
  to += name + data;
  put(to, ~crc);
}

/// Written by hand: rows of grey, each behind a filter byte of 0, in one stored block.
std::string png(std::uint32_t columns, const std::vector<std::string>& rows) {
  std::string raw;
  for (const std::string& row : rows) raw += '\0' + row;
  std::uint32_t a = 1, b = 0;
  for (const char c : raw) a = (a + static_cast<std::uint8_t>(c)) % 65521, b = (b + a) % 65521;
  std::string data("\x78\x01\x01", 3);
  data += static_cast<char>(raw.size() & 0xFF), data += static_cast<char>(raw.size() >> 8);
  data += static_cast<char>(~raw.size() & 0xFF), data += static_cast<char>(~raw.size() >> 8 & 0xFF);
  data += raw;
  put(data, b << 16 | a);
  std::string head;
  put(head, columns), put(head, static_cast<std::uint32_t>(rows.size()));
  head += std::string("\x08\x00\x00\x00\x00", 5);
  std::string out("\x89PNG\r\n\x1a\n", 8);
  put_chunk(out, "IHDR", head), put_chunk(out, "IDAT", data), put_chunk(out, "IEND", "");
  return out;
}

}  // namespace

TEST_CASE("picture: a PGM's darkness, its lower edge first", "[field]") {
  const field::Grid plain = field::read_picture("P2\n# a wedge\n3 2\n100\n0 50 100\n100 100 0\n", "a.pgm");
  REQUIRE(plain.columns == 3);
  REQUIRE(plain.rows == 2);
  CHECK(plain.at(0.5, 1.5) == Approx(1));
  CHECK(plain.at(1.5, 1.5) == Approx(0.5));
  CHECK(plain.at(2.5, 0.5) == Approx(1));
  CHECK(plain.at(0.5, 0.5) == Approx(0).margin(1e-7));
  const field::Grid raw = field::read_picture(std::string("P5 2 1 255\n\x00\xFF", 13), "a.pgm");
  CHECK(raw.at(0.5, 0.5) == Approx(1));
  CHECK(raw.at(1.5, 0.5) == Approx(0).margin(1e-7));
  const field::Grid wide = field::read_picture(std::string("P5 2 1 65535\n\x00\x00\xFF\xFF", 17), "a.pgm");
  CHECK(wide.at(1, 0.5) == Approx(0.5));
}

TEST_CASE("picture: a PNG's darkness, its lower edge first", "[field]") {
  const field::Grid g = field::read_picture(png(2, {std::string("\x00\xFF", 2), std::string("\xFF\xFF", 2)}), "a.png");
  REQUIRE(g.columns == 2);
  REQUIRE(g.rows == 2);
  CHECK(g.at(0.5, 1.5) == Approx(1));
  CHECK(g.at(1.5, 1.5) == Approx(0).margin(1e-7));
  CHECK(g.at(0.5, 0.5) == Approx(0).margin(1e-7));
}

TEST_CASE("picture: what is none is refused", "[field]") {
  CHECK(problem_of("GIF89a", "a.gif") == "a.gif: is neither a PNG nor a PGM; convert it to one of them");
  CHECK(problem_of("P5 10 10 255\n12345") == "a.pgm: 5 pixels, 100 (10 × 10) expected");
  CHECK(problem_of("P2 2 1 100\n50 101\n") == "a.pgm: pixel 1: 101 is more than 100");
  CHECK(problem_of("P2 2 1 100\n50\n") == "a.pgm: ends, or holds no number, where one is expected");
  CHECK(problem_of("P2 0 1 100\n50\n") == "a.pgm: 0 × 1 pixels of 0 … 100; a PGM is 1 × 1 pixels or more");
  const std::string whole = png(2, {std::string("\x00\xFF", 2)});
  CHECK(problem_of(whole.substr(0, whole.size() - 30), "a.png").find("a.png: is no PNG that can be read") == 0);
  CHECK(problem_of(std::string("\x89PNG", 4), "a.png").find("a.png: is no PNG that can be read") == 0);
}
