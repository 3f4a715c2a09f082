// SPDX-License-Identifier: GPL-3.0-or-later
#include "travel/seam.h"

#include "layers.h"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::travel;

namespace {

std::vector<Point> seams_of(const TravelSettings& settings, const std::vector<LayerInput>& inputs) {
  std::vector<Point> seams;
  for (const auto& p : plan(settings, {}, inputs))
    for (const auto& step : p.steps)
      if (const auto* e = std::get_if<Extrude>(&step); e && e->role == Role::outer_wall)
        seams.push_back(e->path.front().at);
  return seams;
}

/// A closed outline by its radius at so many directions, evenly spread.
/// @param radius  µm, of an angle
Ring round_outline(int corners, const auto& radius, double turned_rad = 0) {
  Ring ring;
  for (int k = 0; k < corners; ++k) {
    const double a = 2 * std::numbers::pi * k / corners + turned_rad;
    ring.push_back({rounded(radius(a) * std::cos(a)), rounded(radius(a) * std::sin(a))});
  }
  return ring;
}

/// A vase whose radius changes and whose vertices turn from layer to layer.
std::vector<LayerInput> vase() {
  std::vector<LayerInput> layers;
  for (std::size_t i = 0; i < 40; ++i) {
    const auto n = static_cast<double>(i);
    const Ring ring = round_outline(
        90, [&](double) { return 15000 + 2000 * std::sin(n / 8); }, 2 * std::numbers::pi * 0.37 * n / 90);
    layers.push_back(sample::layer({{ring, {}}}, i));
  }
  return layers;
}

}  // namespace

TEST_CASE("travel: seams of a square lie in a corner, and in the same one on every layer", "[travel]") {
  const auto type = GENERATE(SeamType::sharpest_corner, SeamType::aligned);
  TravelSettings settings;
  settings.z_seam_type = type;
  std::vector<LayerInput> layers;
  for (std::size_t i = 0; i < 10; ++i) layers.push_back(sample::layer({sample::rectangle({0, 0}, {20000, 10000})}, i));
  const auto seams = seams_of(settings, layers);
  REQUIRE(seams.size() == 10);
  for (const Point s : seams) {
    CHECK(s == seams[0]);
    CHECK((s.x == 200 || s.x == 19800));
    CHECK((s.y == 200 || s.y == 9800));
  }
}

TEST_CASE("travel: aligned seams of a vase make a clean line", "[travel]") {
  TravelSettings settings;
  settings.z_seam_type = SeamType::aligned;
  const auto seams = seams_of(settings, vase());
  REQUIRE(seams.size() == 40);
  for (std::size_t i = 1; i < seams.size(); ++i) {
    const double a = std::atan2(seams[i].y, seams[i].x), b = std::atan2(seams[i - 1].y, seams[i - 1].x);
    CHECK(std::abs(a - b) < 0.01);
  }
}

TEST_CASE("travel: a corner that lasts wins over one that is sharper for a while", "[travel]") {
  // A drop with a tip ahead that fades into its round in ten layers, and a blunter one to the left that stays.
  std::vector<LayerInput> layers;
  for (std::size_t i = 0; i < 80; ++i) {
    const double fades = i < 10 ? 1 - 0.1 * static_cast<double>(i) : 0;
    const Ring ring = round_outline(120, [&](double a) {
      return 15000 + 7000 * fades * std::max(0.0, 1 - 4 * std::min(a, 2 * std::numbers::pi - a)) +
             4000 * std::max(0.0, 1 - 3 * std::abs(std::numbers::pi - a));
    });
    layers.push_back(sample::layer({{ring, {}}}, i));
  }
  TravelSettings settings;
  settings.z_seam_type = SeamType::aligned;
  const auto seams = seams_of(settings, layers);
  REQUIRE(seams.size() == 80);
  for (const Point s : seams) CHECK((s.x < -18000 && std::abs(s.y) < 300));
  // By themselves the first layers would begin at the sharper one, or in the bay beside it.
  const auto first = seams_of(settings, {layers.begin(), layers.begin() + 3});
  CHECK(first.front().x > 10000);
}

TEST_CASE("travel: what stands on a part that forks counts on both prongs", "[travel]") {
  // A bar under two towers at its ends.
  std::vector<LayerInput> layers;
  for (std::size_t i = 0; i < 10; ++i) layers.push_back(sample::layer({sample::rectangle({0, 0}, {40000, 10000})}, i));
  for (std::size_t i = 10; i < 40; ++i)
    layers.push_back(
        sample::layer({sample::rectangle({0, 0}, {8000, 10000}), sample::rectangle({32000, 0}, {40000, 10000})}, i));
  TravelSettings settings;
  settings.z_seam_type = SeamType::aligned;
  std::vector<std::vector<Point>> seams;
  for (const auto& p : plan(settings, {}, layers)) {
    auto& layer = seams.emplace_back();
    for (const auto& step : p.steps)
      if (const auto* e = std::get_if<Extrude>(&step); e && e->role == Role::outer_wall)
        layer.push_back(e->path.front().at);
  }
  // The bar's seam goes on in a tower without a step, and no tower's jumps.
  for (std::size_t i = 1; i < seams.size(); ++i) {
    INFO("layer " << i);
    REQUIRE(seams[i].size() == (i < 10 ? 1U : 2U));
    for (const Point below : seams[i - 1])
      CHECK(std::any_of(seams[i].begin(), seams[i].end(), [&](Point p) { return distance(p, below) < 10; }));
  }
}

