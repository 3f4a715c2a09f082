// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/flow.h"
#include "preview/preview.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

using namespace weft;
using namespace weft::preview;

namespace {

/// E of a bead of that line width, 0.2 mm high, over `length_mm`, with filament of 1.75 mm.
std::string extrude(double width_mm, double length_mm, double share = 1) {
  return fmt::format("E{:.6f}", share * flow::area_mm2(width_mm, 0.2) * length_mm / 2.405282);
}

std::string two_layers() {
  return fmt::format(
      "G28\nM83\nG1 Z0.3 F600\nG1 X5 Y5 F6000\nG1 X50 E3 F900\n"
      ";LAYER_CHANGE\n;Z:0.2\n;HEIGHT:0.2\nG1 Z0.2\n;TYPE:External perimeter\n;WIDTH:0.45\nG1 X10 Y10 F9000\n"
      "G1 X20 Y10 {} F1800\n;WIDTH:0.6\nG1 X20 Y20 {}\n"
      ";LAYER_CHANGE\n;Z:0.4\n;HEIGHT:0.2\nG1 Z0.4\n;TYPE:Perimeter\n;WIDTH:0.2\nG1 X0 Y0\nG1 X10 Y0 {}\n",
      extrude(0.45, 10), extrude(0.6, 10), extrude(0.2, 10, 0.5));
}

std::vector<Stroke> extruded(const PathLayer& layer, const Toolpaths& paths, std::string_view feature) {
  std::vector<Stroke> out;
  for (const Stroke& s : layer.strokes)
    if (s.extrudes() && paths.features[s.feature] == feature) out.push_back(s);
  return out;
}

}  // namespace

TEST_CASE("preview: width, speed, flow and feature are read back from filament, feed rate and comments", "[preview]") {
  const auto paths = read(two_layers(), 1750);
  REQUIRE(paths.layers.size() == 2);
  CHECK(paths.layers[0].z == 200);
  CHECK(paths.layers[1].z == 400);
  CHECK(paths.layers[1].height == 200);
  const auto walls = extruded(paths.layers[0], paths, "outer_wall");
  REQUIRE(walls.size() == 2);
  CHECK(walls[0].from == Point{10'000, 10'000});
  CHECK(walls[0].to == Point{20'000, 10'000});
  CHECK(std::abs(walls[0].width - 450) <= 1);
  CHECK(std::abs(walls[1].width - 600) <= 1);
  CHECK(walls[0].speed_mm_s == Approx(30));
  CHECK(walls[0].flow_mm3_s == Approx(30 * flow::area_mm2(0.45, 0.2)).epsilon(0.001));
  CHECK(walls[0].line == 13);
  CHECK_FALSE(walls[0].compensated);
  CHECK(extruded(paths.layers[0], paths, "custom").size() == 1);
}

TEST_CASE("preview: a bead with less filament than its announced width takes is marked", "[preview]") {
  const auto paths = read(two_layers(), 1750);
  const auto walls = extruded(paths.layers[1], paths, "inner_wall");
  REQUIRE(walls.size() == 1);
  CHECK(walls[0].compensated);
  CHECK(svg(paths, {.layer = 1}).find("flow reduced") != std::string::npos);
  CHECK(svg(paths, {.layer = 0}).find("flow reduced") == std::string::npos);
}

TEST_CASE("preview: a layer that begins with a bridge is as high as the file says of it, and not as its strands",
          "[preview]") {
  const auto paths = read(
      fmt::format(
          "M83\n;LAYER_CHANGE\n;Z:0.2\n;HEIGHT:0.2\nG1 Z0.2\n;TYPE:Perimeter\nG1 X0 Y0\nG1 X10 Y0 {}\n"
          ";LAYER_CHANGE\n;Z:0.4\n;HEIGHT:0.2\nG1 Z0.4\n;TYPE:Bridge infill\n;HEIGHT:0.4\nG1 X0 Y0\nG1 X10 Y0 {}\n",
          extrude(0.45, 10), extrude(0.45, 10)),
      1750);
  REQUIRE(paths.layers.size() == 2);
  CHECK(paths.layers[1].height == 200);
  CHECK(extruded(paths.layers[1], paths, "bridge").front().height == 400);
}

