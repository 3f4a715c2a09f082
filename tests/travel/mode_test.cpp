// SPDX-License-Identifier: GPL-3.0-or-later
#include "layers.h"
#include "travel/way.h"

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::travel;

namespace {

/// A square of 40 mm; `what` of it is a block in its middle, or, where that is said, a strip from side to side.
LayerInput with_area(Regions ObjectLayer::*what, bool from_side_to_side = false) {
  LayerInput input = sample::layer({sample::rectangle({0, 0}, {40000, 40000})}, 1, 4000);
  auto& object = input.objects[0];
  const Regions area{from_side_to_side ? sample::rectangle({0, 13000}, {40000, 27000})
                                       : sample::rectangle({10000, 13000}, {30000, 27000})};
  object.*what = area;
  object.sparse = geometry::subtract({sample::rectangle({1200, 1200}, {38800, 38800})}, area);
  return input;
}

/// The way from below the area to above it.
Way way_past(Combing mode, const LayerInput& input) {
  TravelSettings settings;
  settings.retraction_combing = mode;
  const auto prepared = prepare(settings, input);
  const RetractionSettings retraction;
  return Router(settings, retraction, prepared).way({20000, 5000}, {20000, 35000});
}

bool enters(const Way& way, const Ring& ring) {
  Point at{20000, 5000};
  for (const Point next : way.points) {
    for (int k = 0; k <= 300; ++k)
      if (side_of(ring, lerp(at, next, k / 300.0)) == Side::inside) return true;
    at = next;
  }
  return false;
}

/// Calls visit(from, to, retracted) for every piece of every travel.
template <class Visit>
void each_travel(const std::vector<LayerPlan>& plans, const Visit& visit) {
  std::optional<Point> at;
  bool retracted = false;
  for (const auto& plan : plans)
    for (const auto& step : plan.steps) {
      if (const auto* e = std::get_if<Extrude>(&step)) at = e->path.back().at;
      if (const auto* r = std::get_if<Retract>(&step)) {
        retracted = true;
        if (!r->wipe.empty()) at = r->wipe.back();
      }
      if (std::holds_alternative<Prime>(step)) retracted = false;
      if (const auto* t = std::get_if<Travel>(&step))
        for (const auto& p : t->path) {
          if (at) visit(*at, flat(p), retracted);
          at = flat(p);
        }
    }
}

TravelSettings combing(Combing mode) {
  TravelSettings settings;
  settings.retraction_combing = mode;
  return settings;
}

}  // namespace

TEST_CASE(
    "travel: with noskin ways go round skin, with no_outer_surfaces round what is seen, with infill they stay over it",
    "[travel]") {
  struct Case {
    Combing mode;
    Regions ObjectLayer::*area;
  };
  const Case c =
      GENERATE(Case{Combing::noskin, &ObjectLayer::skin}, Case{Combing::no_outer_surfaces, &ObjectLayer::top},
               Case{Combing::infill, &ObjectLayer::skin});
  const Ring block = sample::rectangle({10050, 13050}, {29950, 26950}).outer;
  const auto plain = way_past(Combing::all, with_area(c.area));
  CHECK(enters(plain, block));
  CHECK_FALSE(plain.retract);
  const auto round = way_past(c.mode, with_area(c.area));
  CHECK_FALSE(enters(round, block));
  CHECK_FALSE(round.retract);
  CHECK_FALSE(round.crosses);
  CHECK(round.points.size() > 1);
  // What oozes from the middle of the nozzle lies half its width to both sides.
  if (c.mode == Combing::no_outer_surfaces)
    CHECK_FALSE(enters(round, sample::rectangle({9850, 12850}, {30150, 27150}).outer));
}