TEST_CASE("travel: seams at the back, at a point, anywhere", "[travel]") {
  TravelSettings settings;
  settings.z_seam_type = SeamType::back;
  for (const Point s : seams_of(settings, vase())) CHECK(std::abs(std::atan2(s.y, s.x) - 1.5708) < 0.08);
  settings.z_seam_type = SeamType::user;
  settings.z_seam_x = -50000, settings.z_seam_y = 0;
  for (const Point s : seams_of(settings, vase())) CHECK((s.x < 0 && std::abs(s.y) < 700));
  settings.z_seam_type = SeamType::random;
  const auto seams = seams_of(settings, vase());
  int right = 0, top = 0;
  for (const Point s : seams) right += s.x > 0, top += s.y > 0;
  CHECK((right > 8 && right < 32 && top > 8 && top < 32));
  CHECK(seams == seams_of(settings, vase()));
}

TEST_CASE("travel: which corners attract a seam is chosen", "[travel]") {
  // An L: five outer corners and one inner one at (10, 10) mm.
  const Ring l{{0, 0}, {30000, 0}, {30000, 10000}, {10000, 10000}, {10000, 30000}, {0, 30000}};
  const Bead bead = sample::closed_bead(l, Role::outer_wall, 0, 0);
  const auto inner = corners_of(bead, SeamCorner::inner, true, 10);
  REQUIRE(inner.size() == 1);
  CHECK(inner[0].junction == 3);
  CHECK(corners_of(bead, SeamCorner::outer, true, 10).size() == 5);
  CHECK(corners_of(bead, SeamCorner::none, true, 10).empty());
  CHECK(corners_of(bead, SeamCorner::weighted, true, 10)[0].junction == 3);
  const Bead round = sample::closed_bead(sample::circle({0, 0}, 10000, 200), Role::outer_wall, 0, 0);
  CHECK(corners_of(round, SeamCorner::any, true, 10).empty());
}

TEST_CASE("travel: no seam lies on nothing where the wall lies on something elsewhere", "[travel]") {
  const Region stem = sample::rectangle({0, 0}, {20000, 10000});
  const auto seam_over_stem = [&](const Regions& above, SeamType type, double weight) {
    TravelSettings settings;
    settings.z_seam_type = type, settings.z_seam_overhang_weight = weight;
    settings.z_seam_x = 10000, settings.z_seam_y = 20000;
    const auto seams = seams_of(settings, {sample::layer({stem}, 0), sample::layer(above, 1)});
    REQUIRE(seams.size() == 2);
    return seams[1];
  };
  const Regions tab = geometry::unite({stem}, {sample::rectangle({5000, 5000}, {15000, 14000})});
  for (const auto type : {SeamType::back, SeamType::user}) {
    const Point borne = seam_over_stem(tab, type, 0.5);
    INFO("seam at " << borne.x << ", " << borne.y);
    CHECK(borne.y <= 10100);  // within a quarter of a bead of the edge
  }
  CHECK(seam_over_stem(tab, SeamType::back, 0.5).y > 9000);  // and the nearest such place
  CHECK(seam_over_stem(tab, SeamType::back, 0).y == 13800);
  // A hat hangs all round: its seam is where it would be on a wall that stands.
  CHECK(seam_over_stem({sample::rectangle({-5000, -5000}, {25000, 15000})}, SeamType::back, 0.5) ==
        Point{24800, 14800});
}

TEST_CASE("travel: a seam line does not leap for what hangs as much everywhere", "[travel]") {
  // A cone whose walls hang by a little more or less than what still bears a beginning, elsewhere on each layer.
  std::vector<LayerInput> layers;
  for (std::size_t i = 0; i < 20; ++i) {
    const auto n = static_cast<double>(i);
    const Ring ring = round_outline(180, [&](double a) { return 15000 + 305 * n + 15 * std::sin(3 * a + 2.1 * n); });
    layers.push_back(sample::layer({{ring, {}}}, i));
  }
  TravelSettings settings;
  settings.z_seam_type = SeamType::aligned;
  const auto seams = seams_of(settings, layers);
  REQUIRE(seams.size() == 20);
  for (std::size_t i = 1; i < seams.size(); ++i) {
    INFO("layer " << i);
    CHECK(distance(seams[i], seams[i - 1]) < 1000);
  }
}
