// SPDX-License-Identifier: GPL-3.0-or-later
#include "field/grid.h"

#include "settings_error.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <catch2/catch.hpp>

using namespace weft;
using test::settings_error;

namespace {

field::Grid grid_of(const std::string& bytes, const std::string& path = "a.vtk", double most = 1) {
  return field::read_grid(bytes, path, most);
}

std::string problem_of(const std::string& bytes, const std::string& path = "a.vtk", double most = 1) {
  return settings_error([&] { (void)grid_of(bytes, path, most); });
}

std::string tensor_problem_of(const std::string& bytes, const std::string& path) {
  return settings_error([&] { (void)field::read_tensors(bytes, path); });
}

std::string vtk(const std::string& coding, const std::string& size, const std::string& values) {
  return "# vtk DataFile Version 3.0\na density\n" + coding + "\nDATASET STRUCTURED_POINTS\nDIMENSIONS " + size +
         "\nORIGIN 1 2 3\nSPACING 2 4 8\nPOINT_DATA 1\nSCALARS density float 1\nLOOKUP_TABLE default\n" + values;
}

template <class T, class Bits>
std::string big_endian(std::initializer_list<T> values) {
  std::string out;
  for (const T v : values)
    for (std::size_t b = sizeof(T); b-- > 0;)
      out += static_cast<char>(static_cast<std::uint64_t>(std::bit_cast<Bits>(v)) >> 8 * b & 0xFF);
  return out;
}

}  // namespace

TEST_CASE("field: a legacy VTK file of text gives its numbers, linear between nodes and constant beyond", "[field]") {
  const field::Grid g = grid_of(vtk("ASCII", "2 3 2", "0 .1 .2 .3 .4 .5\n.6 .7 .8 .9 1 0\n"));
  REQUIRE(g.values.size() == 12);
  CHECK(g.at(1, 2, 3) == Approx(0).margin(1e-7));
  CHECK(g.at(3, 2, 3) == Approx(0.1));
  CHECK(g.at(1, 6, 3) == Approx(0.2));
  CHECK(g.at(1, 2, 11) == Approx(0.6));
  CHECK(g.at(2, 4, 3) == Approx(0.15));  // the mean of four nodes
  CHECK(g.at(2, 4, 7) == Approx(0.45));  // of eight
  CHECK(g.at(-100, 2, 3) == Approx(0).margin(1e-7));
  CHECK(g.at(100, 2, 3) == Approx(0.1));
}

TEST_CASE("field: a binary VTK file is big-endian, of float or of double", "[field]") {
  const field::Grid g = grid_of(vtk("BINARY", "3 1 1", big_endian<float, std::uint32_t>({0.25F, 0.5F, 0.75F})));
  CHECK(g.at(3, 2, 3) == Approx(0.5));
  std::string wide = vtk("BINARY", "3 1 1", big_endian<double, std::uint64_t>({0.25, 0.5, 0.75}));
  wide.replace(wide.find("density float"), 13, "density double");
  CHECK(grid_of(wide).at(5, 2, 3) == Approx(0.75));
}

TEST_CASE("field: a CSV is a lattice in any order, with names of columns or without", "[field]") {
  const field::Grid g = grid_of("x,y,z,density\n2,0,0,40\r\n0,0,0,20\n0;1;0;60\n2, 1, 0, 80\n", "a.csv", 100);
  CHECK(g.columns == 2);
  CHECK(g.rows == 2);
  CHECK(g.slices == 1);
  CHECK(g.at(0, 0, 0) == Approx(0.2));
  CHECK(g.at(1, 0.5, 9) == Approx(0.5));
  CHECK(grid_of("0,0,0,1\n", "A.CSV").at(7, 7, 7) == Approx(1));
}

TEST_CASE("field: what is wrong with a VTK file is said with its line", "[field]") {
  CHECK(problem_of("# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\n") ==
        "a.vtk:4: UNSTRUCTURED_GRID is no regular grid; resample it to STRUCTURED_POINTS");
  std::string values;
  for (int i = 0; i < 800; ++i) values += "0.5\n";
  CHECK(problem_of(vtk("ASCII", "10 10 10", values)) == "a.vtk: 800 values, 1000 (10 × 10 × 10) expected");
  CHECK(problem_of(vtk("BINARY", "10 1 1", big_endian<float, std::uint32_t>({0.F, 1.F}))) ==
        "a.vtk: 2 values, 10 (10 × 1 × 1) expected");
  CHECK(problem_of(vtk("ASCII", "1600 1600 1600", "0")) == "a.vtk: 4.1e9 values, 2.56e8 at most");
  CHECK(problem_of(vtk("ASCII", "2 1 1", "0.5\n1.7\n")) ==
        "a.vtk:12: 1.7 is not within 0 … 1; infill_density_field_unit = percent?");
  CHECK(problem_of(vtk("ASCII", "2 1 1", "0.5\nnan\n")) ==
        "a.vtk:12: nan is not within 0 … 1; infill_density_field_unit = percent?");
  CHECK(problem_of(vtk("BINARY", "2 1 1", big_endian<float, std::uint32_t>({0.F, 4.F}))) ==
        "a.vtk: value 2: 4 is not within 0 … 1; infill_density_field_unit = percent?");
  CHECK(problem_of(vtk("ASCII", "2 1 1", "0.5\nhalf\n")) == "a.vtk:12: 'half' is not a number");
  CHECK(problem_of(vtk("ASCII", "2 1.5 1", "0.5\n")) == "a.vtk:10: 1.5 is no number of nodes");
  CHECK(problem_of(vtk("OCTAL", "2 1 1", "0")) == "a.vtk:3: 'OCTAL' is neither ASCII nor BINARY");
  CHECK(problem_of("# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_POINTS\n") == "a.vtk: has no SCALARS");
}

