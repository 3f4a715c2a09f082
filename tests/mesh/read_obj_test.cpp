// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/face.h"
#include "mesh/fixtures.h"
#include "mesh/formats.h"
#include "tasks/tasks.h"

#include <numeric>
#include <random>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::mesh;
using namespace fixtures;
using Catch::Contains;

namespace {

const std::string corners = "v 0 0 0\nv 20 0 0\nv 20 20 0\nv 0 20 0\nv 0 0 20\nv 20 0 20\nv 20 20 20\nv 0 20 20\n";
const std::string cube = "# a cube\nmtllib x.mtl\no the cube\n" + corners +
                         "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

std::string replaced(std::string text, std::string_view old, std::string_view put) {
  for (std::size_t at = 0; (at = text.find(old, at)) != text.npos; at += put.size()) text.replace(at, old.size(), put);
  return text;
}

enum class Order { mixed, vertices_first, faces_first };
enum class Numbers { from_one, backward, both };

/// A file of prisms in a row, 10 µm apart, over a hexagon that is not convex: where a face is cut shows.
struct Row {
  Order order;
  Numbers numbers;
  std::string gap;  ///< before the last corner of a face
  std::string eol;

  std::string text(int count) const {
    std::string all_vertices, all_faces, mixed;
    for (int i = 0; i < count; ++i) {
      const std::string own = vertices(i), sides = faces(i, order == Order::vertices_first ? count : i + 1);
      all_vertices += own, all_faces += sides, mixed += own + sides;
    }
    return "o a row" + eol +
           (order == Order::mixed            ? mixed
            : order == Order::vertices_first ? all_vertices + all_faces
                                             : all_faces + all_vertices);
  }

 private:
  std::string vertices(int i) const {
    constexpr int ring[6][2] = {{0, 0}, {8, 0}, {8, 8}, {4, 2}, {2, 8}, {0, 8}};
    std::string out;
    for (const int z : {0, 5})
      for (const auto& [x, y] : ring)
        out +=
            "v " + std::to_string(10 * i + x) + ".0e-3 ." + std::to_string(100 + y) + " 0.00" + std::to_string(z) + eol;
    return out;
  }
  /// @param known prisms whose vertices stand before the face
  std::string faces(int i, int known) const {
    std::string out;
    const auto face = [&](const std::vector<int>& ring) {
      out += "f";
      for (const int k : ring) {
        const bool backward = numbers == Numbers::backward || (numbers == Numbers::both && k % 3 == 0);
        out += (k == ring.back() ? gap : " ") + std::to_string(12 * i + k + (backward ? -12 * known : 1));
      }
      out += eol;
    };
    face({5, 4, 3, 2, 1, 0});
    face({6, 7, 8, 9, 10, 11});
    for (int k = 0; k < 6; ++k) face({k, (k + 1) % 6, (k + 1) % 6 + 6, k + 6});
    return out;
  }
};

double area2(const std::vector<Point3>& face, const Triangle& t) {
  return static_cast<double>(orient(flat(face[t[0]]), flat(face[t[1]]), flat(face[t[2]])));
}

}  // namespace

TEST_CASE("mesh: an OBJ of quadrangles is read, whatever ends its lines", "[mesh][obj]") {
  const std::string eol = GENERATE("\n", "\r\n", "\r");
  const Loaded loaded = read(replaced(cube, "\n", eol));
  CHECK(loaded.format == Format::obj);
  REQUIRE(loaded.objects.size() == 1);
  CHECK(loaded.objects[0].name == "the cube");
  CHECK(volume_mm3(loaded.objects[0].mesh) == Approx(8000));
  CHECK(loaded.objects[0].repairs == Repairs{.shells = 1});
}

TEST_CASE("mesh: OBJ indices may be negative, carry texture and normal, and go over two lines", "[mesh][obj]") {
  const Mesh expected = read(cube).objects[0].mesh;
  CHECK(read(replaced(cube, "f 4 3 2 1", "f -5 -6 -7 -8")).objects[0].mesh == expected);
  CHECK(read(replaced(cube, "f 4 3 2 1", "f 4/1 3/1 2/1 1/1")).objects[0].mesh == expected);
  CHECK(read(replaced(cube, "f 4 3 2 1", "f 4//1 3//2 2//3 1//4")).objects[0].mesh == expected);
  CHECK(read(replaced(cube, "f 4 3 2 1", "f 4/1/1 3/1/1 \\\n 2/1/1 1/1/1 # bottom")).objects[0].mesh == expected);
  CHECK(read(replaced(cube, "v 20 20 20", "v 20 20 20 1 0.5 0.5 0.5")).objects[0].mesh == expected);
}

TEST_CASE("mesh: an OBJ may list its faces before its vertices", "[mesh][obj]") {
  const std::string faces = cube.substr(cube.find("f 4"));
  CHECK(volume_mm3(read("o x\n" + faces + corners).objects[0].mesh) == Approx(8000));
}

