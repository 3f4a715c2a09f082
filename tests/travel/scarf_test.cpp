// SPDX-License-Identifier: GPL-3.0-or-later
#include "travel/scarf.h"

#include "layers.h"
#include "travel/blocks.h"

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::travel;

namespace {

double volume_mm3(const std::vector<Junction>& path) {
  double sum = 0;
  for (std::size_t i = 1; i < path.size(); ++i)
    sum += distance(path[i - 1].at, path[i].at) / 1000 * mean_area_mm2(path[i - 1], path[i], 0.2);
  return sum;
}

std::vector<Junction> square(Um side) {
  std::vector<Junction> path;
  for (const Point p : sample::rectangle({0, 0}, {side, side}).outer) path.push_back({p, 400, 1.F});
  path.push_back(path.front());
  return path;
}

}  // namespace

TEST_CASE("travel: a scarf seam holds the volume of the wall and covers its ramp", "[travel][law]") {
  TravelSettings settings;
  settings.scarf_joint_seam_length = GENERATE(500, 8000, 200000);
  settings.scarf_joint_seam_start_height_ratio = GENERATE(0.0, 30.0);
  const auto path = square(10000);
  const auto scarf = scarfed(settings, path, 200);
  CHECK(volume_mm3(scarf.ramp) + volume_mm3(scarf.body) + volume_mm3(scarf.cover) ==
        Approx(volume_mm3(path)).epsilon(2e-3));
  REQUIRE(scarf.ramp.size() == scarf.below.size());
  REQUIRE(scarf.ramp.size() == scarf.cover.size());
  CHECK(scarf.below.front() == rounded(200 * (1 - settings.scarf_joint_seam_start_height_ratio / 100)));
  CHECK(scarf.below.back() == 0);
  CHECK(std::is_sorted(scarf.below.rbegin(), scarf.below.rend()));
  CHECK(scarf.ramp.back().at == scarf.body.front().at);
  CHECK(scarf.body.back().at == path.front().at);
  for (std::size_t i = 0; i < scarf.ramp.size(); ++i) {
    CHECK(scarf.ramp[i].at == scarf.cover[i].at);
    CHECK(scarf.ramp[i].flow + scarf.cover[i].flow == Approx(1));
    if (i > 0) CHECK(distance(scarf.ramp[i - 1].at, scarf.ramp[i].at) <= settings.scarf_split_distance + 1);
  }
}

TEST_CASE("travel: outer walls have scarf seams from the second layer on, the nozzle goes down to where they begin",
          "[travel]") {
  TravelSettings settings;
  settings.scarf_joint_seam_length = 5000;
  settings.scarf_joint_inner_walls = GENERATE(false, true);
  int inner_ramps = 0;
  std::vector<LayerInput> inputs;
  for (std::size_t i = 0; i < 3; ++i) inputs.push_back(sample::layer(sample::plate(), i));
  const auto plans = plan(settings, {}, inputs);
  for (std::size_t i = 0; i < plans.size(); ++i) {
    int ramps = 0;
    for (std::size_t s = 0; s < plans[i].steps.size(); ++s) {
      const auto* e = std::get_if<Extrude>(&plans[i].steps[s]);
      if (!e || e->below.empty()) continue;
      CHECK((e->role == Role::outer_wall || settings.scarf_joint_inner_walls));
      ++(e->role == Role::outer_wall ? ramps : inner_ramps);
      CHECK(e->below.size() == e->path.size());
      // what comes before ends where it begins, and lower than the layer
      std::size_t before = s - 1;
      while (std::holds_alternative<Prime>(plans[i].steps[before])) --before;
      if (const auto* t = std::get_if<Travel>(&plans[i].steps[before]))
        CHECK(t->path.back() == place_of(*e, 0, plans[i].z));
      CHECK(std::holds_alternative<Extrude>(plans[i].steps[s + 1]));
    }
    CHECK(ramps == (i == 0 ? 0 : 4));
    CHECK(end_of(plans[i], {}).z == plans[i].z);
  }
  CHECK((inner_ramps > 0) == settings.scarf_joint_inner_walls);
}

TEST_CASE("travel: staggered seams of inner walls lie aside, on every second wall", "[travel]") {
  TravelSettings settings;
  settings.z_seam_type = SeamType::aligned;
  const auto seams = [&] {
    std::vector<Point> starts(3);
    const auto plans = plan(settings, {}, {sample::layer({sample::rectangle({0, 0}, {20000, 20000})})});
    int wall = 2;  // innermost first
    for (const auto& step : plans[0].steps)
      if (const auto* e = std::get_if<Extrude>(&step); e && is_wall(e->role))
        starts[static_cast<std::size_t>(wall--)] = e->path.front().at;
    return starts;
  };
  const auto plain = seams();
  CHECK(distance(plain[1], plain[0]) < 2 * sample::width);
  settings.staggered_inner_seams = true;
  const auto staggered = seams();
  CHECK(staggered[0] == plain[0]);
  CHECK(distance(staggered[1], staggered[0]) > 2.5 * sample::width);
  CHECK(distance(staggered[2], staggered[0]) < 3 * sample::width);
}