TEST_CASE("travel: where the area of a combing mode is cut in two, travels between its halves are retracted",
          "[travel]") {
  CHECK(way_past(Combing::noskin, with_area(&ObjectLayer::skin, true)).retract);
  CHECK(way_past(Combing::no_outer_surfaces, with_area(&ObjectLayer::top, true)).retract);
  CHECK(way_past(Combing::infill, with_area(&ObjectLayer::skin, true)).retract);
  CHECK_FALSE(way_past(Combing::all, with_area(&ObjectLayer::skin, true)).retract);
  CHECK(way_past(Combing::off, with_area(&ObjectLayer::skin, true)).retract);
}

TEST_CASE("travel: with no_outer_surfaces ways keep off the outer wall", "[travel]") {
  const auto settings = combing(Combing::no_outer_surfaces);
  const auto prepared = prepare(settings, sample::layer(sample::plate()));
  const auto way = prepared.comb.way({19000, 28000}, {26000, 28000});  // round the bay, whose floor is at 12 mm
  REQUIRE(way);
  for (const Point p : *way) CHECK((p.y > 27000 || p.y < 12000 - 3 * sample::width / 2 + 30));
}

TEST_CASE("travel: with no_outer_surfaces a neck of two walls is gone through along them with filament drawn back",
          "[travel]") {
  // Two rooms and a neck between them that has no room for second walls.
  const Region rooms{{{0, 0},
                      {10000, 0},
                      {10000, 4600},
                      {20000, 4600},
                      {20000, 0},
                      {30000, 0},
                      {30000, 10000},
                      {20000, 10000},
                      {20000, 5400},
                      {10000, 5400},
                      {10000, 10000},
                      {0, 10000}},
                     {}};
  const auto settings = combing(Combing::no_outer_surfaces);
  const auto prepared = prepare(settings, sample::layer({rooms}));
  REQUIRE(prepared.comb.part_of({5000, 5000}) != prepared.comb.part_of({25000, 5000}));
  const RetractionSettings retraction;
  const auto way = Router(settings, retraction, prepared).way({5000, 2000}, {25000, 2000});
  CHECK(way.retract);  // what oozed would be a scar on them
  CHECK_FALSE(way.crosses);
}

TEST_CASE("travel: with no_outer_surfaces a neck of three walls is gone through along its middle", "[travel]") {
  // As above, a bead wider. Its outer walls' centrelines lie two widths apart.
  const Um half = 3 * sample::width / 2;
  const Region rooms{{{0, 0},
                      {10000, 0},
                      {10000, 5000 - half},
                      {20000, 5000 - half},
                      {20000, 0},
                      {30000, 0},
                      {30000, 10000},
                      {20000, 10000},
                      {20000, 5000 + half},
                      {10000, 5000 + half},
                      {10000, 10000},
                      {0, 10000}},
                     {}};
  const auto settings = combing(Combing::no_outer_surfaces);
  auto layer = sample::layer({rooms});
  const auto prepared = prepare(settings, layer);
  REQUIRE(prepared.comb.part_of({5000, 5000}) != prepared.comb.part_of({25000, 5000}));
  const RetractionSettings retraction;
  const auto way = Router(settings, retraction, prepared).way({5000, 2000}, {25000, 2000});
  CHECK_FALSE(way.retract);
  CHECK(way.points.size() > 2);
  const Um wall = half - sample::width / 2;  // from the middle of the neck to the centrelines
  Point last{5000, 2000};
  for (const Point p : way.points) {
    for (int k = 0; k <= 100; ++k)
      if (const Point at = lerp(last, p, k / 100.0); at.x > 10000 && at.x < 20000)
        CHECK(std::abs(at.y - 5000) <= wall - sample::width / 2 + static_cast<Um>(2 * Comb::slack_um));
    last = p;
  }
}

