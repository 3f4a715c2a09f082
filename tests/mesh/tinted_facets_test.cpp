// SPDX-License-Identifier: GPL-3.0-or-later
// What is painted on facets for extruders.
#include "mesh/three_mf_paint.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

using namespace weft::mesh;
using Corners = std::array<Eigen::Vector3d, 3>;

namespace {

const Corners corners{Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(8, 0, 0), Eigen::Vector3d(0, 8, 0)};

double area(const Corners& c) {
  return (c[1] - c[0]).cross(c[2] - c[0]).norm() / 2;
}

constexpr const char* hexadecimal = "0123456789ABCDEF";

/// The digits of a leaf, as they are read: from the first.
std::string leaf(int state) {
  if (state < 3) return {hexadecimal[state << 2]};
  std::string out = "C";
  int rest = state - 3;
  for (; rest >= 15; rest -= 15) out += 'F';
  return out + hexadecimal[rest];
}

/// A random tree in the order it is read, and the area of each state in it.
std::string tree(std::mt19937& random, int depth, double whole, std::vector<double>& areas) {
  const int sides = depth == 0 ? 0 : std::uniform_int_distribution(0, 3)(random);
  if (sides == 0) {
    const int state = std::uniform_int_distribution(0, 39)(random);
    areas[static_cast<std::size_t>(state)] += whole;
    return leaf(state);
  }
  const int special = std::uniform_int_distribution(0, 2)(random);
  std::string out{hexadecimal[(special << 2) | sides]};
  // Shares of the pieces, the last first: halves; two quarters and a half; four quarters.
  const std::vector<std::vector<double>> shares{{0.5, 0.5}, {0.5, 0.25, 0.25}, {0.25, 0.25, 0.25, 0.25}};
  for (const double share : shares[static_cast<std::size_t>(sides - 1)])
    out += tree(random, depth - 1, whole * share, areas);
  return out;
}

}  // namespace

TEST_CASE("paint: leaves name extruders, one digit up to the second, more from the third on") {
  const auto state = [](const std::string& text) {
    const auto all = tinted_facets(text, corners);
    REQUIRE(all);
    return all->empty() ? 0 : all->front().state;
  };
  CHECK(state("0") == 0);
  CHECK(state("4") == 1);
  CHECK(state("8") == 2);
  CHECK(state("0C") == 3);
  CHECK(state("1C") == 4);
  CHECK(state("EC") == 17);
  CHECK(state("0FC") == 18);
  CHECK(state("0FFC") == 33);
}

TEST_CASE("paint: what is cut short, goes on, or is no digit is refused") {
  for (const auto* text : {"", "C", "FC", "1", "41", "9G", "44"}) {
    INFO(text);
    CHECK_FALSE(tinted_facets(text, corners));
  }
}

TEST_CASE("paint: whatever was painted comes back with its area") {
  std::mt19937 random(7);
  for (int i = 0; i < 500; ++i) {
    std::vector<double> wanted(40);
    auto text = tree(random, 5, area(corners), wanted);
    std::reverse(text.begin(), text.end());  // it is read from its end
    const auto all = tinted_facets(text, corners);
    INFO(text);
    REQUIRE(all);
    std::vector<double> found(40);
    for (const auto& facet : *all) found.at(static_cast<std::size_t>(facet.state)) += area(facet.corners);
    for (std::size_t s = 1; s < found.size(); ++s) CHECK(found[s] == Approx(wanted[s]).margin(1e-9));
  }
}
