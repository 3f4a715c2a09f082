// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/codec.h"

#include <cmath>
#include <random>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::pipeline;

namespace {

struct Dice {
  std::mt19937 engine;
  int operator()(int least, int most) { return std::uniform_int_distribution<int>(least, most)(engine); }
};

Ring ring(Dice& dice) {
  Ring out(static_cast<std::size_t>(dice(0, 9)));
  for (auto& p : out) p = {dice(-max_coord, max_coord), dice(-max_coord, max_coord)};
  return out;
}
Regions regions(Dice& dice) {
  Regions out(static_cast<std::size_t>(dice(0, 3)));
  for (auto& r : out) r = {ring(dice), {ring(dice), ring(dice)}};
  return out;
}
Beads beads(Dice& dice) {
  Beads out(static_cast<std::size_t>(dice(0, 5)));
  for (auto& b : out) {
    b.path.resize(static_cast<std::size_t>(dice(0, 7)));
    for (auto& j : b.path)
      j = {{dice(-max_coord, max_coord), dice(-max_coord, max_coord)},
           dice(0, 5000),
           dice(0, 1) ? 1.F : static_cast<float>(dice(1, 1000)) / 997.F};
    b.role = static_cast<Role>(dice(0, static_cast<int>(roles.size()) - 1));
    b.closed = dice(0, 1) == 1;
    b.inset = static_cast<std::uint16_t>(dice(0, 65535));
    b.part = static_cast<std::uint32_t>(dice(0, 1 << 30));
    b.sequence = static_cast<std::uint32_t>(dice(0, 1 << 30));
    b.tool = static_cast<ToolId>(dice(0, 255));
    b.scope = static_cast<ScopeId>(dice(0, 65535));
  }
  return out;
}
Notices notices(Dice& dice) {
  return Notices(static_cast<std::size_t>(dice(0, 2)), Notice{"code", std::string("a\0b ü", 6)});
}

/// Whole, one byte short, and one byte too long.
template <class T>
T there_and_back(const T& v) {
  const auto bytes = encode(v);
  T out;
  decode(bytes, out);
  T spoiled;
  if (!bytes.empty()) CHECK_THROWS(decode(std::string_view(bytes).substr(0, bytes.size() - 1), spoiled));
  CHECK_THROWS(decode(bytes + "x", spoiled));
  CHECK(encode(out) == bytes);
  return out;
}

}  // namespace

TEST_CASE("codec: results of stages come back as they were") {
  Dice dice{std::mt19937(7)};
  for (int round = 0; round < 50; ++round) {
    std::vector<slice::Cut> cuts(static_cast<std::size_t>(dice(0, 4)));
    for (auto& c : cuts)
      c = {{dice(0, 1000), dice(-5, 400), regions(dice)},
           {3, 0.25 * dice(0, 99), {1, -2}},
           {static_cast<std::size_t>(dice(0, 9)), -0.0, {}}};
    const auto cuts2 = there_and_back(cuts);
    REQUIRE(cuts2.size() == cuts.size());
    for (std::size_t i = 0; i < cuts.size(); ++i) {
      CHECK(cuts2[i].layer.regions == cuts[i].layer.regions);
      CHECK(cuts2[i].layer.height == cuts[i].layer.height);
      CHECK(cuts2[i].closed.widest_um == cuts[i].closed.widest_um);
      CHECK(cuts2[i].closed.at == cuts[i].closed.at);
    }
    std::vector<PlacedNotice> placed;
    for (auto& notice : notices(dice))
      placed.push_back({std::move(notice.code),
                        std::move(notice.message),
                        {dice(-max_coord, max_coord), dice(-max_coord, max_coord)}});
    const std::vector<WallLayer> walls{{beads(dice), regions(dice), regions(dice), placed}, {beads(dice), {}, {}, {}}};
    const auto walls2 = there_and_back(walls);
    CHECK(walls2[0].beads == walls[0].beads);
    CHECK(walls2[0].inside == walls[0].inside);
    CHECK(walls2[0].over_air == walls[0].over_air);
    CHECK(walls2[0].notices == walls[0].notices);
    const std::vector<FilledLayer> fills{
        {regions(dice), regions(dice), regions(dice), beads(dice), {3, 0, 7}, notices(dice)}};
    const auto fills2 = there_and_back(fills);
    CHECK(fills2[0].top == fills[0].top);
    CHECK(fills2[0].skin == fills[0].skin);
    CHECK(fills2[0].sparse == fills[0].sparse);
    CHECK(fills2[0].beads == fills[0].beads);
    CHECK(fills2[0].inner_beads == fills[0].inner_beads);
  }
}