namespace {

double distance_to(Point p, Point a, Point b) {
  const double x = b.x - a.x, y = b.y - a.y, length2 = x * x + y * y;
  const double t = length2 > 0 ? std::clamp(((p.x - a.x) * x + (p.y - a.y) * y) / length2, 0.0, 1.0) : 0.0;
  return distance(p, lerp(a, b, t));
}

/// How much of a way lies within half a nozzle of the centrelines of outer walls, µm.
double on_outer_walls_um(const LayerInput& layer, Point p, const Polyline& way) {
  constexpr int parts = 400;
  double sum = 0;
  for (const Point q : way) {
    for (int k = 0; k < parts; ++k) {
      const Point at = lerp(p, q, (k + 0.5) / parts);
      const bool near = std::any_of(layer.objects[0].beads.begin(), layer.objects[0].beads.end(), [&](const Bead& b) {
        if (b.role != Role::outer_wall) return false;
        for (std::size_t i = b.closed ? 0 : 1; i < b.path.size(); ++i)
          if (distance_to(at, b.path[i == 0 ? b.path.size() - 1 : i - 1].at, b.path[i].at) < layer.nozzle / 2)
            return true;
        return false;
      });
      if (near) sum += distance(p, q) / parts;
    }
    p = q;
  }
  return sum;
}

}  // namespace

TEST_CASE("travel: with no_outer_surfaces no way that is not drawn back lies on outer walls for longer than it must",
          "[travel]") {
  // A room with a finger of two walls, which ends within reach of the second walls, and a tail of a single bead.
  const Region room{
      {{0, 0}, {10000, 0}, {10000, 4600}, {12000, 4600}, {12000, 5400}, {10000, 5400}, {10000, 10000}, {0, 10000}}, {}};
  auto layer = sample::layer({room});
  layer.objects[0].outline.push_back(sample::rectangle({-2400, 1800}, {0, 2200}));
  layer.objects[0].outline = geometry::unite(layer.objects[0].outline, {});
  Bead tail;
  tail.path = {{{-2200, 2000}, sample::width, 1.F}, {{-100, 2000}, sample::width, 1.F}};
  tail.role = Role::outer_wall;
  layer.objects[0].beads.push_back(tail);
  const auto settings = combing(Combing::no_outer_surfaces);
  const auto prepared = prepare(settings, layer);
  const RetractionSettings retraction;
  const Router router(settings, retraction, prepared);
  const Point tip{11800, 5200}, end{-2200, 2000}, middle{5000, 5000};
  CHECK(router.way(tip, {9400, 5400}).retract);
  CHECK(router.way(end, {400, 2400}).retract);
  CHECK_FALSE(router.way({200, 5000}, middle).retract);  // off the wall squarely
  std::vector<Point> places{middle};
  for (const Bead& bead : layer.objects[0].beads)
    for (const Junction& j : bead.path) places.push_back(j.at);
  int unretracted = 0;
  for (const Point p : places)
    for (const Point q : places) {
      if (p == q) continue;
      const Way way = router.way(p, q);
      if (way.retract || length_from(p, way.points) < retraction.retraction_min_travel) continue;
      ++unretracted;
      CHECK(on_outer_walls_um(layer, p, way.points) <= 1.5 * layer.nozzle + 100);
    }
  CHECK(unretracted > 100);
}

TEST_CASE("travel: the way to the next layer goes up before it goes anywhere", "[travel]") {
  std::optional<Point3> at;
  int ways_up = 0;
  const auto island = Regions{sample::rectangle({60000, 0}, {70000, 10000})};
  for (const auto& layer : plan({}, {}, {sample::layer(sample::plate(), 0), sample::layer(island, 1)}))
    for (const auto& step : layer.steps) {
      if (const auto* t = std::get_if<Travel>(&step))
        for (const Point3 to : t->path) {
          if (at && at->z != to.z) {
            CHECK(flat(*at) == flat(to));
            ++ways_up;
          }
          at = to;
        }
      if (const auto* e = std::get_if<Extrude>(&step)) at = place_of(*e, e->path.size() - 1, layer.z);
    }
  CHECK(ways_up == 1);
}

