// SPDX-License-Identifier: GPL-3.0-or-later
#include "field/grid.h"
#include "settings_error.h"

#include <bit>
#include <cstdint>

#include <catch2/catch.hpp>

using namespace weft;
using test::settings_error;

namespace {

std::string little_endian(std::uint64_t v, int size) {
  std::string out;
  for (int b = 0; b < size; ++b) out += static_cast<char>(v >> 8 * b & 0xFF);
  return out;
}

std::string floats(std::initializer_list<float> values) {
  std::string out;
  for (const float v : values) out += little_endian(std::bit_cast<std::uint32_t>(v), 4);
  return out;
}

std::string base64(const std::string& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t v = 0;
    for (std::size_t k = 0; k < 3; ++k)
      v = v << 8 | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k) out += i + k <= bytes.size() ? digits[v >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

std::string vti(const std::string& array, const std::string& behind = "", const std::string& more = "",
                const std::string& data = "PointData") {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"0.1\" byte_order=\"LittleEndian\"" + more +
         ">\n<ImageData WholeExtent=\"0 1 0 2 0 0\" Origin=\"10 20 30\" Spacing=\"2 4 8\">\n<Piece Extent=\"0 1 0 2 0 "
         "0\">\n<" +
         data + ">\n" + array + "</" + data + ">\n</Piece>\n</ImageData>\n" + behind + "</VTKFile>\n";
}

const std::string six = floats({0, 0.1F, 0.2F, 0.3F, 0.4F, 0.5F});

void check_six(const field::Grid& g) {
  REQUIRE(g.values.size() == 6);
  CHECK(g.at(12, 20, 30) == Approx(0.1));
  CHECK(g.at(10, 24, 30) == Approx(0.2));
  CHECK(g.at(12, 28, 30) == Approx(0.5));
}

std::string problem_of(const std::string& bytes) {
  return settings_error([&] { (void)field::read_grid(bytes, "a.vti", 1); });
}

}  // namespace

TEST_CASE("vti: numbers as text, base64, and appended, raw or not", "[field]") {
  check_six(field::read_grid(
      vti("<DataArray type=\"Float32\" Name=\"d\" format=\"ascii\">0 .1 .2 .3 .4 .5</DataArray>\n"), "a.vti", 1));
  const std::string head = little_endian(six.size(), 4);
  // the head apart from the numbers, as VTK writes it, and in one with them, as others do
  for (const std::string& text : {base64(head) + base64(six), base64(head + six)})
    check_six(field::read_grid(vti("<DataArray type=\"Float32\" format=\"binary\">\n  " + text + "\n</DataArray>\n"),
                               "a.vti", 1));
  const std::string array = "<DataArray type=\"Float32\" format=\"appended\" offset=\"0\"/>\n";
  check_six(field::read_grid(vti(array, "<AppendedData encoding=\"raw\">\n_" + head + six + "\n</AppendedData>\n"),
                             "a.vti", 1));
  check_six(field::read_grid(
      vti(array, "<AppendedData encoding=\"base64\">\n_" + base64(head + six) + "\n</AppendedData>\n"), "a.vti", 1));
  const std::string wide = little_endian(six.size(), 8);
  check_six(field::read_grid(
      vti(array, "<AppendedData encoding=\"raw\">_" + wide + six + "</AppendedData>\n", " header_type=\"UInt64\""),
      "a.vti", 1));
}

TEST_CASE("vti: blocks that zlib pressed", "[field]") {
  // zlib of six floats in two blocks of 12 bytes, each stored as it is: 78 01, 01 0c 00 f3 ff, the bytes, Adler-32
  const auto stored = [](const std::string& bytes) {
    std::uint32_t a = 1, b = 0;
    for (const char c : bytes) a = (a + static_cast<std::uint8_t>(c)) % 65521, b = (b + a) % 65521;
    std::string out("\x78\x01\x01", 3);
    out += little_endian(bytes.size(), 2) + little_endian(~bytes.size() & 0xFFFF, 2) + bytes;
    for (int k = 3; k >= 0; --k) out += static_cast<char>((b << 16 | a) >> 8 * k & 0xFF);
    return out;
  };
  const std::string first = stored(six.substr(0, 12)), second = stored(six.substr(12));
  const std::string head = little_endian(2, 4) + little_endian(12, 4) + little_endian(0, 4) +
                           little_endian(first.size(), 4) + little_endian(second.size(), 4);
  const std::string more = " compressor=\"vtkZLibDataCompressor\"";
  const auto file = [&](const std::string& text) {
    return vti("<DataArray type=\"Float32\" format=\"binary\">" + text + "</DataArray>\n", "", more);
  };
  check_six(field::read_grid(file(base64(head) + base64(first + second)), "a.vti", 1));
  std::string broken = first + second;
  broken[10] = static_cast<char>(broken[10] + 1);
  CHECK(problem_of(file(base64(head) + base64(broken))) == "a.vti: a block cannot be decompressed");
  CHECK(problem_of(file(base64(head) + base64(first))) == "a.vti: an array ends within a block");
}

TEST_CASE("vti: what cells have stands in their middle", "[field]") {
  const std::string file = vti("<DataArray type=\"UInt8\" format=\"ascii\">0 1</DataArray>\n", "", "", "CellData");
  const field::Grid g = field::read_grid(file, "a.vti", 1);
  REQUIRE(g.values.size() == 2);
  CHECK(g.at(11, 22, 30) == Approx(0).margin(1e-7));
  CHECK(g.at(11, 26, 30) == Approx(1));
  CHECK(g.at(11, 24, 30) == Approx(0.5));
}

TEST_CASE("vti: what is wrong is said", "[field]") {
  const auto text = [](const std::string& values) {
    return vti("<DataArray type=\"Float32\" format=\"ascii\">" + values + "</DataArray>\n");
  };
  CHECK(problem_of(text("0 1 0")) == "a.vti: 3 values, 6 (2 × 3 × 1) expected");
  CHECK(problem_of(text("0 0 0 0 0 7")) ==
        "a.vti: value 6: 7 is not within 0 … 1; infill_density_field_unit = percent?");
  CHECK(problem_of(text("0 0 x 0 0 7")) == "a.vti: 'x' is not a number");
  CHECK(problem_of(vti("")) == "a.vti: has no DataArray of one component");
  CHECK(problem_of("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\">\n</VTKFile>\n") ==
        "a.vti: UnstructuredGrid is no regular grid; resample it to ImageData");
  CHECK(problem_of("<VTKFile type=\"ImageData\">\n<Image").find("a.vti:2: is no XML: ") == 0);
  CHECK(problem_of(vti("<DataArray type=\"Float32\" format=\"binary\">AAA</DataArray>\n")) ==
        "a.vti: an array ends within its head");
  CHECK(problem_of(vti("<DataArray type=\"String\" format=\"binary\">AAAA</DataArray>\n")) ==
        "a.vti: values of type 'String'; write them as Float32 or Float64");
  std::string huge = text("0");
  huge.replace(huge.find("0 1 0 2 0 0"), 11, "1 1600 1 1600 1 1600");
  CHECK(problem_of(huge) == "a.vti: 4.1e9 values, 2.56e8 at most");
}