TEST_CASE("mesh: a long OBJ is so many times the short one, in any pieces and threads, however its faces name vertices",
          "[mesh][obj][law]") {
  const auto order = GENERATE(Order::mixed, Order::vertices_first, Order::faces_first);
  const auto numbers = GENERATE(Numbers::from_one, Numbers::backward, Numbers::both);
  if (order == Order::faces_first && numbers != Numbers::from_one) return;  // there is nothing behind them
  const auto [gap, eol] = GENERATE(table<std::string, std::string>({{" ", "\n"}, {" ", " \r\n"}, {" \\\n \n ", "\r"}}));
  if (order == Order::faces_first && gap != " ") return;  // an OBJ is told by the first words of its lines
  const Row row{order, numbers, gap, eol};
  const std::string path = "part";
  const auto body = [&](std::string_view text, std::size_t piece_bytes) {
    return read_obj({text, path}, piece_bytes).bodies.front();
  };
  const std::string single = row.text(1);
  const Mesh one = body(single, single.size()).mesh;
  REQUIRE(one.vertices.size() == 12);
  REQUIRE(one.triangles.size() == 20);
  constexpr std::uint32_t count = 200;
  Mesh expected;
  for (std::uint32_t i = 0; i < count; ++i) {
    for (Point3 p : one.vertices) p.x += static_cast<Um>(10 * i), expected.vertices.push_back(p);
    for (const auto& [a, b, c] : one.triangles) expected.triangles.push_back({a + 12 * i, b + 12 * i, c + 12 * i});
  }
  const std::string text = row.text(count);
  for (const unsigned threads : {1U, 2U, 8U}) {
    const tasks::ThreadLimit limit(threads);
    for (const std::size_t piece_bytes : {std::size_t{1}, std::size_t{700}, std::size_t{40'000}, text.size()}) {
      const Body many = body(text, piece_bytes);
      CHECK(many.name == "a row");
      CHECK((many.mesh == expected));
    }
  }
}

TEST_CASE("mesh: what is wrong far into an OBJ is told with its face or vertex and its line", "[mesh][obj]") {
  const std::string text = Row{Order::mixed, Numbers::both, " ", "\n"}.text(2'500);
  REQUIRE(text.size() > 1 << 20);  // more than one piece
  const auto at_end = [&](std::string_view old, std::string_view put) {
    std::string copy = text;
    return copy.replace(copy.rfind(old), old.size(), put);
  };
  CHECK_THAT(refusal(at_end("\nv ", "\nv x")), Contains("part:49993: vertex 30000: x is 'x24990.0e-3', not a number"));
  CHECK_THAT(refusal(text + "f 1 2 30001\n"), Contains("part:50002: face 20001: vertex 30001 of 30000"));
  CHECK_THAT(refusal(text + "f 1 2 -30001\n"), Contains("part:50002: face 20001: vertex -30001 of 30000"));
  CHECK_THAT(refusal(text + "f 1 2\n"), Contains("part:50002: face 20001 has 2 corners"));
  CHECK_THAT(refusal("f 1 2 99999\n" + text), Contains("part:1: face 1: vertex 99999 of 30000"));
  CHECK_THAT(refusal("f 1 2 -1\n" + text), Contains("part:1: face 1: vertex -1 of 0"));
}

TEST_CASE("mesh: a damaged OBJ is refused with its line", "[mesh][obj]") {
  CHECK_THAT(refusal(replaced(cube, "v 20 20 20", "v 20 20")), Contains("part:10: vertex 7: z is missing"));
  CHECK_THAT(refusal(replaced(cube, "v 20 20 20", "v 20 nan 20")), Contains("part:10: vertex 7: y is not a number"));
  CHECK_THAT(refusal(replaced(cube, "v 20 20 20", "v 20 inf 20")), Contains("vertex 7: y is infinite"));
  CHECK_THAT(refusal(replaced(cube, "v 20 20 20", "v 20 2e5 20")), Contains("beyond ±16 m"));
  CHECK_THAT(refusal(replaced(cube, "v 20 20 20", "v 20 2,5 20")), Contains("y is '2,5', not a number"));
  CHECK_THAT(refusal(replaced(cube, "f 5 6 7 8", "f 5 6 7 9")), Contains("part:13: face 2: vertex 9 of 8"));
  CHECK_THAT(refusal(replaced(cube, "f 5 6 7 8", "f 5 6 7 0")), Contains("face 2: '0' is not the number of a vertex"));
  CHECK_THAT(refusal(replaced(cube, "f 5 6 7 8", "f 5 6 7 -9")), Contains("face 2: vertex -9 of 8"));
  CHECK_THAT(refusal(replaced(cube, "f 5 6 7 8", "f 5 6 7 99999999999999999999")), Contains("face 2"));
  CHECK_THAT(refusal(replaced(cube, "f 5 6 7 8", "f 5 6")), Contains("face 2 has 2 corners"));
  CHECK_THAT(refusal(corners), Contains("OBJ without a triangle"));
}

TEST_CASE("mesh: a face is cut into triangles of its own orientation that cover it once", "[mesh][law]") {
  std::mt19937 random(5);
  for (int run = 0; run < 300; ++run) {  // star-shaped polygons, most of them not convex, in one of three planes
    const std::size_t n = 3 + random() % 40;
    std::vector<Point3> face;
    for (std::size_t i = 0; i < n; ++i) {
      const double angle = 2 * M_PI * static_cast<double>(i) / static_cast<double>(n);
      const double r = 10'000 + static_cast<double>(random() % 90'000);
      face.push_back({rounded(r * std::cos(angle)), rounded(r * std::sin(angle)), 7});
    }
    const auto triangles = triangulated(face);
    REQUIRE(triangles.size() == n - 2);
    double sum = 0, sum_of_sizes = 0;
    for (const Triangle& t : triangles) sum += area2(face, t), sum_of_sizes += std::abs(area2(face, t));
    Ring ring;
    for (const Point3& p : face) ring.push_back(flat(p));
    CHECK(sum == Approx(static_cast<double>(double_area(ring))));
    CHECK(sum_of_sizes == sum);

    std::vector<Point3> upright, backward(face.rbegin(), face.rend());
    for (const Point3& p : face) upright.push_back({p.z, p.x, p.y});
    CHECK(triangulated(upright) == triangles);
    CHECK(triangulated(backward).size() == n - 2);
  }
}

TEST_CASE("mesh: a face that crosses itself still gives its triangles", "[mesh][law]") {
  std::mt19937 random(6);
  for (int run = 0; run < 200; ++run) {
    std::vector<Point3> face(4 + random() % 60);
    for (Point3& p : face)
      p = {static_cast<Um>(random() % 9), static_cast<Um>(random() % 9), static_cast<Um>(random() % 3)};
    CHECK(triangulated(face).size() == face.size() - 2);
  }
}

TEST_CASE("mesh: a face of very many corners is cut in n log n steps, into triangles that cover it once",
          "[mesh][law]") {
  constexpr int teeth = 150'000;  // a comb: cut ear by ear it takes minutes
  std::vector<Point3> face;
  for (int i = 0; i < teeth; ++i) face.push_back({20 * i, 0, 7}), face.push_back({20 * i + 10, 0, 7});
  for (int i = teeth - 1; i >= 0; --i) face.push_back({20 * i + 10, 900, 7}), face.push_back({20 * i + 5, 100, 7});
  double wanted = 0;
  const auto twice_area = [&](std::size_t a, std::size_t b, std::size_t c) {
    const double ux = face[b].x - face[a].x, uy = face[b].y - face[a].y;
    const double vx = face[c].x - face[a].x, vy = face[c].y - face[a].y;
    return ux * vy - uy * vx;
  };
  for (std::size_t i = 1; i + 1 < face.size(); ++i) wanted += twice_area(0, i, i + 1);
  const auto triangles = triangulated(face);
  REQUIRE(triangles.size() == face.size() - 2);
  double sum = 0;
  std::size_t wrong = 0;
  for (const auto& t : triangles) {
    const double area = twice_area(t[0], t[1], t[2]);
    wrong += area <= 0;
    sum += area;
  }
  CHECK(wrong == 0);
  CHECK(sum == wanted);
}

TEST_CASE("mesh: a large face may have a hole that a side leads to and back from, and one that crosses itself is a fan",
          "[mesh][law]") {
  std::vector<Point3> face;
  constexpr int n = 400;
  for (int i = 0; i < n; ++i) face.push_back({100 * i, 0, 0});
  for (int i = 0; i < n; ++i) face.push_back({100 * n, 100 * i, 0});
  face.push_back({100 * n, 100 * n, 0}), face.push_back({0, 100 * n, 0}), face.push_back({0, 20'000, 0});
  const std::vector<Point3> hole{{10'000, 20'000, 0}, {10'000, 30'000, 0}, {30'000, 30'000, 0}, {30'000, 10'000, 0},
                                 {10'000, 10'000, 0}, {10'000, 20'000, 0}, {0, 20'000, 0}};
  face.insert(face.end(), hole.begin(), hole.end());
  const auto triangles = triangulated(face);
  REQUIRE(triangles.size() == face.size() - 2);
  double sum = 0;
  for (const auto& t : triangles) {
    const Point3 a = face[t[0]], b = face[t[1]], c = face[t[2]];
    sum += (static_cast<double>(b.x) - a.x) * (static_cast<double>(c.y) - a.y) -
           (static_cast<double>(b.y) - a.y) * (static_cast<double>(c.x) - a.x);
  }
  CHECK(sum == 2 * (4e4 * 4e4 - 2e4 * 2e4));
  std::swap(face[100], face[500]);
  CHECK(triangulated(face).size() == face.size() - 2);
}
