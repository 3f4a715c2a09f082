// SPDX-License-Identifier: GPL-3.0-or-later
#include "layers.h"
#include "travel/lift.h"

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::travel;

namespace {

std::vector<LayerInput> stack(std::size_t layers) {
  std::vector<LayerInput> inputs;
  for (std::size_t i = 0; i < layers; ++i) inputs.push_back(sample::layer(sample::plate(), i));
  return inputs;
}

double outer_wall_um(const std::vector<LayerPlan>& plans) {
  double sum = 0;
  for (const auto& p : plans)
    for (const auto& step : p.steps)
      if (const auto* e = std::get_if<Extrude>(&step); e && e->role == Role::outer_wall)
        for (std::size_t i = 1; i < e->path.size(); ++i) sum += distance(e->path[i - 1].at, e->path[i].at);
  return sum;
}

}  // namespace

TEST_CASE("travel: a retracted travel is lifted by the hop and comes down again", "[travel]") {
  RetractionSettings retraction;
  retraction.retraction_hop = 600;
  retraction.retraction_hop_type = GENERATE(HopType::vertical, HopType::slope, HopType::spiral);
  retraction.retraction_hop_above = 300;
  for (const auto& p : plan({}, retraction, stack(3))) {
    bool retracted = false;
    for (const auto& step : p.steps) {
      if (std::holds_alternative<Retract>(step)) retracted = true;
      if (std::holds_alternative<Prime>(step)) retracted = false;
      if (const auto* t = std::get_if<Travel>(&step)) {
        Um top = 0;
        for (const auto& q : t->path) top = std::max(top, q.z);
        CHECK(t->path.back().z == p.z);
        CHECK(top == (retracted && p.z >= 300 ? p.z + 600 : p.z));
      }
    }
  }
}

TEST_CASE("travel: a circle that would leave the reach goes to the other side, then becomes a slope", "[travel]") {
  RetractionSettings retraction;
  retraction.retraction_hop = 1000;
  retraction.retraction_hop_type = HopType::spiral;
  const Polyline way{{50000, 0}};
  const auto free = lifted(retraction, {0, 0}, way, 200, {}).path;
  CHECK(box_of(std::vector{flat(free[4])}).max.y > 0);
  const auto right =
      lifted(retraction, {0, 0}, way, 200, {sample::rectangle({-20000, -20000}, {60000, 100}).outer, {}}).path;
  CHECK(flat(right[7]).y < -100);
  const auto neither =
      lifted(retraction, {0, 0}, way, 200, {sample::rectangle({-20000, -100}, {60000, 100}).outer, {}}).path;
  for (const auto& p : neither) CHECK(p.y == 0);
  CHECK(neither.front().z == 1200);
  CHECK(neither.front().x == Approx(2747).margin(2));  // 1 mm / tan 20°
  CHECK((neither.back() == Point3{50000, 0, 200}));
}

TEST_CASE("travel: a seam gap shortens each outer wall by its length, or that share of the nozzle", "[travel]") {
  TravelSettings settings;
  settings.seam_gap_distance = length(0);
  const double whole = outer_wall_um(plan(settings, {}, stack(2)));
  settings.seam_gap_distance = GENERATE(length(100), share(25));
  CHECK(whole - outer_wall_um(plan(settings, {}, stack(2))) == Approx(2 * 4 * 100.0).margin(8));
}

TEST_CASE("travel: coasting leaves out its volume before retractions, and the nozzle still gets to the end",
          "[travel]") {
  TravelSettings settings;
  const auto plain = plan(settings, {}, stack(2));
  settings.coasting_enable = true;
  settings.coasting_volume = 0.08;  // 1 mm of a band of 0.4 × 0.2
  const auto coasting = plan(settings, {}, stack(2));
  const auto volume = [](const std::vector<LayerPlan>& plans) {
    double um = 0;
    for (const auto& p : plans)
      for (const auto& step : p.steps)
        if (const auto* e = std::get_if<Extrude>(&step))
          for (std::size_t i = 1; i < e->path.size(); ++i) um += distance(e->path[i - 1].at, e->path[i].at);
    return um;
  };
  int inside_layers = 0;  // retractions at a change of layer are not known to the layer below
  for (const auto& p : coasting)
    for (std::size_t i = 1; i < p.steps.size(); ++i)
      inside_layers += std::holds_alternative<Retract>(p.steps[i]) && i > 1 ? 1 : 0;
  CHECK(volume(plain) - volume(coasting) == Approx(1000.0 * inside_layers).margin(10));
  CHECK(sample::count(plain).retractions == sample::count(coasting).retractions);
}

TEST_CASE("travel: a wipe runs over what was printed, and the travel begins where it ends", "[travel]") {
  RetractionSettings retraction;
  retraction.wipe = true;
  TravelSettings off;
  off.retraction_combing = Combing::off;
  off.seam_gap_distance = length(0);  // a wipe runs over the gap as well, before what was printed
  int wipes = 0;
  for (const auto& p : plan(off, retraction, stack(1)))
    for (std::size_t i = 1; i < p.steps.size(); ++i)
      if (const auto* r = std::get_if<Retract>(&p.steps[i]); r && !r->wipe.empty()) {
        const auto* e = std::get_if<Extrude>(&p.steps[i - 1]);
        if (e == nullptr) continue;
        ++wipes;
        double um = 0;
        Point at = e->path.back().at;
        for (const Point q : r->wipe) um += distance(at, q), at = q;
        CHECK(um > 997);
        CHECK(um < 1000 + 0.15 * 400 + 3);  // a loop's begins by crossing the gap of 15 % of the nozzle at its end
      }
  CHECK(wipes > 5);
}
