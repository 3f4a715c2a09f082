// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/arcs.h"

#include "model/moves.h"
#include "motion/motion.h"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::motion;

namespace {

/// A closed bead along a circle about the origin, in pieces.
Extrude circle(double radius, int pieces, Point centre = {0, 0}) {
  Extrude bead{.path = {}, .role = Role::outer_wall, .height = 200};
  for (int i = 0; i <= pieces; ++i) {
    const double a = 2 * std::numbers::pi * i / pieces;
    bead.path.push_back(
        {{centre.x + rounded(radius * std::cos(a)), centre.y + rounded(radius * std::sin(a))}, 400, 1.F});
  }
  return bead;
}

/// How far points of the path, between junctions too, are from what is told: arcs, and straight pieces else.
double worst_um(const Extrude& bead) {
  double worst = 0;
  for (const Arc& arc : bead.arcs) {
    const double radius = distance(arc.centre, bead.path[arc.first].at);
    for (std::size_t i = arc.first; i < arc.last; ++i)
      for (int k = 0; k <= 20; ++k) {
        const Point a = bead.path[i].at, b = bead.path[i + 1].at;
        const double t = k / 20.0, x = a.x + t * (b.x - a.x) - arc.centre.x, y = a.y + t * (b.y - a.y) - arc.centre.y;
        worst = std::max(worst, std::abs(std::hypot(x, y) - radius));
      }
  }
  return worst;
}

double volume(const Extrude& bead, bool with_arcs) {
  Extrude plain = bead;
  if (!with_arcs) plain.arcs.clear();
  double sum = 0;
  for_each_move(
      plain, [&](const BeadMove& move) { sum += move.volume_mm3; }, [&](const Arc&, double mm3) { sum += mm3; });
  return sum;
}

}  // namespace

TEST_CASE("arcs: a round wall is a few arcs that stay within the tolerance and hold its plastic") {
  for (const double radius : {1500.0, 5000.0, 40000.0}) {
    for (const Um tolerance : {5, 12, 50}) {
      const int pieces = static_cast<int>(std::ceil(std::numbers::pi / std::acos(1 - 4 / radius)));  // 4 µm off
      Extrude bead = circle(radius, pieces);
      fit_arcs({.tolerance = tolerance, .room = {}}, bead);
      INFO(radius << " µm in " << pieces << " pieces, " << tolerance);
      CHECK(bead.arcs.size() <= 4);
      CHECK(worst_um(bead) <= tolerance + 1.5);
      for (const Arc& arc : bead.arcs) {
        CHECK(arc.ccw);
        CHECK(deviation_um(bead, arc) <= tolerance + 1.5);
      }
      CHECK(volume(bead, true) == Approx(volume(bead, false)));
    }
  }
}

TEST_CASE("arcs: quarter turns turn them, and mirror images mirror them") {
  Extrude bead = circle(7000, 90);
  for (std::size_t i = 0; i < bead.path.size(); ++i) bead.path[i].at.x += static_cast<Um>(i * i) / 3;  // no circle
  Extrude turned = bead, mirrored = bead;
  for (auto& j : turned.path) j.at = {-j.at.y, j.at.x};
  for (auto& j : mirrored.path) j.at = {-j.at.x, j.at.y};
  for (Extrude* each : {&bead, &turned, &mirrored}) fit_arcs({.tolerance = 12, .room = {}}, *each);
  REQUIRE(bead.arcs.size() > 2);
  REQUIRE(turned.arcs.size() == bead.arcs.size());
  REQUIRE(mirrored.arcs.size() == bead.arcs.size());
  for (std::size_t i = 0; i < bead.arcs.size(); ++i) {
    const Arc &a = bead.arcs[i], &b = turned.arcs[i], &c = mirrored.arcs[i];
    CHECK(b.centre == Point{-a.centre.y, a.centre.x});
    CHECK(c.centre == Point{-a.centre.x, a.centre.y});
    CHECK((b.first == a.first && b.last == a.last && b.ccw == a.ccw));
    CHECK((c.first == a.first && c.last == a.last && c.ccw != a.ccw));
  }
}

TEST_CASE("arcs: what is straight, has corners, or changes its width or speed is not told as one arc") {
  Extrude straight{.path = {}, .height = 200}, corners = straight;
  for (Um x = 0; x <= 20000; x += 1000) straight.path.push_back({{x, x % 2000 == 0 ? 0 : 8}, 400, 1.F});
  fit_arcs({.tolerance = 12, .room = {}}, straight);
  CHECK(straight.arcs.empty());
  for (int i = 0; i <= 6; ++i) {
    const double a = i * std::numbers::pi / 3;
    corners.path.push_back({{rounded(10000 * std::cos(a)), rounded(10000 * std::sin(a))}, 400, 1.F});
  }
  fit_arcs({.tolerance = 12, .room = {}}, corners);
  CHECK(corners.arcs.empty());
  Extrude wide = circle(7000, 90);
  for (std::size_t i = 0; i < wide.path.size(); ++i) wide.path[i].width = 400 + static_cast<Um>(i);
  fit_arcs({.tolerance = 12, .room = {}}, wide);
  CHECK(wide.arcs.size() >= 4);  // 90 µm in steps of 20
  for (const Arc& arc : wide.arcs) CHECK(wide.path[arc.last].width - wide.path[arc.first].width <= 21);
  Extrude fast = circle(7000, 90);
  fast.segment_speed_mm_s.assign(90, 50.F);
  for (std::size_t i = 45; i < 90; ++i) fast.segment_speed_mm_s[i] = 60.F;
  fit_arcs({.tolerance = 12, .room = {}}, fast);
  for (const Arc& arc : fast.arcs) CHECK((arc.last <= 45 || arc.first >= 45));
}

TEST_CASE("arcs: at the edge of what the nozzle reaches moves stay straight") {
  Extrude bead = circle(7000, 90);
  fit_arcs({.tolerance = 12, .room = {{-6990, -8000}, {8000, 8000}}}, bead);
  REQUIRE_FALSE(bead.arcs.empty());
  for (const Arc& arc : bead.arcs)
    for (std::size_t i = arc.first; i <= arc.last; ++i) CHECK(bead.path[i].at.x >= -6990);
}

TEST_CASE("arcs: the estimate is that of the pieces that firmware cuts them into") {
  Extrude bead = circle(5000, 120);
  fit_arcs({.tolerance = 12, .room = {}}, bead);
  REQUIRE_FALSE(bead.arcs.empty());
  const Arc& arc = bead.arcs.front();
  for (const auto firmware : {Firmware::klipper, Firmware::marlin2, Firmware::reprapfirmware}) {
    const auto chords = chords_of(firmware, std::nullopt, bead, arc);
    CHECK(chords.back() == bead.path[arc.last].at);
    for (const Point p : chords) CHECK(distance(p, arc.centre) == Approx(5000).margin(2));
    Point before = bead.path[arc.first].at;
    for (const Point p : chords) {
      // ◦ a circle of 72 pieces with Marlin; 1 mm with Klipper, the last of which is up to 2 mm
      CHECK(distance(before, p) <= (firmware == Firmware::klipper ? 1300 : 700));
      before = p;
    }
  }
  // Off by default, and then nothing is fitted.
  CHECK_FALSE(rules_of(Settings{}).arc_tolerance);
  Settings on;
  on.gcode.arc_fitting = true;
  CHECK(rules_of(on).arc_tolerance == on.gcode.arc_tolerance);
}