TEST_CASE("codec: a planned layer comes back as it was") {
  Extrude bead{{{{-5, 7}, 450, 0.3F}, {{9, max_coord}, 1, 1.F}},
               Role::bridge,
               3,
               65535,
               200,
               1.0 / 3,
               {12.5F, -0.F},
               1500.1,
               {0, -20}};
  Travel travel{{{1, -2, 3}, {max_coord, 0, -7}}, 120.7, true, 0.1, 1e300};
  Retract retract{{{3, 4}, {-3, 9}}, 35.5, 0.7};
  const LayerPlan layer{1200,
                        -3,
                        {4000000000, 3, 70000, true},
                        4711,
                        {ObjectStart{7}, bead, travel, retract, Prime{}, SetFan{0.35}, Extrude{}, ObjectEnd{4294967295},
                         ToolChange{31}, SetTemperature{SetTemperature::Heater::chamber, 7, -1, true},
                         Pause{"nuts, six of M3"}, Feed{-15, 0.25, true, {4, -5}, 500}}};
  const auto out = there_and_back(layer);
  CHECK(out.z == layer.z);
  CHECK(out.height == layer.height);
  REQUIRE(out.steps.size() == layer.steps.size());
  for (std::size_t i = 0; i < out.steps.size(); ++i) REQUIRE(out.steps[i].index() == layer.steps[i].index());
  CHECK(std::get<ObjectStart>(out.steps[0]).object == 7);
  const auto& b = std::get<Extrude>(out.steps[1]);
  CHECK(b.path == bead.path);
  CHECK(b.role == bead.role);
  CHECK(b.height == bead.height);
  CHECK(b.speed_mm_s == bead.speed_mm_s);
  CHECK(b.segment_speed_mm_s == bead.segment_speed_mm_s);
  CHECK(std::signbit(b.segment_speed_mm_s[1]));
  CHECK(b.acceleration_mm_s2 == bead.acceleration_mm_s2);
  CHECK(b.below == bead.below);
  const auto& t = std::get<Travel>(out.steps[2]);
  CHECK(t.path == travel.path);
  CHECK(t.speed_mm_s == travel.speed_mm_s);
  CHECK(t.crosses_wall);
  CHECK(t.z_speed_mm_s == travel.z_speed_mm_s);
  CHECK(t.acceleration_mm_s2 == travel.acceleration_mm_s2);
  CHECK(std::get<Retract>(out.steps[3]) == retract);
  CHECK(std::get<SetFan>(out.steps[5]).share == 0.35);
  CHECK(std::get<ObjectEnd>(out.steps[7]).object == 4294967295);
  CHECK(b.tool == 3);
  CHECK(b.scope == 65535);
  CHECK(out.scope == 4711);
  CHECK(out.time == layer.time);
  CHECK(std::get<ToolChange>(out.steps[8]) == std::get<ToolChange>(layer.steps[8]));
  CHECK(std::get<SetTemperature>(out.steps[9]) == std::get<SetTemperature>(layer.steps[9]));
  CHECK(std::get<Pause>(out.steps[10]) == std::get<Pause>(layer.steps[10]));
  CHECK(std::get<Feed>(out.steps[11]) == std::get<Feed>(layer.steps[11]));
}

TEST_CASE("codec: a model comes back as it was") {
  mesh::Loaded model;
  model.path = "a/b.stl";
  model.format = mesh::Format::three_mf;
  model.sha256 = "abc";
  model.unit = "inch";
  model.triangles_in_file = 123456789;
  model.objects = {
      {"part", {{{0, 0, 0}, {-5, 9, max_coord}, {1, 2, 3}}, {{0, 1, 2}, {2, 1, 0}}}, {1, 2, 3, 4, 5, 6, 7, 8, 9}}};
  model.notices = {{"a", "b"}};
  const auto out = there_and_back(model);
  CHECK(out.path == model.path);
  CHECK(out.format == model.format);
  CHECK(out.unit == model.unit);
  CHECK(out.triangles_in_file == model.triangles_in_file);
  CHECK(out.objects[0].mesh == model.objects[0].mesh);
  CHECK(out.objects[0].repairs == model.objects[0].repairs);
  CHECK(out.notices == model.notices);
}

TEST_CASE("codec: any bytes decode or throw, and never ask for memory that is not there") {
  Dice dice{std::mt19937(11)};
  for (int round = 0; round < 20000; ++round) {
    std::string bytes(static_cast<std::size_t>(dice(0, 40)), '\0');
    for (auto& c : bytes) c = static_cast<char>(dice(0, 3) ? dice(0, 9) : dice(0, 255));
    std::vector<WallLayer> walls;
    mesh::Loaded model;
    try {
      decode(bytes, walls);
    } catch (const std::runtime_error&) {
    }
    try {
      decode(bytes, model);
    } catch (const std::runtime_error&) {
    }
  }
  SUCCEED();
}