TEST_CASE("preview: without comments, layers are told by height", "[preview]") {
  const auto paths = read("G90\nM83\nG0 X0 Y0 Z0.2\nG1 X10 E1\nG1 Y10 E1\nG0 Z0.8\nG0 X0 Y0\nG0 Z0.4\nG1 X10 E1", 1750);
  REQUIRE(paths.layers.size() == 2);
  CHECK(paths.layers[0].z == 200);
  CHECK(paths.layers[1].z == 400);
  CHECK(paths.layers[1].height == 200);
  CHECK(extruded(paths.layers[1], paths, "").size() == 1);
}

TEST_CASE("preview: an arc becomes pieces that stay on it", "[preview]") {
  const auto paths = read("G90\nM83\nG0 X10 Y0 Z0.2\nG3 X-10 Y0 I-10 J0 E2", 1750);
  REQUIRE(paths.layers.size() == 1);
  const auto pieces = extruded(paths.layers[0], paths, "");
  REQUIRE(pieces.size() > 10);
  Point at{10'000, 0};
  for (const Stroke& s : pieces) {
    CHECK(s.from == at);
    at = s.to;
    const Point middle = lerp(s.from, s.to, 0.5);
    CHECK(distance({0, 0}, middle) == Approx(10'000).margin(11));
    CHECK(middle.y > 0);
  }
  CHECK(at == Point{-10'000, 0});
}

TEST_CASE("preview: what is no G-code has no layers, and damaged G-code is drawn as far as it can be understood",
          "[preview]") {
  CHECK(read("", 1750).layers.empty());
  CHECK(read("<html>\nnot G-code at all\n", 1750).layers.empty());
  const std::string damaged = two_layers() + std::string("G1 Xnan Y1e999 E\0\n", 18) + "G1 X99999999 Y0 E1\nG1 X5\rG1";
  const auto paths = read(damaged, 1750);
  REQUIRE(paths.layers.size() == 2);
  CHECK(extruded(paths.layers[0], paths, "outer_wall").size() == 2);
}

TEST_CASE("preview: a picture without legend is the drawing alone", "[preview]") {
  const auto paths = read(two_layers(), 1750);
  const auto width = [](const std::vector<std::uint8_t>& png) { return png[18] * 256 + png[19]; };  // in IHDR
  CHECK(width(png(paths, {.size = 400, .layer = 0})) > 600);
  CHECK(width(png(paths, {.size = 400, .layer = 0, .legend = false})) <= 400);
}

TEST_CASE("preview: an arc has as many pieces as a picture of it shows, however large it is", "[preview]") {
  const auto pieces = [](double radius_mm, Chord chord) {
    const auto gcode = fmt::format("M83\n;LAYER:0\nG1 Z0.2\nG1 X10 Y10 F900\nG2 X10 Y10 I{0} J0 E1\n", radius_mm);
    return read(gcode, 1750, chord).layers.at(0).strokes.size();
  };
  CHECK(pieces(5, {}) >= 30);
  CHECK(pieces(500, {}) <= 120);
  CHECK(pieces(500, {}) >= 60);
  CHECK(pieces(500, {.mm = 0.01, .share = 0}) >= 400);  // through a window
}

TEST_CASE("preview: a file whose comments tell of no layers has those that its heights make", "[preview]") {
  const auto paths = read(  // as Slic3r 1.3 writes it
      "; Filament gcode\nG21 ; set units to millimeters\nM82\nG92 E0\nG1 Z0.2 F600\nG1 X10 Y10 F6000\nG1 X20 E1 "
      "F1800\nG1 Z0.4 F600\nG1 X20 Y20\nG1 "
      "X10 E2\n"
      "; Filament-specific end gcode \n",
      1750);
  REQUIRE(paths.layers.size() == 2);
  CHECK(paths.layers[1].z == 400);
  CHECK(paths.layers[1].height == 200);
}