TEST_CASE("travel: a combing offset keeps travels that much further in, or lets them that much further out",
          "[travel]") {
  // A bay from above: ways from arm to arm bend round its floor, the boundary of combing.
  const Region bay{
      {{0, 0}, {30000, 0}, {30000, 30000}, {20000, 30000}, {20000, 12000}, {10000, 12000}, {10000, 30000}, {0, 30000}},
      {}};
  Um before = 0;
  for (const Um offset : {-400, 0, 400}) {
    auto settings = combing(Combing::all);
    settings.retraction_combing_offset = offset;
    settings.retraction_combing_max_detour.reset();
    const auto prepared = prepare(settings, sample::layer({bay}));
    const auto way = prepared.comb.way({5000, 28000}, {25000, 28000});
    REQUIRE(way);
    REQUIRE(way->size() > 1);
    Um lowest = max_coord;  // at the corners of the floor
    for (std::size_t i = 0; i + 1 < way->size(); ++i) lowest = std::min(lowest, (*way)[i].y);
    CHECK(lowest == Approx(12000 - sample::width / 2 + offset).margin(20));
    CHECK(lowest > before);
    before = lowest;
  }
}

TEST_CASE("travel: an offset that closes the boundary leaves travels there to retractions", "[travel]") {
  auto settings = combing(Combing::all);
  settings.retraction_combing_offset = -10000;
  const auto prepared = prepare(settings, sample::layer({sample::rectangle({0, 0}, {15000, 15000})}));
  CHECK(prepared.comb.empty());
  CHECK(sample::count(plan(settings, {}, {sample::layer(sample::plate())})).retractions >
        sample::count(plan({}, {}, {sample::layer(sample::plate())})).retractions);
}

TEST_CASE("travel: a way inside is retracted from a length of its own on where an outer wall begins", "[travel]") {
  const auto layer = sample::layer({sample::rectangle({0, 0}, {40000, 40000})});
  const auto retracted = [&](const TravelSettings& settings, Um length, bool to_outer_wall) {
    const auto prepared = prepare(settings, layer);
    const RetractionSettings retraction;
    const Router router(settings, retraction, prepared);
    return router.way({5000, 20000}, {5000 + length, 20000}, to_outer_wall).retract;
  };
  TravelSettings settings;
  settings.retraction_combing_max_distance_wall_0 = 6000;
  CHECK(retracted(settings, 6100, true));
  CHECK_FALSE(retracted(settings, 5900, true));
  CHECK_FALSE(retracted(settings, 30000, false));
  settings.retraction_combing_max_distance_wall_0 = 0;
  const Um least = RetractionSettings{}.retraction_min_travel;
  CHECK(retracted(settings, least + 100, true));
  CHECK_FALSE(retracted(settings, least - 100, true));
  settings.retraction_combing_max_distance_wall_0.reset();
  CHECK_FALSE(retracted(settings, 30000, true));
  settings.retraction_combing_max_distance = 8000;  // holds for all beads
  CHECK(retracted(settings, 8100, true));
  CHECK(retracted(settings, 8100, false));
}

TEST_CASE("travel: it is the bead that a way leads to that says whether an outer wall begins", "[travel]") {
  // Infill at the left; the wall begins in a corner at the right.
  auto layer = sample::layer({sample::rectangle({0, 0}, {40000, 10000})});
  auto& beads = layer.objects[0].beads;
  beads.clear();
  const auto add = [&](Role role, const Polyline& path) {
    auto& bead = beads.emplace_back();
    for (const Point at : path) bead.path.push_back({at, sample::width, 1.F});
    bead.role = role, bead.closed = path.size() > 2;
  };
  add(Role::outer_wall, {{200, 200}, {39800, 200}, {39800, 9800}, {200, 9800}});
  add(Role::infill, {{5000, 3000}, {5000, 7000}});
  const auto retractions = [&](bool infill_first, std::optional<Um> from) {
    TravelSettings settings;
    settings.z_seam_type = SeamType::user, settings.z_seam_x = 40000, settings.z_seam_y = 10000;
    settings.infill_before_walls = infill_first, settings.retraction_combing_max_distance_wall_0 = from;
    return sample::count(plan(settings, {}, {layer})).retractions;
  };
  CHECK(retractions(true, 10000) == retractions(true, {}) + 1);
  CHECK(retractions(false, 10000) == retractions(false, {}));  // to the infill
}

