#include "pipeline/codec.h"

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
    b.role = static_cast<Role>(dice(0, static_cast<int>(role_names.size()) - 1));
    b.closed = dice(0, 1) == 1;
    b.inset = static_cast<std::uint16_t>(dice(0, 65535));
    b.part = static_cast<std::uint32_t>(dice(0, 1 << 30));
    b.sequence = static_cast<std::uint32_t>(dice(0, 1 << 30));
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
    const std::vector<WallLayer> walls{{beads(dice), regions(dice), notices(dice)}, {beads(dice), {}, {}}};
    const auto walls2 = there_and_back(walls);
    CHECK(walls2[0].beads == walls[0].beads);
    CHECK(walls2[0].inside == walls[0].inside);
    CHECK(walls2[0].notices == walls[0].notices);
    const std::vector<FilledLayer> fills{{regions(dice), regions(dice), regions(dice), beads(dice), notices(dice)}};
    const auto fills2 = there_and_back(fills);
    CHECK(fills2[0].top == fills[0].top);
    CHECK(fills2[0].skin == fills[0].skin);
    CHECK(fills2[0].sparse == fills[0].sparse);
    CHECK(fills2[0].beads == fills[0].beads);
  }
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
