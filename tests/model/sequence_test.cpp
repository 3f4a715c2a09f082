// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/sequence.h"

#include <catch2/catch.hpp>

using namespace weft;

namespace {

std::vector<LayerHeight> heights(Um height, std::size_t count) {
  std::vector<LayerHeight> out;
  for (std::size_t i = 0; i < count; ++i) out.push_back({height * static_cast<Um>(i + 1), height});
  return out;
}
std::vector<Um> tops(const Timeline& timeline) {
  std::vector<Um> out;
  for (const auto& layer : timeline) out.push_back(layer.z);
  return out;
}
std::vector<std::uint32_t> numbers(const Timeline& timeline) {
  std::vector<std::uint32_t> out;
  for (const auto& layer : timeline) out.push_back(layer.time.number);
  return out;
}

}  // namespace

TEST_CASE("sequence: objects of one stack end at their own heights, and each layer holds those that are left") {
  const std::vector<Stack> stacks{{heights(200, 3), {{0, 3}, {1, 1}, {2, 2}}}};
  const auto timeline = timeline_of(by_layer(3), stacks);
  REQUIRE(timeline.size() == 3);
  CHECK(timeline[0].parts == std::vector<TimelineLayer::Part>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  CHECK(timeline[1].parts == std::vector<TimelineLayer::Part>{{0, 1, 0}, {2, 1, 0}});
  CHECK(timeline[2].parts == std::vector<TimelineLayer::Part>{{0, 2, 0}});
  for (std::uint32_t i = 0; i < 3; ++i) CHECK(timeline[i].time == Moment{i, 0, i, false});
}

TEST_CASE("sequence: layers of other heights are merged by z, and lie in one layer where they meet") {
  const std::vector<Stack> stacks{{heights(200, 3), {{0, 3}}}, {heights(300, 2), {{1, 2}}}};
  const auto timeline = timeline_of(by_layer(2), stacks);
  CHECK(tops(timeline) == std::vector<Um>{200, 300, 400, 600});
  CHECK(numbers(timeline) == std::vector<std::uint32_t>{0, 1, 2, 3});
  CHECK(timeline[1].parts == std::vector<TimelineLayer::Part>{{1, 0, 1}});
  CHECK(timeline[3].parts == std::vector<TimelineLayer::Part>{{0, 2, 0}, {1, 1, 1}});
  CHECK(timeline[3].height == 300);
}

TEST_CASE("sequence: objects one at a time each begin on the bed, however high the one before") {
  const std::vector<Stack> stacks{{heights(200, 3), {{0, 3}, {1, 2}, {2, 3}}}};
  const Sequence one_by_one{{.objects = {1}, .rise = 0}, {.objects = {0}, .rise = 1}, {.objects = {2}, .rise = 2}};
  const auto timeline = timeline_of(one_by_one, stacks);
  CHECK(tops(timeline) == std::vector<Um>{200, 400, 200, 400, 600, 200, 400, 600});
  CHECK(numbers(timeline) == std::vector<std::uint32_t>{0, 1, 0, 1, 2, 0, 1, 2});
  for (const auto& layer : timeline) {
    CHECK(layer.time.first() == (layer.z == 200));
    CHECK(layer.time.comes_down == (layer.time.index == 2 || layer.time.index == 5));
  }
}

TEST_CASE("sequence: another rise begins even where it does not begin lower") {
  // A single layer each: z never falls.
  const std::vector<Stack> stacks{{heights(200, 1), {{0, 1}, {1, 1}}}};
  const auto timeline = timeline_of({{.objects = {0}, .rise = 0}, {.objects = {1}, .rise = 1}}, stacks);
  REQUIRE(timeline.size() == 2);
  CHECK(timeline[1].time.comes_down);
  CHECK(timeline[1].time.first());
}

TEST_CASE("sequence: the tools of a layer share its number, and none of them comes down") {
  const std::vector<Stack> stacks{{heights(200, 2), {{0, 2}}}};
  const Sequence tools{{.objects = {0}, .from = 0, .to = 200, .tool = 0},
                       {.objects = {0}, .from = 0, .to = 200, .tool = 1},
                       {.objects = {0}, .from = 200, .to = 400, .tool = 1},
                       {.objects = {0}, .from = 200, .to = 400, .tool = 0}};
  const auto timeline = timeline_of(tools, stacks);
  CHECK(tops(timeline) == std::vector<Um>{200, 200, 400, 400});
  CHECK(numbers(timeline) == std::vector<std::uint32_t>{0, 0, 1, 1});
  for (std::uint32_t i = 0; i < 4; ++i) {
    CHECK(timeline[i].time.pass == i);
    CHECK_FALSE(timeline[i].time.comes_down);
  }
}
