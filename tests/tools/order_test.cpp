// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/order.h"

#include <algorithm>
#include <cstdlib>
#include <random>

#include <catch2/catch.hpp>

using namespace weft;
using tools::Costs;
using tools::ToolSets;

namespace {

/// The least that any order of all layers costs.
double least_of_all(const ToolSets& layers, std::size_t from, ToolSets& so_far, const Costs& costs) {
  if (from == layers.size()) return tools::cost_of(so_far, costs);
  double least = 1e18;
  auto layer = layers[from];
  std::sort(layer.begin(), layer.end());
  do {
    so_far.push_back(layer);
    least = std::min(least, least_of_all(layers, from + 1, so_far, costs));
    so_far.pop_back();
  } while (std::next_permutation(layer.begin(), layer.end()));
  return least;
}

std::vector<std::vector<ToolId>> sorted(ToolSets sets) {
  for (auto& set : sets) std::sort(set.begin(), set.end());
  return sets;
}

}  // namespace

TEST_CASE("tools: no order of all layers costs less than the one that is chosen, over 10,000 random prints",
          "[tools]") {
  std::mt19937 random(7);
  const auto below = [&](unsigned n) { return static_cast<unsigned>(random() % n); };
  for (int print = 0; print < 10'000; ++print) {
    const std::size_t count = 2 + below(4);
    Costs costs(count, std::vector<double>(count, 0));
    for (std::size_t a = 0; a < count; ++a)
      for (std::size_t b = 0; b < count; ++b)
        if (a != b) costs[a][b] = below(500);
    ToolSets layers(1 + below(4));
    for (auto& layer : layers)
      for (std::size_t tool = 0; tool < count; ++tool)
        if (layer.size() < 3 && below(2) == 0) layer.push_back(static_cast<ToolId>(tool));
    const auto order = tools::ordered(layers, costs, ToolOrder::least);
    REQUIRE(sorted(order) == layers);
    ToolSets so_far;
    REQUIRE(tools::cost_of(order, costs) == Approx(least_of_all(layers, 0, so_far, costs)));
  }
}

TEST_CASE(
    "tools: the order that costs least costs no more than one by number, or one that goes on from the loaded tool",
    "[tools]") {
  ToolSets layers;
  for (int i = 0; i < 50; ++i)
    layers.push_back(i % 5 == 2   ? std::vector<ToolId>{1, 2}
                     : i % 2 == 0 ? std::vector<ToolId>{0, 1}
                                  : std::vector<ToolId>{0, 2});
  const Costs even(3, std::vector<double>{1, 1, 1});
  Costs costs = even;
  for (std::size_t i = 0; i < 3; ++i) costs[i][i] = 0;
  const auto least = tools::cost_of(tools::ordered(layers, costs, ToolOrder::least), costs);
  CHECK(least <= tools::cost_of(tools::ordered(layers, costs, ToolOrder::cyclic), costs));
  CHECK(least <= tools::cost_of(tools::ordered(layers, costs, ToolOrder::fixed), costs));
  CHECK(least >= 50);  // each layer has two tools
}

TEST_CASE("tools: a fixed order is by number, a cyclic one goes on from the tool that is loaded", "[tools]") {
  const ToolSets layers{{0, 1, 2}, {0, 1, 2}, {}, {1, 2}};
  const Costs costs(3, std::vector<double>(3, 1));
  CHECK(tools::ordered(layers, costs, ToolOrder::fixed) == ToolSets{{0, 1, 2}, {0, 1, 2}, {}, {1, 2}});
  CHECK(tools::ordered(layers, costs, ToolOrder::cyclic) == ToolSets{{0, 1, 2}, {2, 0, 1}, {}, {1, 2}});
}

TEST_CASE("tools: a layer of more tools than are tried exactly has each of them once", "[tools]") {
  std::vector<ToolId> many;
  for (ToolId tool = 0; tool < 14; ++tool) many.push_back(tool);
  Costs costs(14, std::vector<double>(14, 0));
  for (std::size_t a = 0; a < 14; ++a)
    for (std::size_t b = 0; b < 14; ++b) costs[a][b] = a == b ? 0 : static_cast<double>(1 + (a * 7 + b * 3) % 11);
  const ToolSets layers{many, {3, 4}, many};
  CHECK(sorted(tools::ordered(layers, costs, ToolOrder::least)) == layers);
}

TEST_CASE("tools: an order of many tools is bettered until no stretch is cheaper turned or moved", "[tools]") {
  // Tools on a line, whose changes cost their distance: there is a way that goes along it once.
  const std::vector<int> places{5, 0, 9, 2, 7, 1, 11, 4, 10, 3, 8, 6};
  Costs costs(12, std::vector<double>(12, 0));
  std::vector<ToolId> all;
  for (std::size_t a = 0; a < 12; ++a) {
    all.push_back(static_cast<ToolId>(a));
    for (std::size_t b = 0; b < 12; ++b) costs[a][b] = std::abs(places[a] - places[b]);
  }
  const auto order = tools::ordered({all}, costs, ToolOrder::least);
  CHECK(tools::cost_of(order, costs) == 11);
}

TEST_CASE("tools: three filaments of which two print in each layer change sixty times in fifty layers", "[tools]") {
  ToolSets layers;
  const std::vector<std::vector<ToolId>> pairs{{0, 2}, {0, 1}, {1, 2}, {0, 1}, {0, 2}};
  for (std::size_t i = 0; i < 50; ++i) layers.push_back(pairs[i % pairs.size()]);
  Costs even(3, std::vector<double>(3, 1));
  for (std::size_t i = 0; i < 3; ++i) even[i][i] = 0;
  const double least = tools::cost_of(tools::ordered(layers, even, ToolOrder::least), even);
  CHECK(least == 60);
  CHECK(tools::cost_of(tools::ordered(layers, even, ToolOrder::cyclic), even) > least);
}

TEST_CASE("tools: of orders that cost the same one is chosen that purges least in one layer", "[tools]") {
  const Costs costs{{0, 140, 140}, {140, 0, 140}, {140, 140, 0}};
  CHECK(tools::ordered({{0}, {0, 1}, {0}}, costs, ToolOrder::least) == ToolSets{{0}, {0, 1}, {0}});
  CHECK(tools::ordered({{1}, {0, 1}, {1}}, costs, ToolOrder::least) == ToolSets{{1}, {1, 0}, {1}});
}