TEST_CASE("field: what is wrong with a CSV is said with its line", "[field]") {
  CHECK(problem_of("x,y,z,density\n0,0,0,0.5\n1,0,0,1.7\n", "a.csv") ==
        "a.csv:3: 1.7 is not within 0 … 1; infill_density_field_unit = percent?");
  CHECK(problem_of("0,0,0,50\n1,0,0,170\n", "a.csv", 100) ==
        "a.csv:2: 170 is not within 0 … 100; infill_density_field_unit = fraction?");
  std::string csv;
  for (int i = 0; i < 6; ++i) csv += std::to_string(2 * i) + ",0,0,0.5\n";
  CHECK(problem_of(csv + "4.1,0,0,0.5\n", "a.csv") == "a.csv:7: x = 4.1 is off the lattice of 2 mm");
  CHECK(problem_of("0,0,0,0.5\n1,0,0,0.5\n0,1,0,0.5\n", "a.csv") == "a.csv: 3 values, 4 (2 × 2 × 1) expected");
  CHECK(problem_of("0,0,0,0.5\n1,0,0,0.5\n0,0,0,0.6\n1,1,0,1\n", "a.csv") ==
        "a.csv:3: gives a place that line 1 gave before");
  CHECK(problem_of("0,0,0.5\n", "a.csv") == "a.csv:1: is not x, y, z, density");
  CHECK(problem_of("x,y,z,density\n", "a.csv") == "a.csv: holds no x, y, z, density");
  CHECK(problem_of("hello", "a.txt") ==
        "a.txt: is neither a legacy VTK file, nor a .vti, nor a CSV; write STRUCTURED_POINTS, ImageData, or lines of "
        "numbers");
}

TEST_CASE("field: a stress's larger principal direction is that of Mohr's circle", "[field][law]") {
  for (int k = -8; k <= 8; ++k) {
    const double angle = std::numbers::pi / 17 * k, c = std::cos(angle), s = std::sin(angle);
    // 5 along the angle, −2 across
    const std::string csv = std::to_string(5 * c * c - 2 * s * s) + ',' + std::to_string(5 * s * s - 2 * c * c) +
                            ",0," + std::to_string(7 * s * c) + ",0,0\n";
    const field::TensorGrid t = field::read_tensors("0,0,0," + csv, "s.csv");
    CAPTURE(angle);
    REQUIRE(t.direction_at(0, 0, 0));
    CHECK(std::remainder(*t.direction_at(0, 0, 0) - angle, std::numbers::pi) == Approx(0).margin(1e-5));
  }
  CHECK_FALSE(field::read_tensors("0,0,0,3,3,3,0,0,0\n", "s.csv").direction_at(0, 0, 0));
  CHECK_FALSE(field::read_tensors("0,0,0,0,0,0,0,0,0\n", "s.csv").direction_at(0, 0, 0));
}

TEST_CASE("field: between nodes the tensor is linear, not its angle", "[field]") {
  // stretched along X at one node and along Y at the next, twice as much: in the middle along Y; along X before a third
  const field::TensorGrid t = field::read_tensors("0,0,0,1,0,0,0,0,0\n1,0,0,0,2,0,0,0,0\n", "s.csv");
  CHECK(std::abs(*t.direction_at(0.3, 0, 0)) == Approx(0).margin(1e-6));
  CHECK(std::abs(*t.direction_at(0.4, 0, 0)) == Approx(std::numbers::pi / 2).margin(1e-6));
}

TEST_CASE("field: vectors and tensors of VTK, and what is wrong with them", "[field]") {
  const std::string head =
      "# vtk DataFile Version 3.0\ns\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2 1 1\nORIGIN 0 0 0\n"
      "SPACING 1 1 1\nPOINT_DATA 2\n";
  const field::TensorGrid v = field::read_tensors(head + "VECTORS d float\n1 1 0\n-1 1 0\n", "v.vtk");
  CHECK(*v.direction_at(0, 0, 0) == Approx(std::numbers::pi / 4));
  CHECK(*v.direction_at(1, 0, 0) == Approx(-std::numbers::pi / 4));
  const field::TensorGrid t =
      field::read_tensors(head + "TENSORS s float\n1 0 0  0 3 0  0 0 0\n 0 2 0  2 0 0  0 0 0\n", "s.vtk");
  CHECK(std::abs(*t.direction_at(0, 0, 0)) == Approx(std::numbers::pi / 2));
  CHECK(*t.direction_at(1, 0, 0) == Approx(std::numbers::pi / 4));
  CHECK(tensor_problem_of(head + "TENSORS s float\n1 0 0  0 3 0  0 0 0\n 0 3 0  4 0 0  0 0 0\n", "s.vtk") ==
        "s.vtk: value 2: sxy 3 but syx 4; a stress is symmetric");
  CHECK(tensor_problem_of(head + "VECTORS d float\n1 1 0\n-1 nan 0\n", "v.vtk") == "v.vtk:11: nan is no number");
  CHECK(tensor_problem_of(head + "SCALARS d float\nLOOKUP_TABLE default\n1 1\n", "v.vtk") ==
        "v.vtk: has no VECTORS or TENSORS");
  CHECK(tensor_problem_of("0,0,0,1\n", "s.csv") == "s.csv:1: is not x, y, z, sxx, syy, szz, sxy, syz, szx");
}
