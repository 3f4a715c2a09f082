// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/file_bytes.h"
#include "core/hash.h"
#include "corpus.h"
#include "mesh/fixtures.h"
#include "mesh/formats.h"
#include "mesh/weld.h"
#include "source.h"
#include "tasks/tasks.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::mesh;
using namespace fixtures;
using Catch::Contains;

namespace {
const Facets cube = box({0, 0, 0}, {20, 20, 20});

Facets row_of_boxes(int count) {
  Facets all;
  for (int i = 0; i < count; ++i) {
    const float x = 21.F * static_cast<float>(i);
    for (const auto& facet : box({x, 0, 0}, {x + 20, 20, 20})) all.push_back(facet);
  }
  return all;
}

std::string with_upper_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}
}  // namespace

TEST_CASE("mesh: a binary STL is welded to eight vertices of a cube", "[mesh]") {
  const Loaded loaded = read(binary_stl(cube));
  CHECK(loaded.format == Format::stl_binary);
  CHECK(loaded.triangles_in_file == 12);
  CHECK(loaded.sha256.size() == 64);
  REQUIRE(loaded.objects.size() == 1);
  const Mesh& mesh = loaded.objects[0].mesh;
  CHECK(mesh.vertices.size() == 8);
  CHECK(mesh.triangles.size() == 12);
  CHECK(volume_mm3(mesh) == Approx(8000));
  CHECK(box_of(mesh) == Box3{{0, 0, 0}, {20'000, 20'000, 20'000}});
}

TEST_CASE("mesh: a binary STL whose header says solid is read as binary", "[mesh]") {
  CHECK(read(binary_stl(cube, "solid made by a program")).format == Format::stl_binary);
  CHECK(read(binary_stl(cube, "solid x facet normal endsolid")).format == Format::stl_binary);
}

TEST_CASE("mesh: a binary STL without a byte above 127 is read as binary", "[mesh]") {
  const std::string bytes = binary_stl(box({0, 0, 0}, {195, 195, 2}));
  for (const char c : bytes) REQUIRE(static_cast<unsigned char>(c) <= 127);
  const Loaded loaded = read(bytes);
  CHECK(loaded.format == Format::stl_binary);
  CHECK(volume_mm3(loaded.objects[0].mesh) == Approx(195 * 195 * 2));
}

TEST_CASE("mesh: an ASCII STL is read whatever ends its lines and in either case", "[mesh]") {
  const Mesh expected = read(binary_stl(cube)).objects[0].mesh;
  const std::string eol = GENERATE("\n", "\r\n", "\r", " ");
  const std::string text = eol == " " ? "solid\n" + ascii_stl(cube, "", eol).substr(6) : ascii_stl(cube, "part", eol);
  for (const std::string& bytes : {text, with_upper_case(text), "\xEF\xBB\xBF" + text}) {
    const Loaded loaded = read(bytes);
    CHECK(loaded.format == Format::stl_ascii);
    CHECK(loaded.objects[0].mesh == expected);
  }
}

TEST_CASE("mesh: the solids of an ASCII STL become shells of one object, named by its file", "[mesh]") {
  const Loaded loaded =
      read(ascii_stl(cube, "left half") + "\n" + ascii_stl(box({30, 0, 0}, {40, 10, 10}), "facet") + "\n\n");
  REQUIRE(loaded.objects.size() == 1);
  CHECK(loaded.objects[0].name.empty());  // "left half" is mostly the name of a program: the file's is taken
  CHECK(loaded.triangles_in_file == 24);
  CHECK(volume_mm3(loaded.objects[0].mesh) == Approx(9000));
}

TEST_CASE("mesh: a long ASCII STL is the same model in parts as in one piece, whatever its lines hold", "[mesh][law]") {
  const Facets facets = row_of_boxes(750);
  const Mesh expected = read(binary_stl(facets)).objects[0].mesh;
  const std::string name = GENERATE("part", "endfacet", "x endfacet facet", "");
  const std::size_t of_each = GENERATE(9'000U, 1'700U, 7U);  // facets of a solid
  std::string text;
  for (std::size_t from = 0; from < facets.size(); from += of_each) {
    const auto to = std::min(from + of_each, facets.size());
    text += ascii_stl(
        Facets(facets.begin() + static_cast<std::ptrdiff_t>(from), facets.begin() + static_cast<std::ptrdiff_t>(to)),
        name);
    text += "a remark, endfacet\n";
  }
  REQUIRE(text.size() > 3 << 19);
  for (const unsigned threads : {1U, 8U}) {
    const tasks::ThreadLimit limit(threads);
    const Loaded loaded = read(text);
    CHECK((loaded.objects[0].mesh == expected));
    CHECK(loaded.sha256 == sha256(text));
  }
}

TEST_CASE("mesh: what is wrong far into an ASCII STL is told with its triangle and line", "[mesh]") {
  std::string text = ascii_stl(row_of_boxes(750));
  text.replace(text.rfind("vertex"), 6, "vortex");
  CHECK_THAT(refusal(text), Contains("part:62999: triangle 9000: expected 'vertex', found 'vortex'"));
  CHECK_THAT(refusal(text.substr(0, text.size() / 2)), Contains("the file ends in the middle of triangle 4531"));
  CHECK_THAT(refusal(text.substr(0, text.find("endfacet", 1 << 20) + 8)), Contains("ends without 'endsolid'"));
}

TEST_CASE("mesh: ASCII numbers may have signs, exponents and no digit before the point", "[mesh]") {
  const Loaded loaded = read(
      "solid\nfacet normal nan nan nan\nouter loop\nvertex +1.5e+01 -.5 1E-1000\nvertex 2e1 0 -0\nvertex 0 0.2E+2 1.\n"
      "endloop\nendfacet\nendsolid");
  CHECK(loaded.objects[0].mesh.vertices == std::vector<Point3>{{15'000, -500, 0}, {20'000, 0, 0}, {0, 20'000, 1'000}});
}

TEST_CASE("mesh: a cut-off binary STL is refused with the triangle where it ends", "[mesh]") {
  const std::string whole = binary_stl(cube);
  CHECK_THAT(refusal(whole.substr(0, 84 + 5 * 50 + 7)), Contains("cut off in triangle 6 of 12 (byte 341 of 684)"));
  CHECK_THAT(refusal(binary_stl(cube, "solid x").substr(0, 600)), Contains("cut off in triangle 11 of 12"));
}

TEST_CASE("mesh: a binary STL with a wrong count is refused with both counts", "[mesh]") {
  std::string bytes = binary_stl(cube);
  bytes[80] = 5;
  CHECK_THAT(refusal(bytes), Contains("5 triangles are 334 bytes, but it has 684, room for 12 triangles"));
  bytes[80] = 0;
  CHECK_THAT(refusal(bytes), Contains("0 triangles are 84 bytes, but it has 684"));
}

TEST_CASE("mesh: a binary STL with bytes behind its triangles is read, and they are told", "[mesh]") {
  const std::string behind =
      GENERATE(std::string(1, '\0'), std::string(100, '\0'), std::string("exported by a program"),
               std::string(300, 'x'), std::string(200, '\xff'));
  const auto loaded = read(binary_stl(cube) + behind);
  CHECK(loaded.objects[0].mesh.triangles.size() == 12);
  REQUIRE(loaded.notices.size() == 1);
  CHECK(loaded.notices[0].code == "mesh_bytes_behind");
  CHECK_THAT(loaded.notices[0].message,
             Contains(std::to_string(behind.size()) + " bytes behind the last of 12 triangles"));
  // More is another file than its header says.
  CHECK_THAT(refusal(binary_stl(cube) + std::string(5000, '\0')), Contains("wrong count"));
}

TEST_CASE("mesh: a coordinate that is no place is refused with its triangle and byte", "[mesh]") {
  Facets facets = cube;
  facets[3][1].z = std::numeric_limits<float>::quiet_NaN();
  CHECK_THAT(refusal(binary_stl(facets)), Contains("triangle 4 (byte 266): z of its corner 2 is not a number"));
  facets[3][1].z = -std::numeric_limits<float>::infinity();
  CHECK_THAT(refusal(binary_stl(facets)), Contains("triangle 4 (byte 266): z of its corner 2 is infinite"));
  facets[3][1].z = -16'001;
  CHECK_THAT(refusal(binary_stl(facets)), Contains("z of its corner 2 is -16001 mm, beyond ±16 m"));
  facets[3][1].z = -16'000;
  CHECK(box_of(read(binary_stl(facets)).objects[0].mesh).min.z == -16'000'000);
}

TEST_CASE("mesh: a damaged ASCII STL is refused with its line", "[mesh]") {
  const std::string text = ascii_stl(cube, "part", GENERATE("\n", "\r\n", "\r"));
  const auto with = [&](std::string_view old, std::string_view put) {
    std::string copy = text;
    return copy.replace(copy.find(old), old.size(), put);
  };
  CHECK_THAT(refusal(with("vertex 0.000000", "vertex nan")), Contains("part:4: triangle 1: x is not a number"));
  CHECK_THAT(refusal(with("vertex 0.000000", "vertex 1,5")), Contains("part:4: triangle 1: x is '1,5', not a number"));
  CHECK_THAT(refusal(with("vertex 0.000000", "vertex 1e9")), Contains("beyond ±16 m"));
  CHECK_THAT(refusal(with("vertex 0.000000", "vertex 1e999")), Contains("x is infinite"));
  CHECK_THAT(refusal(with("outer loop", "outer lop")), Contains("part:3: triangle 1: expected 'loop', found 'lop'"));
  CHECK_THAT(refusal(with("endloop", "vertex 0 0 0")), Contains("expected 'endloop', found 'vertex'"));
  CHECK_THAT(refusal(text.substr(0, text.size() / 2)), Contains("ends without 'endsolid', after 6 triangles"));
  CHECK_THAT(refusal(text.substr(0, text.find("outer") + 30)), Contains("ends in the middle of triangle 1"));
  CHECK_THAT(refusal(text.substr(0, text.find("endsolid"))), Contains("ends without 'endsolid', after 12 triangles"));
}

TEST_CASE("mesh: what holds no triangle is refused", "[mesh]") {
  CHECK_THAT(refusal(""), Contains("the file is empty"));
  CHECK_THAT(refusal("solid x\nendsolid x\n"), Contains("ASCII STL without a triangle"));
  CHECK_THAT(refusal(binary_stl({})), Contains("binary STL without a triangle"));
  CHECK_THAT(refusal("\x89PNG\r\n\x1a\n" + std::string(400, '\x5a')), Contains("neither STL, OBJ nor 3MF"));
  CHECK_THAT(refusal("G28\nG1 X10 Y10 E1\n"), Contains("neither STL, OBJ nor 3MF"));
  CHECK_THAT(refusal(binary_stl({{{{0, 0, 0}, {0, 0, 0}, {1, 1, 1}}}})), Contains("none of its 1 triangles"));
}

TEST_CASE("mesh: a binary STL is the same model read from a file, in blocks, as from memory", "[mesh]") {
  const Facets many = row_of_boxes(500);  // more than a block
  const auto path = (std::filesystem::temp_directory_path() / "weft-blocks.stl").string();
  for (const auto& bytes : {binary_stl(many), binary_stl(cube), ascii_stl(cube)}) {
    std::ofstream(path, std::ios::binary) << bytes;
    const Loaded whole = read(bytes, path), blocks = read_file(path);
    CHECK(blocks.sha256 == whole.sha256);
    CHECK(blocks.format == whole.format);
    CHECK(blocks.triangles_in_file == whole.triangles_in_file);
    CHECK(blocks.objects[0].mesh == whole.objects[0].mesh);
  }
  std::filesystem::remove(path);
}

TEST_CASE(
    "mesh: a mesh in many blocks has its triangles in order and its vertices as they appear, on any number of threads",
    "[mesh][law]") {
  Facets facets = row_of_boxes(750);  // three blocks, and in the second half corners are far from their like
  std::mt19937 random(5);
  std::shuffle(facets.begin() + 5'000, facets.end(), random);
  Weld weld(0);
  Mesh expected;
  const auto corner = [&](Corner c) { return weld.index({lattice(c.x), lattice(c.y), lattice(c.z)}); };
  for (const auto& [a, b, c] : facets) {
    const std::uint32_t first = corner(a), second = corner(b);
    expected.triangles.push_back({first, second, corner(c)});
  }
  expected.vertices = weld.take_vertices();
  for (const unsigned threads : {1U, 2U, 8U}) {
    const tasks::ThreadLimit limit(threads);
    const Mesh mesh = read(binary_stl(facets)).objects[0].mesh;
    CHECK((mesh == expected));
  }
}

TEST_CASE("mesh: of several blocks with an error the first is told, as an error of the model", "[mesh]") {
  Facets facets = row_of_boxes(750);
  facets[8'500][0].x = facets[4'500][2].y = std::numeric_limits<float>::infinity();
  const auto path = (std::filesystem::temp_directory_path() / "weft-infinite.stl").string();
  std::ofstream(path, std::ios::binary) << binary_stl(facets);
  try {
    read_file(path);
    FAIL("read");
  } catch (const Error& error) {
    CHECK(error.kind() == Error::Kind::model);
    CHECK_THAT(error.what(), Contains("triangle 4501 (byte"));
  }
  std::filesystem::remove(path);
}

TEST_CASE("mesh: a file that is cut short, grows or is written to while it is read is refused as a file", "[mesh]") {
  const Facets many = row_of_boxes(300);
  const auto path = std::filesystem::temp_directory_path() / "weft-changing.stl";
  const std::string bytes = binary_stl(many);
  const auto overwrite = [&](const std::string& all) {
    std::ofstream(path, std::ios::binary) << all;
    std::filesystem::last_write_time(path, std::filesystem::file_time_type::clock::now() + std::chrono::seconds(5));
  };
  const auto nan = bytes.substr(0, 96) + std::string(bytes.size() - 96, '\xff');
  for (const auto& changed : {bytes.substr(0, 20), bytes.substr(0, bytes.size() / 2), bytes + bytes, bytes, nan}) {
    const auto told = [&](const auto& read) {
      std::ofstream(path, std::ios::binary) << bytes;
      InputFile file(path.string());
      overwrite(changed);
      try {
        read(file);
      } catch (const Error& error) {
        return error.kind();
      }
      return Error::Kind::usage;
    };
    CHECK(told([&](InputFile& file) { read_binary_stl(file, path.string(), 1.0, [](std::string_view) {}); }) ==
          Error::Kind::file);
    CHECK(told([&](InputFile& file) { FileBytes{file}; }) == Error::Kind::file);
  }
  std::filesystem::remove(path);
}

TEST_CASE("mesh: a file that cannot be read is an error of the file, not of the model", "[mesh]") {
  const auto kind_of = [](const std::string& path) {
    try {
      read_file(path);
    } catch (const Error& error) {
      CHECK(error.where() == path);
      return error.kind();
    }
    return Error::Kind::usage;
  };
  CHECK(kind_of("/nonexistent/part.stl") == Error::Kind::file);
  CHECK(kind_of(tests::source.string()) == Error::Kind::file);
  CHECK(kind_of("/dev/null") == Error::Kind::file);
}

TEST_CASE("mesh: a scale is applied before the coordinates meet the lattice", "[mesh]") {
  const Loaded loaded = read(binary_stl(box({0, 0, 0}, {0.0123456f, 0.02f, 0.02f})), {.scale = 1000});
  CHECK(box_of(loaded.objects[0].mesh).max == Point3{12'346, 20'000, 20'000});
}

TEST_CASE("mesh: moving a model by whole microns moves every vertex by just as much", "[mesh][law]") {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> eighths(-400'000, 400'000);  // of a micron: ties are among them
  for (int i = 0; i < 1000; ++i) {
    const double um = eighths(random) / 8.0;
    CHECK(lattice((um + 8'000) / 1000) == lattice(um / 1000) + 8'000);
  }
  CHECK(lattice(16'000) == 16'000'000);
  CHECK(lattice(-16'000) == -16'000'000);
  CHECK(lattice(-0.0004) == 0);
}

TEST_CASE("mesh: points weld exactly when they are equal, in order of appearance", "[mesh][law]") {
  std::mt19937 random(2);
  std::uniform_int_distribution<Um> coordinate(-9, 9);
  Weld weld(0);  // has to grow
  std::vector<Point3> seen;
  for (int i = 0; i < 20'000; ++i) {
    const Point3 p{coordinate(random) * 1'700'000, coordinate(random), coordinate(random)};
    const std::uint32_t index = weld.index(p);
    REQUIRE(index <= seen.size());
    if (index == seen.size()) seen.push_back(p);
    REQUIRE(seen[index] == p);
  }
  auto vertices = weld.take_vertices();
  CHECK(vertices == seen);
  std::sort(vertices.begin(), vertices.end());
  CHECK(std::adjacent_find(vertices.begin(), vertices.end()) == vertices.end());
}

TEST_CASE("mesh: every model of the corpus is read", "[mesh][corpus]") {
  const auto path = corpus("models");
  if (!path) return;
  for (const auto& entry : std::filesystem::directory_iterator(*path)) {
    if (entry.path().extension() != ".stl") continue;
    INFO(entry.path());
    const Loaded loaded = read_file(entry.path().string());
    CHECK(loaded.objects.size() == 1);
    CHECK(volume_mm3(loaded.objects[0].mesh) > 0);
  }
}
