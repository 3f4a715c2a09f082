// SPDX-License-Identifier: GPL-3.0-or-later
#include "travel/layers.h"

#include <algorithm>
#include <vector>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::travel;

namespace {

/// Two copies of a part, 60 mm apart, each with three columns of support around it that are lower or as high.
LayerInput with_support() {
  LayerInput input;
  input.time.index = input.time.number = 3;
  input.z = 800, input.height = 200;
  for (ObjectId id = 0; id < 2; ++id) {
    const Um x = static_cast<Um>(id) * 60000;
    auto part = sample::object({sample::rectangle({x, 0}, {x + 8000, 8000})});
    part.object = id;
    input.objects.push_back(std::move(part));
  }
  for (ObjectId id = 0; id < 2; ++id) {
    const Um x = static_cast<Um>(id) * 60000;
    auto columns = sample::object({sample::rectangle({x - 8000, 0}, {x - 4000, 8000}),
                                   sample::rectangle({x + 12000, 0}, {x + 16000, 8000}),
                                   sample::rectangle({x, 12000}, {x + 8000, 16000})});
    columns.object = id, columns.support = true, columns.stack = 1;
    for (auto& bead : columns.beads) bead.role = Role::support;
    input.objects.push_back(std::move(columns));
  }
  return input;
}

}  // namespace

TEST_CASE("travel: support is printed before what stands on it, and all of one object's together", "[travel]") {
  for (const auto kind : {PathOrder::nearest, PathOrder::optimized}) {
    TravelSettings settings;
    settings.path_order = kind;
    const auto plans = plan(settings, {}, {with_support()});
    REQUIRE(plans.size() == 1);
    std::vector<std::pair<ObjectId, bool>> runs;  // of which object, and whether support
    ObjectId object = 0;
    for (const auto& step : plans[0].steps) {
      if (const auto* start = std::get_if<ObjectStart>(&step)) object = start->object;
      const auto* bead = std::get_if<Extrude>(&step);
      if (bead == nullptr) continue;
      const std::pair now{object, bead->role == Role::support};
      if (runs.empty() || runs.back() != now) runs.push_back(now);
    }
    REQUIRE(runs.size() == 4);
    for (const std::size_t i : {0U, 2U}) {
      CHECK(runs[i].second);
      CHECK_FALSE(runs[i + 1].second);
      CHECK(runs[i].first == runs[i + 1].first);
    }
  }
}

TEST_CASE("travel: ways go round support that stands in them, unless that is far or not asked for", "[travel]") {
  LayerInput input =
      sample::layer({sample::rectangle({0, 0}, {8000, 8000}), sample::rectangle({30000, 0}, {38000, 8000})});
  input.support = {sample::rectangle({18000, 2000}, {20000, 6000})};
  const Region wall = input.support.front();
  const auto meets = [&](const TravelSettings& settings) {
    const auto plans = plan(settings, {}, {input});
    int hits = 0;
    std::optional<Point> at;
    for (const auto& step : plans[0].steps) {
      if (const auto* bead = std::get_if<Extrude>(&step)) at = bead->path.back().at;
      const auto* way = std::get_if<Travel>(&step);
      if (way == nullptr) continue;
      for (const Point3 to : way->path) {
        for (int k = 0; at && k <= 200; ++k)
          hits += side_of(wall.outer, lerp(*at, flat(to), k / 200.0)) == Side::inside ? 1 : 0;
        at = flat(to);
      }
    }
    return hits;
  };
  TravelSettings settings;
  settings.z_seam_type = SeamType::user, settings.z_seam_y = 4000, settings.z_seam_x = 19000;  // face to face
  CHECK(meets(settings) == 0);
  settings.travel_avoid_supports = false;
  CHECK(meets(settings) > 0);
}

TEST_CASE("travel: a rung of support is printed after the beads that it ends on", "[travel]") {
  for (const auto kind : {PathOrder::nearest, PathOrder::optimized}) {
    TravelSettings settings;
    settings.path_order = kind;
    LayerInput input;
    input.time.index = input.time.number = 3;
    input.z = 800, input.height = 200;
    auto column = sample::object({sample::rectangle({0, 0}, {8000, 8000})});
    column.support = true;
    for (auto& bead : column.beads) bead.role = Role::support, bead.sequence = 0;
    const std::size_t others = column.beads.size();
    REQUIRE(others > 3);
    Bead rung;  // the nozzle comes from where it begins
    rung.role = Role::support, rung.sequence = 1;
    rung.path = {{{0, 0}, 400, 1.F}, {{2000, 400}, 400, 1.F}};
    column.beads.insert(column.beads.begin(), rung);
    input.objects.push_back(std::move(column));
    std::vector<Polyline> printed;
    const auto plans = plan(settings, {}, {input});
    for (const auto& step : plans[0].steps)
      if (const auto* bead = std::get_if<Extrude>(&step))
        printed.push_back({bead->path.front().at, bead->path.back().at});
    REQUIRE(printed.size() > others);
    Polyline last = printed.back();
    std::sort(last.begin(), last.end());
    CHECK(last == Polyline{{0, 0}, {2000, 400}});
  }
}
