// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/program.h"

#include <array>
#include <cmath>
#include <iterator>
#include <set>
#include <sstream>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using Catch::Matchers::Contains;
using nlohmann::json;

TEST_CASE("infill: meshes that a profile names have an infill of their own, and verify knows what they held") {
  Scratch scratch;
  scratch.write("box.stl", box_stl(30, 30, 8));
  scratch.write("core.stl", box_stl(12, 12, 8));
  scratch.write("my.ini", "infill_modifiers = core.stl:80:gyroid\n");
  const auto slice = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"slice", "box.stl", "--report", "-"};
    words.insert(words.end(), more.begin(), more.end());
    const auto run = weft(words, scratch.path());
    INFO(run.err);
    REQUIRE(run.status == 0);
    return json::parse(run.out);
  };
  const auto without = slice({"-o", "without.gcode"}), with = slice({"-p", "my.ini", "-o", "with.gcode"});
  CHECK(with["features"]["infill"]["mm3"].get<double>() > 1.2 * without["features"]["infill"]["mm3"].get<double>());
  REQUIRE(with["infill_files"].size() == 1);
  CHECK(with["infill_files"][0]["key"] == "infill_modifiers");
  const auto verify = [&] { return weft({"verify", "with.gcode"}, scratch.path()); };
  const auto same = verify();
  INFO(same.err);
  CHECK(same.status == 0);
  scratch.write("core.stl", box_stl(13, 12, 8));
  const auto changed = verify();
  CHECK(changed.status == 3);
  CHECK_THAT(changed.err, Contains("is not the infill_modifiers that with.gcode was made of: its sha256 is another"));
}

TEST_CASE("infill: directions that stand still against the part are turned with it") {
  Scratch scratch;
  scratch.write("box.stl", box_stl(30, 30, 4));
  const auto lines = [&](const std::string& frame) {
    const auto run = weft({"slice", "box.stl", "--rotate", "90", "-s", "infill_pattern=aligned", "-s", "infill_angle=0",
                           "-s", "infill_angle_frame=" + frame, "-o", frame + ".gcode"},
                          scratch.path());
    INFO(run.err);
    REQUIRE(run.status == 0);
    return scratch.read(frame + ".gcode");
  };
  CHECK(lines("plate") != lines("part"));
}

namespace {

/// A tube on the plate, mm.
std::string tube_stl(double inner, double outer, double height) {
  constexpr int sides = 90;
  std::ostringstream out;
  const auto at = [](double radius, int side, double z) {
    const double a = 2 * M_PI * side / sides;
    return std::array{radius * std::cos(a), radius * std::sin(a), z};
  };
  using Corner = std::array<double, 3>;
  const auto quad = [&](Corner a, Corner b, Corner c, Corner d) {
    for (const auto& face : {std::array{a, b, c}, std::array{a, c, d}}) {
      out << "facet normal 0 0 0\nouter loop\n";
      for (const Corner& p : face) out << "vertex " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
      out << "endloop\nendfacet\n";
    }
  };
  out << "solid tube\n";
  for (int i = 0; i < sides; ++i) {
    quad(at(outer, i, 0), at(outer, i + 1, 0), at(outer, i + 1, height), at(outer, i, height));
    quad(at(inner, i + 1, 0), at(inner, i, 0), at(inner, i, height), at(inner, i + 1, height));
    quad(at(inner, i, height), at(outer, i, height), at(outer, i + 1, height), at(inner, i + 1, height));
    quad(at(inner, i + 1, 0), at(outer, i + 1, 0), at(outer, i, 0), at(inner, i, 0));
  }
  out << "endsolid tube\n";
  return out.str();
}

}  // namespace

TEST_CASE("infill: between the walls of a tube solid lines run around it and fill it") {
  Scratch scratch;
  scratch.write("tube.stl", tube_stl(10, 13.7, 3));
  const auto run = weft({"slice", "tube.stl", "-o", "out.gcode", "--report", "-", "-s", "wall_line_width_0=0.45", "-s",
                         "wall_line_width_x=0.45", "-s", "skin_line_width=0.45", "-s", "wall_line_count=3", "-s",
                         "layer_height=0.2", "-s", "nozzle_diameter=0.4"},
                        scratch.path());
  INFO(run.err);
  REQUIRE(run.status == 0);
  std::istringstream lines(scratch.read("out.gcode"));
  double x = 0, y = 0, way_x = 0, way_y = 0, mm = 0;
  bool solid = false;
  int turns = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line == ";TYPE:Internal infill") break;  // what is above it is a bridge at first
    if (line.rfind(";TYPE:", 0) == 0) solid = line == ";TYPE:Solid infill", way_x = way_y = 0;
    if (line.rfind("G1 ", 0) != 0 && line.rfind("G0 ", 0) != 0) continue;
    const auto word = [&](char name, double usual) {
      const auto found = line.find(std::string(" ") + name);
      return found == std::string::npos ? usual : std::stod(line.substr(found + 2));
    };
    const double to_x = word('X', x) - x, to_y = word('Y', y) - y, length = std::hypot(to_x, to_y);
    const bool laid = solid && line.find(" E") != std::string::npos && length > 0;
    if (laid) {
      mm += length;
      turns += to_x * way_x + to_y * way_y < 0;  // by more than 90°
    }
    if (length > 0) way_x = laid ? to_x : 0, way_y = laid ? to_y : 0;
    x += to_x, y += to_y;
  }
  CHECK(mm > 600);
  CHECK(turns == 0);
}

