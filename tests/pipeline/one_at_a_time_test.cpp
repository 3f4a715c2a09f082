// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/one_at_a_time.h"

#include "core/error.h"

#include <algorithm>
#include <numeric>
#include <random>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::literals;
using namespace weft::pipeline;
using Catch::Matchers::Contains;

namespace {

/// A box of that size around (0, 0), in layers of 1 mm.
PrintedLayers box_layers(Um x, Um y, Um height) {
  PrintedLayers out;
  for (Um z = 1_mm; z <= height; z += 1_mm) {
    PrintedLayer layer;
    layer.z = z, layer.height = 1_mm;
    layer.outline = {{{{-x / 2, -y / 2}, {x / 2, -y / 2}, {x / 2, y / 2}, {-x / 2, y / 2}}, {}}};
    out.push_back(std::move(layer));
  }
  return out;
}

struct Boxed {
  Point at, size;
  Um height;
};

/// Does a box of the head meet what stands, with the nozzle anywhere in the path at any height? By definition, of
/// boxes: the slab's underside is lowest when the first layer is printed.
bool hits(const Boxed& printed, const Boxed& standing, const HeadSlab& slab) {
  if (standing.height <= 1_mm + slab.from) return false;
  const Box head = box_of(slab.outline);
  const auto apart = [](Um low_a, Um high_a, Um low_b, Um high_b) { return high_a <= low_b || high_b <= low_a; };
  return !apart(printed.at.x - printed.size.x / 2 + head.min.x, printed.at.x + printed.size.x / 2 + head.max.x,
                standing.at.x - standing.size.x / 2, standing.at.x + standing.size.x / 2) &&
         !apart(printed.at.y - printed.size.y / 2 + head.min.y, printed.at.y + printed.size.y / 2 + head.max.y,
                standing.at.y - standing.size.y / 2, standing.at.y + standing.size.y / 2);
}

struct Set {
  std::vector<Boxed> boxes;
  std::vector<PrintedLayers> layers;
  std::vector<Standing> copies;
  explicit Set(std::vector<Boxed> of) : boxes(std::move(of)), layers(boxes.size()) {
    for (std::size_t i = 0; i < boxes.size(); ++i)
      layers[i] = box_layers(boxes[i].size.x, boxes[i].size.y, boxes[i].height);
    for (std::size_t i = 0; i < boxes.size(); ++i)
      copies.push_back({std::string(1, static_cast<char>('a' + i)), boxes[i].at, {&layers[i]}, boxes[i].height});
  }
};

PlateSettings with_head() {
  PlateSettings out;
  out.machine_head_profile = "0: -10x-10, 15x-10, 15x20, -10x20; 12: -30x-25, 30x-25, 30x40, -30x40";
  out.gantry_height = 30_mm;
  return out;
}

bool stands_up(const Set& set, const std::vector<std::size_t>& order, const std::vector<HeadSlab>& head) {
  for (std::size_t j = 0; j < order.size(); ++j)
    for (std::size_t i = 0; i < j; ++i)
      for (const auto& slab : head)
        if (hits(set.boxes[order[j]], set.boxes[order[i]], slab)) return false;
  return true;
}

}  // namespace

TEST_CASE("one at a time: an order is found exactly when brute force finds one") {
  const auto head = head_of(with_head(), {});
  REQUIRE(head.size() == 3);  // two slabs and the bar
  std::mt19937 random(3);
  const auto number = [&](int least, int most) {
    return least + static_cast<Um>(random() % static_cast<unsigned>(most - least + 1));
  };
  std::size_t found = 0, none = 0;
  for (int run = 0; run < 60; ++run) {
    std::vector<Boxed> boxes;
    const auto count = static_cast<std::size_t>(number(2, 5));
    for (std::size_t i = 0; i < count; ++i)
      boxes.push_back({{number(0, 100) * 2_mm, number(0, 100) * 2_mm},
                       {number(5, 20) * 1_mm / 2 * 2, number(5, 20) * 1_mm / 2 * 2},
                       number(3, 45) * 1_mm});
    const Set set(boxes);
    const auto may = may_follow(set.copies, head);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < count; ++j) {
        const bool hit =
            std::any_of(head.begin(), head.end(), [&](const HeadSlab& slab) { return hits(boxes[j], boxes[i], slab); });
        INFO("run " << run << ": " << j << " after " << i);
        if (i != j) CHECK((may[i][j] == 0) == hit);
      }
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    bool possible = false;
    do possible = possible || stands_up(set, order, head);
    while (!possible && std::next_permutation(order.begin(), order.end()));
    const auto ours = order_of(set.copies, may);
    CHECK((ours.size() == count) == possible);
    if (ours.size() == count) CHECK(stands_up(set, ours, head));
    (possible ? found : none) += 1;
  }
  CHECK(found >= 10);
  CHECK(none >= 10);
}

TEST_CASE("one at a time: low ones first, then the nearest, what hinders is named") {
  Settings settings;
  settings.plate = with_head();
  settings.adhesion.skirt_line_count = 0;
  const Set far({{{20_mm, 20_mm}, {10_mm, 10_mm}, 25_mm},
                 {{120_mm, 20_mm}, {10_mm, 10_mm}, 8_mm},
                 {{20_mm, 120_mm}, {10_mm, 10_mm}, 25_mm}});
  const auto sequence = one_at_a_time(settings, far.copies);
  REQUIRE(sequence.size() == 3);
  CHECK(sequence[0].objects == std::vector<ObjectId>{1});
  CHECK(sequence[1].objects == std::vector<ObjectId>{0});
  CHECK(sequence[2].objects == std::vector<ObjectId>{2});
  CHECK(sequence[2].rise == 2);
  const Set near({{{20_mm, 20_mm}, {10_mm, 10_mm}, 25_mm}, {{35_mm, 20_mm}, {10_mm, 10_mm}, 25_mm}});
  CHECK_THROWS_WITH(one_at_a_time(settings, near.copies),
                    Contains("the head hits 'a' while 'b' is printed, and 'b' while 'a' is"));
  settings.plate.machine_head_profile.clear();
  CHECK_THROWS_WITH(one_at_a_time(settings, far.copies),
                    Contains("machine_head_profile does not say how wide the head is"));
}

TEST_CASE("one at a time: head profiles that are none are refused") {
  CHECK(parse_head_profile("").empty());
  const auto clockwise = parse_head_profile("0: 0x0, 0x10, 10x10, 10x0");
  REQUIRE(clockwise.size() == 1);
  CHECK(double_area(clockwise[0].outline) > 0);
  CHECK_THROWS_WITH(parse_head_profile("0: 0x0, 10x10"), Contains("encloses nothing"));
  CHECK_THROWS_WITH(parse_head_profile("5: 0x0, 10x0, 10x10; 5: 0x0, 10x0, 10x10"), Contains("do not ascend"));
  CHECK_THROWS_WITH(parse_head_profile("0x0, 10x0, 10x10"), Contains("is not a list of heights"));
  CHECK_THROWS_WITH(parse_head_profile("-1: 0x0, 10x0, 10x10"), Contains("0 … 1000 mm"));
}
