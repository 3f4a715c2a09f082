// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/motion.h"

#include "model/flow.h"
#include "motion/cooling.h"
#include "motion/kinematics.h"
#include "motion/resample.h"
#include "motion/speeds.h"
#include "settings/first_layer.h"

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::motion;

namespace {
/// A bead along X from x = 0, of one band a junction.
Extrude line(std::vector<std::pair<Um, Um>> places_and_bands, Role role = Role::infill, Um y = 0) {
  Extrude bead{.path = {}, .role = role, .height = 200};
  for (const auto& [x, band] : places_and_bands) bead.path.push_back({{x, y}, band, 1.F});
  return bead;
}
Extrude square(Um side, Role role = Role::outer_wall, Um band = 400) {
  Extrude bead{.path = {}, .role = role, .height = 200};
  for (const Point p : {Point{0, 0}, Point{side, 0}, Point{side, side}, Point{0, side}, Point{0, 0}})
    bead.path.push_back({p, band, 1.F});
  return bead;
}
LayerPlan layer_of(std::vector<Step> steps) {
  return {.z = 400, .height = 200, .time = {.index = 5, .number = 5}, .steps = std::move(steps)};
}
Rules plain_rules() {
  Rules rules;
  rules.cooling.cool_min_layer_time = 0;
  rules.material.material_max_volumetric_speed = 500;
  return rules;
}
const Extrude& bead_in(const LayerPlan& layer, std::size_t wanted = 0) {
  for (const auto& step : layer.steps)
    if (const auto* bead = std::get_if<Extrude>(&step); bead && wanted-- == 0) return *bead;
  throw std::logic_error("no such bead");
}
double seconds_of_line(const Rules& rules, Um length) {
  return plan_layer(rules, layer_of({line({{0, 400}, {length, 400}})}), Point3{0, 0, 400}).statistics.print_time_s;
}
/// The largest mm³/s along a bead.
double most_flow(const Extrude& bead) {
  double most = 0;
  for (std::size_t i = 1; i < bead.path.size(); ++i) {
    const double v =
        bead.segment_speed_mm_s.empty() ? bead.speed_mm_s : static_cast<double>(bead.segment_speed_mm_s[i - 1]);
    for (const auto& j : {bead.path[i - 1], bead.path[i]})
      most = std::max(most, to_mm(j.width) * static_cast<double>(j.flow) * to_mm(bead.height) * v);
  }
  return most;
}
}  // namespace