namespace {

/// Y of the sparse lines along X in one layer, microns, upwards.
std::vector<int> rows_of(const std::string& gcode, int layer) {
  std::set<int> out;
  std::istringstream lines(gcode);
  double x = 0, y = 0;
  bool sparse = false;
  int at = -1;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind(";LAYER_CHANGE", 0) == 0) ++at;
    if (line.rfind(";TYPE:", 0) == 0) sparse = line == ";TYPE:Internal infill";
    if (line.rfind("G1 ", 0) != 0 && line.rfind("G0 ", 0) != 0) continue;
    const auto word = [&](char name, double usual) {
      const auto found = line.find(std::string(1, ' ') + name);
      return found == std::string::npos ? usual : std::stod(line.substr(found + 2));
    };
    const double nx = word('X', x), ny = word('Y', y);
    if (sparse && at == layer && ny == y && std::abs(nx - x) > 5 && line.find(" E") != std::string::npos)
      out.insert(static_cast<int>(std::lround(1000 * y)));
    x = nx, y = ny;
  }
  return {out.begin(), out.end()};
}

}  // namespace

TEST_CASE("infill: lines of copies go on in each other where they stand still against the plate") {
  Scratch scratch;
  scratch.write("box.stl", box_stl(30, 30, 4));
  struct Rows {
    std::vector<int> lower, upper;
  };
  const auto rows = [&](const std::string& frame) {
    const auto run = weft({"slice", "box.stl", "--copies", "4", "--spacing", "7.3", "-s", "infill_pattern=aligned",
                           "-s", "infill_angle=0", "-s", "infill_phase_frame=" + frame, "-o", "out.gcode"},
                          scratch.path());
    INFO(run.err);
    REQUIRE(run.status == 0);
    const auto all = rows_of(scratch.read("out.gcode"), 10);
    const auto half = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    REQUIRE(all.size() > 16);
    REQUIRE(*half - *std::prev(half) > 7'300);  // two rows of copies
    return Rows{{all.begin(), half}, {half, all.end()}};
  };
  const auto off = [](int apart, double pitch) { return std::abs(std::remainder(apart, pitch)); };
  const auto on_plate = rows("plate"), of_part = rows("part");
  const double pitch = (on_plate.lower[6] - on_plate.lower[1]) / 5.0;
  CHECK(off(on_plate.upper[3] - on_plate.lower[3], pitch) < 60);  // places are told in hundredths of a millimetre
  CHECK(off(37'300, pitch) > 200);
  REQUIRE(of_part.upper.size() == of_part.lower.size());
  for (std::size_t i = 0; i < of_part.lower.size(); ++i) CHECK(of_part.upper[i] - of_part.lower[i] == 37'300);
}

TEST_CASE("infill: a modifier of sparse infill leaves walls and skins of a part that is solid throughout as they are") {
  Scratch scratch;
  scratch.write("box.stl", box_stl(50, 50, 10));
  const auto slice = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"slice", "box.stl", "-o", "out.gcode", "--report", "-"};
    words.insert(words.end(), more.begin(), more.end());
    const auto run = weft(words, scratch.path());
    INFO(run.err);
    REQUIRE(run.status == 0);
    return json::parse(run.out)["features"];
  };
  const auto mm3 = [](const json& of, const char* feature) {
    return of.contains(feature) ? of[feature]["mm3"].get<double>() : 0;
  };
  const std::string core = "box:10,10,3,40,40,7";
  const auto plain = slice({}), solid = slice({"-s", "infill_sparse_density=100"});
  const auto hollowed = slice({"-s", "infill_sparse_density=100", "--modifier", core, "infill_sparse_density=10"});
  const auto filled = slice({"--modifier", core, "infill_sparse_density=100"});
  for (const char* walls : {"outer_wall", "inner_wall"}) {
    CHECK(mm3(hollowed, walls) == Approx(mm3(solid, walls)).epsilon(1e-6));
    CHECK(mm3(filled, walls) == Approx(mm3(plain, walls)).epsilon(1e-6));
  }
  CHECK(mm3(hollowed, "infill") == Approx(0.1 * 3600).epsilon(0.03));
  CHECK(mm3(hollowed, "bridge") > 0);  // over the core
  CHECK(mm3(solid, "bridge") == 0);
  CHECK(mm3(filled, "bridge") > mm3(plain, "bridge") + 100);  // below the core
  CHECK(mm3(filled, "infill") == Approx(mm3(plain, "infill") - 0.2 * 3600).epsilon(0.05));
}
