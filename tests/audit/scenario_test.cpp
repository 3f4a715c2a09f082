// SPDX-License-Identifier: GPL-3.0-or-later
// The scenarios that the boundary audit must hold, and the motions and volumes they are made of.
#include "audit/audit_fixture.h"

#include <cmath>

#include <fmt/format.h>

namespace weft::audit {

namespace {

/// A closed square of extrusions about the middle of the bed, `half` mm from it.
std::string square(double half, double width, std::string_view type) {
  const double low = 100 - half, high = 100 + half;
  std::string out = fmt::format(";TYPE:{}\n;WIDTH:{}\nG1 X{} Y{} F9000\n", type, width, low, low);
  const double corner[][2] = {{high, low}, {high, high}, {low, high}, {low, low}};
  for (const auto& c : corner) out += fmt::format("G1 X{} Y{} E5\n", c[0], c[1]);
  return out;
}

}  // namespace

TEST_CASE("audit: a skirt around a part as large as the bed is found on all four sides", "[audit]") {
  const Bench bench;
  const auto report = bench.moves(square(97.5, 0.45, "External perimeter") + square(107.5, 0.45, "Skirt/Brim"));
  CHECK(report.verdict == Verdict::rejected);
  for (const Side side : {Side::minus_x, Side::plus_x, Side::minus_y, Side::plus_y})
    CHECK(count_of(report, Finding::Kind::surface, side) >= 1);
  // Each side of the skirt leads on its own side of the bed.
  std::vector<Side> led;
  for (const auto& f : report.findings)
    if (f.move == Motion::Kind::extrude) {
      CHECK(f.feature == "skirt");
      CHECK(f.outside == 7704);  // half the band of 0.407 mm beyond 7.5 mm
      led.push_back(f.side);
    }
  CHECK(led == std::vector{Side::minus_y, Side::plus_x, Side::plus_y, Side::minus_x});
}

TEST_CASE("audit: a brim wider than what is left of the bed is found", "[audit]") {
  const Bench bench;
  const auto report =
      bench.moves(square(95, 0.45, "Outer wall") + square(99.79, 0.45, "Brim") + square(100.2, 0.45, "Brim"));
  CHECK(report.violation_count == 5);  // the last loop and the travel to it
  for (const auto& f : report.findings) CHECK(f.feature == "brim");
}

TEST_CASE("audit: a part exactly as large as the bed passes, and one a tolerance larger does not", "[audit]") {
  const Bench bench;
  CHECK(bench.moves(square(100 - 0.20354, 0.45, "External perimeter")).clean());
  CHECK(bench.moves(square(100 - 0.20354 + 0.009, 0.45, "External perimeter")).clean());
  CHECK(bench.moves(square(100 - 0.20354 + 0.011, 0.45, "External perimeter")).violation_count == 4);
}

TEST_CASE("audit: without a stated width the bead is as wide as its volume makes it", "[audit]") {
  const Bench bench;
  // 0.2 mm high, 10 mm long, 0.5 mm wide: 1 mm³ of filament of 1.75 mm.
  const double e = 1.0 / 2.405281875;
  const auto line = [&](double x) { return fmt::format("G1 X{} Y10\nG1 X{} Y20 E{:.5f}\n", x, x, e); };
  CHECK(bench.moves(line(199.75)).clean());
  const auto report = bench.moves(line(199.80));
  REQUIRE(report.violation_count == 1);
  CHECK(report.findings[0].outside == Approx(50).margin(2));
}

TEST_CASE("audit: a helical lift that swings over the edge is found although both its ends are inside", "[audit]") {
  const Bench bench;
  const auto report = bench.moves("G1 X199.5 Y50 F9000\nG17\nG3 Z0.6 I1 J0 P1 F9000\n");
  REQUIRE(report.violation_count == 1);
  CHECK(report.findings[0].line == 9);
  CHECK(report.findings[0].side == Side::plus_x);
  CHECK(report.findings[0].outside == 1500);
  CHECK(report.findings[0].move == Motion::Kind::lift_spiral);
  CHECK(bench.moves("G1 X190 Y50\nG1 X201 Y50 Z0.6\n").findings.at(0).move == Motion::Kind::lift_slope);
  CHECK(bench.moves("G1 X199.5 Y50\nG1 Z0.6\n").clean());
  CHECK(bench.moves("G1 X199.5 Y50\nG1 X199 Y51 Z0.6\n").clean());
}

TEST_CASE("audit: an arc that bulges past the edge is found although its end points are inside", "[audit]") {
  const Bench bench;
  for (const auto* arc : {"G3 X199 Y110 I-4 J5 E1", "G3 X199 Y110 R6.403 E1", "G3 X199 Y110 R-6.403 E1"}) {
    const auto report = bench.moves(fmt::format(";WIDTH:0.4\nG1 X199 Y100\n{}\n", arc));
    CAPTURE(arc);
    REQUIRE(report.violation_count == 1);
    CHECK(report.findings[0].line == 9);
    CHECK(report.findings[0].side == Side::plus_x);
  }
  // Bulging the other way is inside.
  for (const auto* arc :
       {"G2 X199 Y110 I4 J5 E1", "G2 X199 Y110 I-40 J5 E1", "G2 X199 Y110 R6.403 E1", "G2 X199 Y110 R-6.403 E1"})
    CHECK(bench.moves(fmt::format(";WIDTH:0.4\nG1 X199 Y100\n{}\n", arc)).clean());
  CHECK(bench.moves(";WIDTH:0.4\nG1 X199 Y100\nG2 X199 Y110 I40 J5 E1\n").clean());
  CHECK(bench.moves(";WIDTH:0.4\nG1 X199 Y100\nG3 X199 Y110 R-1000000 E1\n").violation_count == 1);
}

TEST_CASE("audit: full circles and several turns are judged by their whole extent", "[audit]") {
  const Bench bench;
  CHECK(bench.moves("G1 X190 Y100\nG2 I5 J0\n").clean());
  CHECK(bench.moves("G1 X190 Y100\nG2 I5.1 J0\n").violation_count == 1);
  CHECK(bench.moves("G1 X190 Y100\nG2 X190 Y100 I5.1 J0\n").violation_count == 1);
  CHECK(bench.moves("G1 X190 Y100\nG3 X190.1 Y100 I5.1 J0 P2\n").violation_count == 1);
}

TEST_CASE("audit: a travel that cuts the notch of a concave bed is found although its ends are inside", "[audit]") {
  Bench bench;
  bench.machine.bed_shape = BedShape::polygon;  // a U
  bench.machine.bed_polygon = {{0, 0},           {200_mm, 0},     {200_mm, 200_mm}, {150_mm, 200_mm},
                               {150_mm, 120_mm}, {50_mm, 120_mm}, {50_mm, 200_mm},  {0, 200_mm}};
  CHECK(bench.moves("G1 X25 Y60\nG1 X25 Y180\nG1 X25 Y60\nG1 X175 Y60\nG1 X175 Y180\n").clean());
  const auto report = bench.moves("G1 X25 Y60\nG1 X25 Y180\nG1 X175 Y180\n");
  REQUIRE(report.violation_count == 1);
  CHECK(report.findings[0].line == 9);
  CHECK(report.findings[0].outside == Approx(50000).margin(50));
  // Along the edge of the notch is inside; with half a bead it is not.
  CHECK(bench.moves("G1 X25 Y120\nG1 X175 Y120\n").clean());
  CHECK(bench.moves(";WIDTH:0.4\nG1 X25 Y119.9\nG1 X175 Y119.9 E5\n").violation_count == 1);
  CHECK(bench.moves(";WIDTH:0.4\nG1 X25 Y119.82\nG1 X175 Y119.82 E5\n").clean());
}

TEST_CASE("audit: a move through a no-go area is found by its whole length, and only below the area's height",
          "[audit]") {
  Bench bench;
  bench.machine.bed_exclude_areas = {{{90_mm, 40_mm}, {110_mm, 40_mm}, {110_mm, 60_mm}, {90_mm, 60_mm}},
                                     {{190_mm, 0}, {200_mm, 0}, {200_mm, 10_mm}}};
  bench.machine.exclude_height = 20_mm;
  const auto through = bench.moves("G1 X80 Y50\nG1 X120 Y50\n");
  REQUIRE(through.violation_count == 1);
  CHECK(through.findings[0].kind == Finding::Kind::no_go);
  CHECK(through.findings[0].area == 1);
  CHECK(through.findings[0].outside == Approx(10000).margin(20));
  CHECK(bench.moves("G1 X80 Y50\nG1 Z20\nG1 X120 Y50\n").clean());
  CHECK(bench.moves("G1 X80 Y50\nG1 Z19.9\nG1 X120 Y50\n").violation_count == 1);
  CHECK(bench.moves("G1 X80 Y40\nG1 X120 Y40\n").clean());                                  // along its edge
  CHECK(bench.moves(";WIDTH:0.4\nG1 X80 Y39.9\nG1 X120 Y39.9 E5\n").violation_count == 1);  // half a bead inside
  CHECK(bench.moves("G1 X80 Y50\nG3 X120 Y50 I20 J0\n").clean());                           // an arc around it
  CHECK(bench.moves("G1 X80 Y50\nG3 X120 Y50 I20 J-30\n").violation_count == 1);
  CHECK(bench.moves("G1 X189 Y5\nG1 X199 Y20\n").clean());
  CHECK(bench.moves("G1 X195 Y9\nG1 X198 Y4\n").findings.at(0).area == 2);
}

TEST_CASE("audit: a round bed is a circle, not its corners", "[audit]") {
  Bench bench;
  bench.machine.bed_shape = BedShape::circle;
  bench.machine.machine_center_is_zero = true;
  const auto at = [&](double angle_rad, double radius) {
    return bench(fmt::format("G28\n;LAYER_CHANGE\nG1 X0 Y0 Z1\nG1 X{:.4f} Y{:.4f}\n", radius * std::cos(angle_rad),
                             radius * std::sin(angle_rad)));
  };
  for (int i = 0; i < 64; ++i) {
    CHECK(at(0.1 * i, 99.999).clean());
    const auto report = at(0.1 * i, 100.02);
    REQUIRE(report.violation_count == 1);
    CHECK(report.findings[0].outside == Approx(20).margin(1));
  }
  CHECK(bench("G28\n;LAYER_CHANGE\nG1 X60 Y0 Z1\nG3 X-60 Y0 I-60 J0\nG3 X60 Y0 I60 J0\n").clean());
  CHECK(bench("G28\n;LAYER_CHANGE\nG1 X60 Y0 Z1\nG3 X60 Y0.1 I20.2 J0\n").violation_count == 1);
}

TEST_CASE("audit: an ordinary print has no finding and every move of it is audited", "[audit]") {
  const Bench bench;
  std::string print = "; generated by hand\nG28\nG90\nM82\nG92 E0\n";
  double e = 0;
  for (int layer = 0; layer < 20; ++layer) {
    print +=
        fmt::format(";LAYER_CHANGE\n;Z:{0:.2f}\n;HEIGHT:0.2\nG1 Z{0:.2f} F600\n;TYPE:External perimeter\n;WIDTH:0.45\n",
                    0.2 * (layer + 1));
    for (int i = 0; i <= 40; ++i) {
      const double a = 0.157 * i;
      print += fmt::format("G1 X{:.3f} Y{:.3f}", 100 + 50 * std::cos(a), 100 + 50 * std::sin(a));
      print += i == 0 ? "\n" : fmt::format(" E{:.5f}\n", e += 0.3);
    }
  }
  const auto report = bench(print);
  CHECK(report.clean());
  CHECK(report.checked_moves == 20 * 42);
  CHECK(report.unaudited_moves == 0);
  CHECK(report.coverage() == 1);
}

TEST_CASE("audit: a purge line at Y-3 passes when the reach says so, and is custom G-code when it does not",
          "[audit]") {
  // As PrusaSlicer writes the stock start G-code of an MK3.
  const std::string_view start =
      ";TYPE:Custom\nM862.3 P \"MK3S\" ; printer model check\nM115 U3.13.2\nG90 ; use absolute coordinates\nM83 ; "
      "extruder relative mode\n"
      "G28 W ; home all without mesh bed level\nG80 ; mesh bed leveling\nG1 Z0.2 F720\nG1 Y-3 F1000 ; go outside print "
      "area\nG92 E0\n"
      "G1 X60 E9 F1000 ; intro line\nG1 X100 E12.5 F1000 ; intro line\nG92 E0\nM221 S95\nG21 ; set units to "
      "millimeters\n"
      ";LAYER_CHANGE\n;Z:0.2\n;HEIGHT:0.2\nG1 Z0.2 F9000\nG1 X100 Y100\n;TYPE:External perimeter\n;WIDTH:0.45\nG1 X110 "
      "Y100 E0.4\n";
  Bench bench;
  const auto refused = bench(start);
  REQUIRE(refused.violation_count == 5);  // out, along twice, up, and back in
  CHECK(refused.findings[0].line == 9);
  for (const auto& f : refused.findings) {
    if (f.line < 16) CHECK(f.feature == "custom");
    CHECK(f.side == Side::minus_y);
    CHECK(f.kind == Finding::Kind::reach);
    CHECK(f.outside == 3000);
  }
  bench.machine.machine_reach = {{0, -5_mm}, {200_mm, 200_mm}};
  const auto passed = bench(start);
  CHECK(passed.reach_beyond == std::array<Um, 6>{0, 0, 5_mm, 0, 0, 0});
  CHECK(passed.clean());
  CHECK(passed.opaque.size() == 1);
  CHECK(passed.opaque[0].name == "G80");
  // The print itself may still not go there.
  CHECK(bench(std::string(start) + "G1 X100 Y-2\nG1 X110 Y-2 E0.4\n").violation_count == 1);
}

TEST_CASE("audit: relative moves, shifted origins and inches are judged in machine coordinates", "[audit]") {
  Bench bench;
  CHECK(bench.moves("G91\nG1 X60\nG1 X39.9\n").clean());
  CHECK(bench.moves("G91\nG1 X60\nG1 X40.1\n").findings.at(0).line == 9);
  CHECK(bench.moves("G92 X0\nG1 X-100\nG1 X100\n").clean());
  CHECK(bench.moves("G92 X0\nG1 X100.5\n").findings.at(0).outside == 500);
  CHECK(bench.moves("G92 X0\nG1 X-100.5\n").findings.at(0).side == Side::minus_x);
  CHECK(bench.moves("G92 X500\nG28 X\nG1 X150\n").clean());
  CHECK(bench.moves("G20\nG1 X7.8 Y1\n").clean());
  CHECK(bench.moves("G20\nG1 X7.9 Y1\n").findings.at(0).outside == Approx(660).margin(1));
  CHECK(bench.moves("G20\nG91\nG2 X0.5 Y0 I0.25 J0\nG21\nG90\nG1 X199\n").clean());
  // What not every build of a firmware knows is not audited.
  CHECK(bench.moves("G92 X0\nG92.1\nG1 X200\n").verdict == Verdict::unaudited);
  CHECK(bench.moves("G92 X500\nG53 G1 X150\nG1 X550\n").verdict == Verdict::unaudited);
  bench.machine.firmware = Firmware::smoothie;
  CHECK(bench.moves("G92 X0\nG92.1\nG1 X200\n").clean());
  CHECK(bench.moves("G92 X500\nG53 G1 X150\nG1 X550\n").clean());
}

TEST_CASE("audit: the nozzle's offset moves the print, not the reach", "[audit]") {
  Bench bench;
  bench.machine.nozzle_offsets = {{0, 0}, {18_mm, 0}};
  CHECK(bench.moves(";WIDTH:0.4\nG1 X190 Y50\nG1 X190 Y60 E1\n").clean());
  const auto second = bench.moves("T1\n;WIDTH:0.4\nG1 X190 Y50 Z0.2\nG1 X190 Y60 E1\n");
  REQUIRE(second.violation_count == 1);
  CHECK(second.findings[0].outside == 8179);
}

TEST_CASE("audit: too high and too low are found", "[audit]") {
  const Bench bench;
  CHECK(bench.moves("G1 Z200\n").clean());
  CHECK(bench.moves("G1 Z200.1\n").findings.at(0).side == Side::plus_z);
  CHECK(bench.moves("G1 Z-0.1\n").findings.at(0).side == Side::minus_z);
  CHECK(bench.moves("G1 Z200.1\n").findings.at(0).move == Motion::Kind::lift);
}

}  // namespace weft::audit