TEST_CASE("motion: a straight line from rest to rest takes length over speed plus speed over acceleration") {
  auto rules = plain_rules();
  rules.machine.machine_junction_deviation = 0.02;
  rules.speeds.speed_infill = 80;
  rules.speeds.acceleration_print = 1000;
  CHECK(seconds_of_line(rules, 100'000) == Approx(100.0 / 80 + 80.0 / 1000));
  CHECK(seconds_of_line(rules, 1'000) == Approx(2 * std::sqrt(1.0 / 1000)));  // too short to reach 80 mm/s
  rules.machine.firmware = Firmware::klipper;
  CHECK(seconds_of_line(rules, 100'000) == Approx(100.0 / 80 + 80.0 / 1000));
}

TEST_CASE("motion: a machine with jerk begins and ends a line at its jerk") {
  auto rules = plain_rules();
  rules.speeds.speed_infill = 80;
  rules.speeds.acceleration_print = 1000;
  rules.machine.machine_max_jerk = 8;
  CHECK(seconds_of_line(rules, 100'000) == Approx(2 * 72.0 / 1000 + (100 - (80.0 * 80 - 8 * 8) / 1000) / 80));
}

TEST_CASE("motion: cutting a straight line in pieces changes its time for no machine") {
  auto rules = plain_rules();
  rules.machine.firmware = GENERATE(Firmware::marlin, Firmware::klipper, Firmware::reprapfirmware);
  if (rules.machine.firmware == Firmware::reprapfirmware) rules.machine.machine_junction_deviation = 0.02;
  std::vector<std::pair<Um, Um>> pieces;
  for (Um x = 0; x <= 100'000; x += 500) pieces.emplace_back(x, 400);
  const double cut = plan_layer(rules, layer_of({line(pieces)}), Point3{0, 0, 400}).statistics.print_time_s;
  CHECK(cut == Approx(seconds_of_line(rules, 100'000)));
}

TEST_CASE("motion: corners cost time, the sharper the more, by every planner's rule") {
  auto rules = plain_rules();
  rules.machine.firmware = GENERATE(Firmware::marlin, Firmware::klipper);
  const auto bent = [&](double degrees) {
    const double a = degrees * std::numbers::pi / 180;
    Extrude bead = line({{0, 400}, {50'000, 400}});
    bead.path.push_back({{rounded(50'000 + 50'000 * std::cos(a)), rounded(50'000 * std::sin(a))}, 400, 1.F});
    return plan_layer(rules, layer_of({bead}), Point3{0, 0, 400}).statistics.print_time_s;
  };
  const double straight = seconds_of_line(rules, 100'000);
  CHECK(bent(10) >= straight - 1e-4);
  CHECK(bent(45) > bent(10));
  CHECK(bent(90) > bent(45));
  CHECK(bent(180) > bent(90) - 1e-9);
  const double full_stop = 2 * seconds_of_line(rules, 50'000);
  CHECK(bent(90) <= full_stop + 1e-9);
  CHECK(bent(45) < full_stop);
}

TEST_CASE("motion: a right angle is taken at Klipper's square corner velocity") {
  auto rules = plain_rules();
  rules.machine.firmware = Firmware::klipper;
  rules.machine.machine_max_jerk = 5;
  rules.speeds.speed_infill = 50;
  rules.speeds.acceleration_print = 1000;
  Extrude bead = line({{0, 400}, {50'000, 400}});
  bead.path.push_back({{50'000, 50'000}, 400, 1.F});
  const double s = plan_layer(rules, layer_of({bead}), Point3{0, 0, 400}).statistics.print_time_s;
  // Each leg: from rest to 50, down to 5 mm/s (or up from it).
  const double leg = 50.0 / 1000 + (50.0 - 5) / 1000 + (50.0 - (50.0 * 50 / 2000 + (50.0 * 50 - 25) / 2000)) / 50;
  CHECK(s == Approx(2 * leg).epsilon(1e-6));
}

TEST_CASE("motion: doubled speed and fourfold acceleration halve the time") {
  auto rules = plain_rules();
  rules.cooling.cool_fan_enabled = false;
  rules.machine.machine_max_acceleration_x = rules.machine.machine_max_acceleration_y = 1e5;
  rules.machine.machine_max_speed_x = rules.machine.machine_max_speed_y = 5000;
  const auto time = [&] {
    return plan_layer(rules, layer_of({square(30'000), line({{0, 400}, {20'000, 400}})}), Point3{0, 0, 400})
        .statistics.print_time_s;
  };
  const double slow = time();
  auto& s = rules.speeds;
  s.speed_wall_0 *= 2, s.speed_infill *= 2, s.speed_travel *= 2, s.acceleration_print *= 4,
      rules.machine.machine_max_jerk *= 2;
  CHECK(time() == Approx(slow / 2));
}

TEST_CASE("motion: no junction exceeds the material's mm³/s") {
  auto rules = plain_rules();
  rules.material.material_max_volumetric_speed = 5;
  std::mt19937 random(7);
  std::uniform_int_distribution<Um> band(50, 900), step(100, 3000);
  for (int n = 0; n < 100; ++n) {
    std::vector<std::pair<Um, Um>> places;
    Um x = 0;
    for (int i = 0; i < 30; ++i) places.emplace_back(x += step(random), band(random));
    const auto planned = plan_layer(rules, layer_of({line(places, Role::inner_wall)}), Point3{places[0].first, 0, 400});
    CHECK(most_flow(bead_in(planned.plan)) <= 5 * (1 + 1e-6));
  }
}

TEST_CASE("motion: a material with more flow is printed slower, so that its limit holds") {
  auto rules = plain_rules();
  rules.material.material_max_volumetric_speed = 4;
  rules.material.material_flow = 125;
  const auto planned = plan_layer(rules, layer_of({line({{0, 500}, {50'000, 500}})}), Point3{0, 0, 400});
  CHECK(bead_in(planned.plan).speed_mm_s == Approx(4 / (0.5 * 0.2 * 1.25)));
}

TEST_CASE("motion: a bead whose width changes is cut so that each piece may be one width, and keeps its volume") {
  auto wedge = line({{0, 100}, {20'000, 900}});
  Bead before{wedge.path, Role::inner_wall};
  cut_where_width_changes(wedge.path);
  CHECK(wedge.path.size() == 41);
  CHECK(wedge.path.front().at == before.path.front().at);
  CHECK(wedge.path.back().at == before.path.back().at);
  for (std::size_t i = 1; i < wedge.path.size(); ++i)
    CHECK(std::abs(wedge.path[i].width - wedge.path[i - 1].width) <= 20);
  CHECK(volume_mm3(Bead{wedge.path, Role::inner_wall}, 200) == Approx(volume_mm3(before, 200)).epsilon(1e-6));

  auto short_one = line({{0, 400}, {500, 600}});
  cut_where_width_changes(short_one.path);
  CHECK(short_one.path.size() == 3);  // pieces are not shorter than 0.2 mm

  auto abrupt = line({{0, 100}, {500, 900}});
  cut_where_width_changes(abrupt.path);
  CHECK(abrupt.path.size() == 6);  // but 0.1 mm where they would change by more than 0.135 mm

  auto bend = line({{0, 450}, {130, 340}});
  cut_where_width_changes(bend.path);
  CHECK(bend.path.size() == 2);

  auto even = line({{0, 400}, {20'000, 400}});
  cut_where_width_changes(even.path);
  CHECK(even.path.size() == 2);
}

TEST_CASE("motion: a path sampled finely is printed with few moves, in place, in width and in volume what it was") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> noise(-1, 1);
  for (int n = 0; n < 50; ++n) {
    Bead fine{{}, Role::inner_wall};
    const double radius = 3'000 + 200 * n, wave = 1 + n % 7;
    for (double a = 0; a < 5; a += 0.004)
      fine.path.push_back(
          {{rounded(radius * std::cos(a) + noise(random)), rounded(radius * std::sin(a) + noise(random))},
           rounded(400 + 150 * std::sin(wave * a)),
           n % 3 == 0 ? static_cast<float>(0.75 + 0.25 * std::cos(a)) : 1.F});
    Bead thin = fine;
    resample(thin.path);
    CHECK(thin.path.size() < fine.path.size() / 3);
    CHECK(volume_mm3(thin, 200) == Approx(volume_mm3(fine, 200)).epsilon(0.006));
    CHECK(length_mm(thin) == Approx(length_mm(fine)).epsilon(0.004));  // less the noise
    CHECK(thin.path.front().at == fine.path.front().at);
    CHECK(thin.path.back().at == fine.path.back().at);
    for (const auto& j : fine.path) {  // the nearest place on the thin path is near, and as wide
      double nearest = 1e9, change = 1e9;
      for (std::size_t i = 1; i < thin.path.size(); ++i) {
        const auto &a = thin.path[i - 1], &b = thin.path[i];
        const double x = b.at.x - a.at.x, y = b.at.y - a.at.y, px = j.at.x - a.at.x, py = j.at.y - a.at.y;
        const double t = std::clamp((px * x + py * y) / (x * x + y * y), 0.0, 1.0),
                     d = std::hypot(px - t * x, py - t * y);
        const double qa = a.width * static_cast<double>(a.flow), qb = b.width * static_cast<double>(b.flow);
        if (d < nearest) nearest = d, change = std::abs(qa + t * (qb - qa) - j.width * static_cast<double>(j.flow));
      }
      REQUIRE(nearest <= 13);  // the tolerance, noise, and rounding of cuts to the lattice
      REQUIRE(change <= 30);
    }
  }
}

TEST_CASE(
    "motion: lines of infill are told more coarsely than walls, by a twentieth of a line, and lay what they laid") {
  const auto told_as = [](const Bead& bead, Role role) {
    Bead out{bead.path, role};
    resample(out.path, coarseness(role));
    return out;
  };
  std::size_t of_walls = 0, of_lines = 0;
  for (int radius = 2'000; radius < 20'000; radius += 400) {
    Bead arc{{}, Role::solid_infill};
    for (double a = 0; a < 3; a += 0.005)
      arc.path.push_back({{rounded(radius * std::cos(a)), rounded(radius * std::sin(a))}, 450, 1.F});
    const Bead wall = told_as(arc, Role::inner_wall), line = told_as(arc, Role::solid_infill);
    of_walls += wall.path.size(), of_lines += line.path.size();
    CHECK(volume_mm3(line, 200) == Approx(volume_mm3(arc, 200)).epsilon(0.003));
    for (std::size_t i = 1; i < line.path.size(); ++i) {  // on both sides of the arc
      const Point a = line.path[i - 1].at, b = line.path[i].at;
      for (const Point at : {a, lerp(a, b, 0.5)}) CHECK(std::abs(distance({0, 0}, at) - radius) <= 21);
    }
    CHECK(told_as(arc, Role::infill).path == line.path);
    CHECK(told_as(arc, Role::gap_fill).path == line.path);
    CHECK(told_as(arc, Role::overhang_skin).path == line.path);
    CHECK(told_as(arc, Role::top_skin).path == told_as(arc, Role::outer_wall).path);
  }
  CHECK(4 * of_lines < 3 * of_walls);

  const auto wedge = line({{0, 150}, {1'500, 450}});  // of a line that an edge runs along
  CHECK(told_as({wedge.path}, Role::solid_infill).path.size() == 4);
  CHECK(told_as({wedge.path}, Role::top_skin).path.size() == 8);
}

TEST_CASE("motion: what lies on the bed is seen from below, and told as finely as walls") {
  const auto told_at = [](Um z) {
    LayerPlan layer = layer_of({line({{0, 150}, {1'500, 450}}, Role::solid_infill)});
    layer.z = z;
    return bead_in(plan_layer(plain_rules(), layer, Point3{0, 0, z}).plan).path.size();
  };
  CHECK(told_at(200) == 8);
  CHECK(told_at(400) == 4);
}

TEST_CASE("motion: no bead turns by more than 60° beside a move shorter than 50 µm") {
  std::mt19937 random(5);
  for (int n = 0; n < 200; ++n) {
    const Coarseness times = n % 2 == 0 ? Coarseness{} : coarseness(Role::solid_infill);
    std::vector<Junction> path{{{0, 0}, 400, 1.F}};
    double way = 0;
    for (int i = 0; i < 150; ++i) {
      way += (static_cast<double>(random() % 1000) / 500 - 1) * (i % 5 == 0 ? 3 : 0.3);
      const double by = times.path * (1 + static_cast<double>(random() % 100));
      path.push_back({path.back().at + Point{rounded(by * std::cos(way)), rounded(by * std::sin(way))},
                      350 + static_cast<Um>(random() % 100), 1.F});
    }
    thin_out(path, times);
    for (std::size_t i = 1; i + 1 < path.size(); ++i) {
      const Point a = path[i].at - path[i - 1].at, b = path[i + 1].at - path[i].at;
      const double before = distance({0, 0}, a), after = distance({0, 0}, b);
      const double cosine = static_cast<double>(dot(a, b)) / std::max(1.0, before * after);
      if (std::min(before, after) < 50) CHECK(cosine >= 0.45);  // places are on the lattice
    }
  }
}

TEST_CASE("motion: a long segment does not take on the width of the step at its end") {
  const Bead ramp{line({{0, 340}, {200, 411}, {220, 407}, {20'000, 407}}).path, Role::inner_wall};
  Bead thin = ramp;
  thin_out(thin.path);
  CHECK(std::abs(volume_mm3(thin, 1_mm) - volume_mm3(ramp, 1_mm)) < 0.004);  // of 8.14 mm³
}

TEST_CASE("motion: thinning keeps corners, steps of width, and closed paths of two points and more") {
  auto corner = square(10'000).path;
  thin_out(corner);
  CHECK(corner.size() == 5);
  auto step = line({{0, 300}, {5'000, 300}, {5'020, 500}, {5'040, 500}, {10'000, 500}}).path;
  thin_out(step);
  CHECK(step.size() == 4);
  auto there_and_back = line({{0, 300}, {5'000, 300}, {0, 300}}).path;
  thin_out(there_and_back);
  CHECK(there_and_back.size() == 3);
  auto nothing = line({{0, 300}, {0, 300}, {0, 300}}).path;
  thin_out(nothing);
  CHECK(nothing.size() == 2);
}

TEST_CASE("motion: F does not change at every segment of a bead that widens") {
  auto rules = plain_rules();
  rules.material.material_max_volumetric_speed = 3;
  const auto planned =
      plan_layer(rules, layer_of({line({{0, 400}, {60'000, 800}}, Role::inner_wall)}), Point3{0, 0, 400});
  const auto& speeds = bead_in(planned.plan).segment_speed_mm_s;
  REQUIRE(speeds.size() == 20);
  int changes = 0;
  for (std::size_t i = 1; i < speeds.size(); ++i)
    if (speeds[i] != speeds[i - 1]) ++changes;
  CHECK(changes > 4);
  CHECK(changes < 15);
}

TEST_CASE("motion: with full equalisation walls of any width are printed at one mm³/s") {
  auto rules = plain_rules();
  rules.speeds.speed_equalize_flow_width_factor = 100;
  rules.speeds.speed_travel = 1000;
  const double nominal = flow::area_mm2(0.42, 0.2) * rules.speeds.speed_wall_0;
  for (const Um band : {200, 377, 700}) {
    auto bead = line({{0, band}, {30'000, band}}, Role::outer_wall);
    set_bead_speed(rules, bead);
    CHECK(bead.speed_mm_s * to_mm(band) * 0.2 == Approx(nominal));
  }
}

TEST_CASE(
    "motion: with full equalisation sparse infill takes as long as its plastic does, however long its lines are") {
  auto rules = plain_rules();
  rules.speeds.speed_equalize_flow_width_factor = 100;
  rules.speeds.speed_travel = 1000;
  rules.infill_line_width = LengthOrShare{450};
  const double nominal = flow::area_mm2(0.45, 0.2) * rules.speeds.speed_infill;
  for (const float layers : {1.F, 2.F})
    for (const Um band : {320, 407, 520}) {
      auto bead = line({{0, band}, {30'000, band}}, Role::infill);
      for (Junction& j : bead.path) j.flow = layers;
      set_bead_speed(rules, bead);
      CHECK(bead.speed_mm_s * to_mm(band) * 0.2 == Approx(nominal));
    }
}

TEST_CASE("motion: the first layer is slow, a share is of the feature's own speed, and travels have theirs") {
  Settings settings;
  settings.speeds.speed_layer_0 = {20, false};
  settings.speeds.speed_bridge = 15;
  settings.speeds.speed_travel_layer_0 = 70;
  const auto rules_for = [&] { return rules_of(on_first_layer(settings), &settings); };
  CHECK(feature_speed_mm_s(rules_for(), Role::infill) == 20);
  CHECK(feature_speed_mm_s(rules_for(), Role::bridge) == 15);
  CHECK(feature_speed_mm_s(rules_for(), Role::overhang_wall) == 20);
  CHECK(feature_speed_mm_s(rules_for(), Role::skirt) == 20);
  settings.speeds.skirt_brim_speed = 33;
  CHECK(feature_speed_mm_s(rules_for(), Role::skirt) == 33);
  settings.speeds.speed_layer_0 = {50, true};
  CHECK(feature_speed_mm_s(rules_for(), Role::infill) == 40);
  CHECK(feature_speed_mm_s(rules_for(), Role::overhang_wall) == 10);  // half of half of 40
  settings.speeds.speed_topbottom_layer_0 = 31;
  CHECK(feature_speed_mm_s(rules_for(), Role::solid_infill) == 31);
  CHECK(feature_speed_mm_s(rules_for(), Role::infill) == 40);
  const std::array rules{rules_of(settings), rules_for()};
  LayerPlan layer = layer_of({Travel{{{0, 0, 400}, {50'000, 0, 400}}}});
  CHECK(std::get<Travel>(plan_layer(rules, layer, {}).plan.steps.back()).speed_mm_s == 150);
  layer.scope = 1;
  CHECK(std::get<Travel>(plan_layer(rules, layer, {}).plan.steps.back()).speed_mm_s == 70);
}

TEST_CASE("motion: no role is faster or harder pushed on the first layer than the settings for it allow") {
  Settings settings;
  settings.speeds.acceleration_enabled = true;
  settings.speeds.acceleration_layer_0 = 321;
  for (const auto share : {SpeedOrShare{20, false}, SpeedOrShare{50, true}, SpeedOrShare{5000, false}}) {
    settings.speeds.speed_layer_0 = share;
    const auto above = rules_of(settings), first = rules_of(on_first_layer(settings), &settings);
    for (const auto& row : roles) {
      INFO(row.key);
      const double usual = feature_speed_mm_s(above, row.role);
      const double most = std::min(usual, share.of(usual));
      if (row.role == Role::overhang_skin)  // of no first layer; there speed_overhang is that of walls
        CHECK(feature_speed_mm_s(first, row.role) <= most);
      else
        CHECK(feature_speed_mm_s(first, row.role) == most);
      CHECK(feature_acceleration_mm_s2(first, row.role) == 321);
    }
  }
}

TEST_CASE("motion: accelerations of the first layer are for what is printed, travels keep theirs") {
  Settings settings;
  settings.speeds.acceleration_enabled = true;
  settings.speeds.acceleration_print = 1500, settings.speeds.acceleration_infill = 2000;
  settings.speeds.acceleration_layer_0 = 500;
  const auto rules = rules_of(on_first_layer(settings), &settings);
  for (const auto role : {Role::outer_wall, Role::infill, Role::top_skin, Role::support})
    CHECK(feature_acceleration_mm_s2(rules, role) == 500);
  CHECK(travel_acceleration_mm_s2(rules) == 1500);
  settings.speeds.acceleration_enabled = false;  // the estimate takes the firmware's to be acceleration_print
  CHECK(on_first_layer(settings).speeds.acceleration_print == 1500);
}

TEST_CASE("motion: beads of one layer are printed by the rules of their scopes") {
  Settings settings;
  settings.cooling.cool_min_layer_time = 0;
  std::vector<Rules> rules{rules_of(settings)};
  settings.speeds.speed_infill = 25;
  rules.push_back(rules_of(settings));
  Extrude slow = line({{0, 400}, {20'000, 400}}, Role::infill, 2'000);
  slow.scope = 1;
  const auto planned = plan_layer(rules, layer_of({line({{0, 400}, {20'000, 400}}), slow}), Point3{0, 0, 400});
  CHECK(bead_in(planned.plan, 0).speed_mm_s == 80);
  CHECK(bead_in(planned.plan, 1).speed_mm_s == 25);
}

TEST_CASE("motion: small closed walls are slowed, long and open ones are not") {
  auto rules = plain_rules();
  auto small = square(3'000), large = square(30'000);
  set_bead_speed(rules, small), set_bead_speed(rules, large);
  CHECK(small.speed_mm_s == 20);
  CHECK(large.speed_mm_s == 40);
  auto open = line({{0, 400}, {3'000, 400}}, Role::outer_wall);
  set_bead_speed(rules, open);
  CHECK(open.speed_mm_s == 40);
}

TEST_CASE("motion: a small loop that is open at its seam, or cut, is slowed like the whole of it") {
  const auto rules = plain_rules();
  auto piece = line({{0, 400}, {3'000, 400}}, Role::outer_wall);
  piece.loop_length = 12'000;
  set_bead_speed(rules, piece);
  CHECK(piece.speed_mm_s == 20);
  piece.loop_length = 120'000;
  set_bead_speed(rules, piece);
  CHECK(piece.speed_mm_s == 40);
}

TEST_CASE("motion: a wall over air has the speed of the share of its width that hangs, and is never faster for it") {
  auto rules = plain_rules();
  rules.speeds.speed_overhang_25 = {100, true}, rules.speeds.speed_overhang_50 = {75, true};
  rules.speeds.speed_overhang_75 = {20, false}, rules.speeds.speed_overhang_100 = {500, false};
  rules.speeds.speed_overhang = {25, true};
  const auto speed = [&](int quarters, Role role = Role::outer_wall) {
    auto bead = line({{0, 400}, {10'000, 400}}, role);
    bead.air_quarters = static_cast<std::uint8_t>(quarters);
    set_bead_speed(rules, bead);
    return bead.speed_mm_s;
  };
  CHECK(speed(0) == 40);
  CHECK(speed(1) == 40);
  CHECK(speed(2) == 30);
  CHECK(speed(3) == 20);
  CHECK(speed(4) == 40);
  CHECK(speed(4, Role::overhang_wall) == 10);
  CHECK(speed(2, Role::inner_wall) == 45);
  rules.speeds.speed_topbottom = 48;
  CHECK(speed(2, Role::solid_infill) == 36);
  CHECK(speed(4, Role::overhang_skin) == 12);
}

TEST_CASE("motion: the fan follows what a wall hangs over, and does not slow down for less than a second") {
  Rules rules = plain_rules();
  auto& c = rules.cooling;
  c.cool_min_layer_time = 0, c.cool_min_layer_time_fan_speed_max = 0;
  c.cool_fan_off_layers = 0, c.cool_fan_full_layer = 0, c.cool_fan_speed_min = 50, c.bridge_fan_speed = 90;
  c.overhang_fan_speed_50 = 70;
  const auto fans = [&](std::vector<std::pair<int, Um>> quarters_and_lengths) {
    std::vector<Step> steps;
    Um x = 0;
    for (const auto& [quarters, length] : quarters_and_lengths) {
      auto bead = line({{x, 400}, {x + length, 400}}, Role::outer_wall);
      bead.air_quarters = static_cast<std::uint8_t>(quarters);
      steps.emplace_back(std::move(bead));
      x += length;
    }
    std::vector<int> out;
    for (const auto& step : plan_layer(rules, layer_of(std::move(steps)), Point3{0, 0, 400}).plan.steps)
      if (const auto* fan = std::get_if<SetFan>(&step)) out.push_back(static_cast<int>(std::lround(100 * fan->share)));
    return out;
  };
  constexpr Um far = 100'000, near = 5'000;  // more than a second and less
  CHECK(fans({{0, far}, {1, far}}) == std::vector{50});
  CHECK(fans({{0, far}, {2, far}, {3, far}, {4, far}, {0, far}}) == std::vector{50, 70, 90, 50});
  CHECK(fans({{3, near}, {0, near}, {3, near}, {0, far}}) == std::vector{50, 90, 50});
  c.cool_fan_enabled = false;
  CHECK(fans({{4, far}}) == std::vector{0});
}

TEST_CASE("motion: lengths over air are counted by the share that hangs, and pieces of a wall are one") {
  auto a = line({{0, 400}, {10'000, 400}}, Role::outer_wall),
       b = line({{10'000, 400}, {13'000, 400}}, Role::outer_wall);
  auto c = line({{13'000, 400}, {15'000, 400}}, Role::overhang_wall);
  b.air_quarters = 2, c.air_quarters = 4;
  const auto walls = plan_layer(plain_rules(), layer_of({a, b, c}), Point3{0, 0, 400}).statistics.walls;
  CHECK(walls.beads == 1);
  CHECK(walls.over_air_mm == std::array{0.0, 3.0, 0.0, 2.0});
  CHECK(walls.whole_over_air_mm == 2);
}

TEST_CASE("motion: a travel is put in where a bead begins away from the nozzle") {
  const auto planned =
      plan_layer(plain_rules(),
                 layer_of({line({{0, 400}, {10'000, 400}}), line({{0, 400}, {10'000, 400}}, Role::infill, 400)}), {});
  CHECK(planned.statistics.travel.moves == 2);
  CHECK(planned.statistics.travel.mm == Approx(std::hypot(10.0, 0.4)));  // where the first one comes from is not known
}

TEST_CASE("motion: a fast layer is slowed to cool_min_layer_time, travels are not") {
  Rules rules;
  rules.machine.firmware = GENERATE(Firmware::marlin, Firmware::klipper);
  rules.cooling.cool_min_layer_time = 9;
  rules.cooling.cool_min_speed = 1;
  const LayerPlan layer = layer_of({square(20'000), Travel{{{0, 0, 400}, {20'000, 20'000, 400}}}, square(5'000)});
  const auto planned = plan_layer(rules, layer, Point3{0, 0, 400});
  CHECK(planned.statistics.print_time_s >= 9);
  CHECK(planned.statistics.print_time_s < 9.011);
  for (const auto& step : planned.plan.steps)
    if (const auto* travel = std::get_if<Travel>(&step)) CHECK(travel->speed_mm_s == 150);
}

TEST_CASE("motion: where a layer is slowed down the fastest beads give first, and outer walls keep their speed") {
  Rules rules = plain_rules();
  rules.speeds.speed_wall_0 = 20, rules.speeds.speed_wall_x = 60, rules.speeds.speed_infill = 120;
  rules.cooling.cool_min_speed = 5;
  const auto planned_for = [&](double seconds) {
    rules.cooling.cool_min_layer_time = seconds;
    return plan_layer(rules,
                      layer_of({square(20'000), line({{0, 400}, {100'000, 400}}, Role::inner_wall),
                                line({{0, 400}, {400'000, 400}}, Role::infill)}),
                      Point3{0, 0, 400});
  };
  const double unhurried = planned_for(0).statistics.print_time_s;
  const auto a_little = planned_for(unhurried + 1);
  CHECK(bead_in(a_little.plan, 0).speed_mm_s == 20);
  CHECK(bead_in(a_little.plan, 1).speed_mm_s == 60);
  CHECK(bead_in(a_little.plan, 2).speed_mm_s < 110);
  const auto more = planned_for(unhurried + 8);
  CHECK(bead_in(more.plan, 0).speed_mm_s == 20);
  CHECK(bead_in(more.plan, 1).speed_mm_s == bead_in(more.plan, 2).speed_mm_s);
  CHECK(more.statistics.print_time_s == Approx(unhurried + 8).margin(0.011));
}

TEST_CASE("motion: slowing down ends at cool_min_speed, and what is slower already stays") {
  Rules rules;
  rules.cooling.cool_min_layer_time = 1000;
  rules.cooling.cool_min_speed = 25;
  rules.speeds.speed_bridge = 12;
  const auto planned =
      plan_layer(rules, layer_of({square(20'000), line({{0, 400}, {10'000, 400}}, Role::bridge)}), Point3{0, 0, 400});
  CHECK(bead_in(planned.plan, 0).speed_mm_s == 25);
  CHECK(bead_in(planned.plan, 1).speed_mm_s == 12);
}

TEST_CASE("motion: what lies on support has a fan of its own where that is asked for, and so have interfaces") {
  CoolingSettings c;
  c.cool_min_layer_time = 0, c.cool_min_layer_time_fan_speed_max = 0;
  c.cool_fan_off_layers = 0, c.cool_fan_full_layer = 0, c.cool_fan_speed_min = 50;
  const auto fans = [&] {
    LayerPlan layer;
    layer.time.number = 5;
    for (const auto& [role, on_support] :
         {std::pair{Role::solid_infill, false}, {Role::solid_infill, true}, {Role::support_interface, false}}) {
      Extrude bead;
      bead.path = {{{0, 0}, 400, 1.F}, {{200'000, 0}, 400, 1.F}};
      bead.role = role, bead.on_support = on_support, bead.speed_mm_s = 50;
      layer.steps.emplace_back(std::move(bead));
    }
    motion::set_fan(c, layer, 60);
    std::vector<int> out;
    for (const auto& step : layer.steps)
      if (const auto* fan = std::get_if<SetFan>(&step)) out.push_back(static_cast<int>(std::lround(100 * fan->share)));
    return out;
  };
  CHECK(fans() == std::vector{50});
  c.support_fan_enable = true, c.support_supported_skin_fan_speed = 90;
  CHECK(fans() == std::vector{50, 90, 50});
  c.support_interface_fan_speed = 20;
  CHECK(fans() == std::vector{50, 90, 20});
  c.cool_fan_enabled = false;
  CHECK(fans() == std::vector{0});
}

TEST_CASE("motion: the fan is off at first, rises by layer, follows the layer's time, and is on over bridges") {
  CoolingSettings c;
  c.cool_fan_off_layers = 2, c.cool_fan_full_layer = 6;
  c.cool_fan_speed_min = 40, c.cool_fan_speed_max = 100;
  c.cool_min_layer_time = 5, c.cool_min_layer_time_fan_speed_max = 25;
  CHECK(fan_share(c, 0, 60) == 0);
  CHECK(fan_share(c, 1, 60) == 0);
  CHECK(fan_share(c, 2, 60) == Approx(0.1));
  CHECK(fan_share(c, 4, 60) == Approx(0.3));
  CHECK(fan_share(c, 5, 60) == Approx(0.4));
  CHECK(fan_share(c, 9, 15) == Approx(0.7));
  CHECK(fan_share(c, 9, 3) == Approx(1.0));
  c.cool_fan_always_on = false;
  CHECK(fan_share(c, 9, 60) == 0);
  c.cool_fan_enabled = false;
  CHECK(fan_share(c, 9, 3) == 0);

  c = {};
  c.cool_fan_speed_min = 50, c.bridge_fan_speed = 90;
  LayerPlan layer = layer_of(
      {line({{0, 400}, {1000, 400}}), line({{0, 400}, {1000, 400}}, Role::bridge), line({{0, 400}, {1000, 400}})});
  layer.time.number = 9;
  set_fan(c, layer, 100);
  std::vector<double> fans;
  for (const auto& step : layer.steps)
    if (const auto* fan = std::get_if<SetFan>(&step)) fans.push_back(fan->share);
  CHECK(fans == std::vector<double>{0.5, 0.9, 0.5});
}

TEST_CASE("motion: statistics are the sums of what is printed") {
  auto rules = plain_rules();
  rules.material.material_flow = 110;
  rules.retraction.retraction_extra_prime_amount = 100;
  Extrude thin = line({{0, 200}, {10'000, 200}}, Role::inner_wall);
  for (auto& j : thin.path) j.flow = 0.25F;
  const auto s = plan_layer(rules,
                            layer_of({square(20'000), Retract{},
                                      Travel{{{0, 0, 400}, {0, 0, 600}, {0, 0, 400}}, 0, true}, Prime{}, thin}),
                            Point3{0, 0, 400})
                     .statistics;
  const auto wall = s.features[static_cast<std::size_t>(Role::outer_wall)],
             inner = s.features[static_cast<std::size_t>(Role::inner_wall)];
  CHECK(wall.mm == Approx(80));
  CHECK(wall.mm3 == Approx(80 * 0.4 * 0.2));
  CHECK(inner.mm3 == Approx(10 * 0.2 * 0.2 * 0.25));
  const double filament_area = std::numbers::pi / 4 * 1.75 * 1.75;
  CHECK(s.filament_mm3 == Approx((wall.mm3 + inner.mm3) * 1.1 + 0.1 * filament_area));
  CHECK(s.filament_mm == Approx(s.filament_mm3 / filament_area));
  CHECK(s.filament_g == Approx(s.filament_mm3 * 1.24e-3));
  CHECK(s.walls.beads == 2);
  CHECK(s.walls.flow_compensated_mm == Approx(10));
  CHECK(s.walls.min_flow_ratio == Approx(0.25));
  CHECK(s.walls.min_width == 200 + 43);
  CHECK(s.travel.retractions == 1);
  CHECK(s.travel.wall_crossings == 1);
  CHECK(s.travel.mm == Approx(0.4));
  double sum = s.travel.s + s.travel.retraction_s;
  for (const auto& f : s.features) sum += f.s;
  CHECK(sum == Approx(s.print_time_s));
  CHECK(s.travel.retraction_s == Approx((1.0 / 40 + 40.0 / 5000) + (1.1 / 40 + 40.0 / 5000)));
}

TEST_CASE("motion: layers planned apart are the layers planned together") {
  PrintPlan print;
  for (int i = 0; i < 5; ++i) {
    LayerPlan layer = layer_of({Travel{{{i * 1000, 0, 200 * i}}}, square(10'000 + 1000 * i)});
    layer.z = 200 * i;
    print.layers.push_back(layer);
  }
  const auto whole = plan(plain_rules(), print);
  const auto starts = starts_of(print);
  double sum = 0;
  for (std::size_t i = 5; i-- > 0;)
    sum += plan_layer(plain_rules(), print.layers[i], starts[i]).statistics.print_time_s;
  CHECK(whole.statistics.layer_s.size() == 5);
  CHECK(whole.statistics.print_time_s == Approx(sum));
  CHECK_FALSE(starts[0].has_value());
  CHECK(starts[1] == Point3{0, 0, 0});
}

TEST_CASE("motion: filament is drawn back while wiping as far as the extruder keeps up, the rest before") {
  auto rules = plain_rules();
  rules.retraction.retraction_amount = 1000;
  rules.retraction.retraction_retract_speed = 40;
  rules.speeds.speed_travel = 100;
  Retract wipe;
  wipe.wipe = {{20'000, 0}, {19'000, 0}};  // 1 mm in 10 ms: 0.4 mm of filament
  const auto planned = plan_layer(rules, layer_of({line({{0, 400}, {20'000, 400}}), wipe}), Point3{0, 0, 400});
  const auto& retract = std::get<Retract>(planned.plan.steps.back());
  CHECK(retract.wipe_speed_mm_s == 100);
  CHECK(retract.before_wipe == Approx(0.6));
}

TEST_CASE("motion: the moves that are timed are those that are written") {
  // Steps of width that the writer joins with what goes straight on, and a bend that it does not.
  LayerPlan layer =
      layer_of({line({{0, 450}, {10'000, 450}, {10'010, 350}, {20'000, 350}, {20'012, 420}, {30'000, 420}})});
  std::get<Extrude>(layer.steps[0]).speed_mm_s = 50;
  const std::vector<Rules> rules{plain_rules()};
  const auto moves = moves_of(rules, layer, Point3{0, 0, 400}, rules[0].machine);
  CHECK(moves.size() == 3);
  double length = 0;
  for (const auto& move : moves) length += move.length_mm;
  CHECK(length == Approx(30));
}

TEST_CASE("motion: a round of support turns by little at each of its vertices, so that the nozzle need not slow down") {
  const auto most_turn = [](Role role) {
    std::vector<Junction> round;
    for (int i = 0; i <= 96; ++i) {
      const double a = 2 * std::numbers::pi * i / 96;
      round.push_back({{rounded(250 * std::cos(a)), rounded(250 * std::sin(a))}, 450, 1.F});
    }
    resample(round, coarseness(role));
    double most = 0;
    for (std::size_t i = 1; i + 1 < round.size(); ++i) {
      const Point in = round[i].at - round[i - 1].at, on = round[i + 1].at - round[i].at;
      const double turn = std::atan2(static_cast<double>(in.x) * on.y - static_cast<double>(in.y) * on.x,
                                     static_cast<double>(in.x) * on.x + static_cast<double>(in.y) * on.y);
      most = std::max(most, std::abs(turn) * 180 / std::numbers::pi);
    }
    return most;
  };
  CHECK(most_turn(Role::support) < 30);
  CHECK(most_turn(Role::outer_wall) > 30);  // of which there are few
}