TEST_CASE("travel: a combed way much longer than the straight one gives way to a retraction", "[travel]") {
  auto settings = combing(Combing::all);
  settings.retraction_combing_max_detour.reset();
  const auto combed = sample::count(plan(settings, {}, {sample::layer(sample::plate())}));
  settings.retraction_combing_max_detour = length(1000);
  const auto straight = sample::count(plan(settings, {}, {sample::layer(sample::plate())}));
  CHECK(straight.retractions > combed.retractions);
  CHECK(straight.travel_mm < combed.travel_mm);
  RetractionSettings never;
  never.retraction_enable = false;  // then a detour is all there is against strings
  CHECK(sample::count(plan(settings, never, {sample::layer(sample::plate())})).travel_mm >= combed.travel_mm - 0.01);
}

TEST_CASE("travel: retracted travels go round other parts when asked, and keep their distance", "[travel]") {
  const Regions parts{sample::rectangle({0, 0}, {8000, 8000}), sample::rectangle({14000, -10000}, {18000, 6000}),
                      sample::rectangle({24000, 0}, {32000, 8000})};
  TravelSettings settings;
  settings.travel_avoid_other_parts = true;
  settings.travel_avoid_distance = 1000;
  const auto layer = sample::layer(parts);
  const Obstacles obstacles(settings, layer);
  const Point p{4000, 4000}, q{28000, 4000};
  const auto way = obstacles.way(p, q);
  REQUIRE(way);
  CHECK(way->size() > 1);
  Point at = p;
  for (const Point next : *way) {
    for (int k = 0; k <= 100; ++k) {
      const Point r = lerp(at, next, k / 100.0);
      const Point nearest{std::clamp(r.x, 14000, 18000), std::clamp(r.y, -10000, 6000)};
      CHECK(distance(r, nearest) > 980);
    }
    at = next;
  }
}

TEST_CASE("travel: ways stay inside a concave reach and out of no-go areas, or it is said where not", "[travel]") {
  LayerInput input =
      sample::layer({sample::rectangle({0, 0}, {8000, 8000}), sample::rectangle({30000, 0}, {38000, 8000})});
  input.room.no_go = {sample::rectangle({15000, -50000}, {20000, 20000}).outer};
  input.room.reach = sample::rectangle({-60000, -60000}, {60000, 60000}).outer;
  const Region area{input.room.no_go[0], {}};
  const auto routed = [&] {
    const auto prepared = std::vector{prepare({}, input)};
    return route({}, {}, prepared[0], order({}, prepared[0], link({}, prepared)[0]), Point{4000, 4000});
  };
  auto out = routed();
  double inside_um = 0;
  each_travel({out.plan}, [&](Point a, Point b, bool) {
    for (int k = 0; k <= 200; ++k)
      if (side_of(area.outer, lerp(a, b, k / 200.0)) != Side::outside) inside_um += distance(a, b) / 200;
  });
  CHECK(inside_um == 0);
  CHECK(out.departures.outside.count == 0);
  CHECK(notices_of(std::vector{out}).empty());

  input.room.no_go = {sample::rectangle({15000, -70000}, {20000, 70000}).outer};  // from edge to edge of the reach
  out = routed();
  CHECK(out.departures.outside.count == 1);
  const auto notices = notices_of(std::vector{out});
  REQUIRE(notices.size() == 1);
  CHECK(notices[0].code == "travel_outside_reach");
}

TEST_CASE("travel: a lift without room gives way, at most up to the top of the reach, and it is said", "[travel]") {
  RetractionSettings retraction;
  retraction.retraction_hop = 1000;
  retraction.retraction_hop_type = HopType::spiral;
  LayerInput input = sample::layer(sample::plate());
  input.room = {sample::rectangle({0, 0}, {40000, 30000}).outer, {}, 700};
  const auto prepared = std::vector{prepare({}, input)};
  const auto out = route({}, retraction, prepared[0], order({}, prepared[0], link({}, prepared)[0]), Point{1000, 1000});
  Um top = 0;
  for (const auto& step : out.plan.steps)
    if (const auto* t = std::get_if<Travel>(&step))
      for (const auto& p : t->path) top = std::max(top, p.z);
  CHECK(top == 700);
  CHECK(out.departures.lowered.count > 0);
  CHECK(notices_of(std::vector{out})[0].code == "lift_gave_way");
}

TEST_CASE("travel: retractions within a length of filament are counted, and more than that are left out", "[travel]") {
  RetractionSettings retraction;
  const auto strict = [&] {
    auto settings = combing(Combing::off);
    return sample::count(plan(settings, retraction, {sample::layer(sample::plate())})).retractions;
  };
  const int all = strict();
  retraction.retraction_count_max = 3;
  retraction.retraction_extrusion_window = 1000000;  // more than the layer takes
  CHECK(strict() == 3);
  retraction.retraction_extrusion_window = 100;
  const int some = strict();
  CHECK(some > 3);
  CHECK(some <= all);
  const auto prepared = std::vector{prepare({}, sample::layer(sample::plate()))};
  retraction.retraction_count_max = 0;
  TravelSettings settings;
  settings.retraction_combing_max_detour.reset();
  const auto out =
      route(settings, retraction, prepared[0], order({}, prepared[0], link({}, prepared)[0]), std::nullopt);
  CHECK(out.departures.unretracted.count == 1);  // to the island
}

TEST_CASE("travel: combing goes by the outline of parts without walls alone, and counts open outer walls", "[travel]") {
  using namespace sample;
  using namespace weft::literals;
  const Region walled = rectangle(0, 0, 20_mm, 20_mm), bare = rectangle(30_mm, 0, 50_mm, 20_mm),
               rib = rectangle(60_mm, 0, 60.4_mm, 20_mm);
  LayerInput input;
  input.height = 200;
  ObjectLayer& object = input.objects.emplace_back();
  object.outline = {walled, bare, rib};
  const Regions centreline = geometry::offset({walled}, {.by = -width / 2});
  object.beads.push_back(closed_bead(centreline[0].outer, Role::outer_wall, 0, 0));
  hatch(bare, 4000, 1, 0, object.beads);
  for (Bead& bead : object.beads)
    if (bead.part == 1) bead.path.back().at.x += 150;  // infill reaches over the outline
  Bead single;
  single.path = {{{60'200, 100}, width, 1.F}, {{60'200, 19'900}, width, 1.F}};
  single.role = Role::outer_wall, single.part = 2;
  object.beads.push_back(single);

  TravelSettings settings;
  settings.retraction_combing = GENERATE(Combing::all, Combing::noskin);
  const auto inside = [](const Comb& comb, Um x, Um y) { return comb.part_of({x, y}) != Comb::outside; };
  const auto as_it_is = prepare(settings, input).comb;
  CHECK(inside(as_it_is, 10_mm, 10_mm));
  CHECK(inside(as_it_is, 40_mm, 10_mm));
  CHECK(inside(as_it_is, 50'140, 10_mm));
  CHECK(inside(as_it_is, 60'200, 10_mm));
  CHECK_FALSE(inside(as_it_is, 25_mm, 10_mm));
  settings.retraction_combing = Combing::all;
  settings.retraction_combing_offset = -1_mm;
  const auto drawn_in = prepare(settings, input).comb;
  CHECK_FALSE(inside(drawn_in, 1_mm, 10_mm));
  CHECK(inside(drawn_in, 30'100, 10_mm));  // walls are moved, outlines are not
}
