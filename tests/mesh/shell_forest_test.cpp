// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/shell_forest.h"

#include "tasks/tasks.h"

#include <map>
#include <random>
#include <set>

#include <catch2/catch.hpp>

using namespace weft;
using mesh::ShellForest;

namespace {

struct Bond {
  std::uint32_t a, b;
  bool agree;
};

/// What a forest should say: number and way of each triangle by flooding from the lowest, and shells without
/// orientation.
struct Flooded {
  std::vector<std::uint32_t> shell;
  std::vector<bool> turned;
  std::set<std::uint32_t> one_sided;
  std::uint32_t shells = 0;
};

Flooded flooded(std::size_t count, const std::vector<Bond>& bonds) {
  std::multimap<std::uint32_t, std::pair<std::uint32_t, bool>> near;
  for (const auto& [a, b, agree] : bonds) near.insert({{a, {b, agree}}, {b, {a, agree}}});
  Flooded out{std::vector<std::uint32_t>(count, ~0U), std::vector<bool>(count), {}};
  for (std::uint32_t seed = 0; seed < count; ++seed) {
    if (out.shell[seed] != ~0U) continue;
    out.shell[seed] = out.shells;
    for (std::vector<std::uint32_t> stack{seed}; !stack.empty();) {
      const std::uint32_t at = stack.back();
      stack.pop_back();
      for (auto [it, end] = near.equal_range(at); it != end; ++it) {
        const auto [other, agree] = it->second;
        const bool turned = agree ? out.turned[at] : !out.turned[at];
        if (out.shell[other] == ~0U) {
          out.shell[other] = out.shells;
          out.turned[other] = turned;
          stack.push_back(other);
        } else if (out.turned[other] != turned) {
          out.one_sided.insert(out.shells);
        }
      }
    }
    ++out.shells;
  }
  return out;
}

}  // namespace

TEST_CASE("mesh: a forest joins what flooding joins, whatever the order and the threads", "[mesh][law]") {
  std::mt19937 random(11);
  for (int run = 0; run < 60; ++run) {
    const auto count = static_cast<std::uint32_t>(run < 50 ? 1 + random() % 200 : 150'000);
    const double density = 0.2 + 0.1 * (run % 10);
    const bool with_conflicts = run % 3 == 0;
    std::vector<bool> hidden(count);  // ways that bonds follow, so that shells do have an orientation
    for (std::uint32_t t = 0; t < count; ++t) hidden[t] = random() % 2 == 0;
    std::vector<Bond> bonds;
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(density * count); ++i) {
      const auto a = static_cast<std::uint32_t>(random() % count), b = static_cast<std::uint32_t>(random() % count);
      if (a != b) bonds.push_back({a, b, (hidden[a] == hidden[b]) != (with_conflicts && random() % 50 == 0)});
    }
    const auto expected = flooded(count, bonds);
    for (const unsigned threads : {1U, 2U, 8U}) {
      const tasks::ThreadLimit limit(threads);
      ShellForest forest(count);
      std::vector<std::uint8_t> fits(bonds.size());
      tasks::for_each_index(bonds.size(),
                            [&](std::size_t i) { fits[i] = forest.unite(bonds[i].a, bonds[i].b, bonds[i].agree); });
      REQUIRE(forest.number_shells() == expected.shells);
      std::set<std::uint32_t> one_sided;
      for (std::size_t i = 0; i < bonds.size(); ++i)
        if (!fits[i]) one_sided.insert(forest.shell(bonds[i].a));
      CHECK(one_sided == expected.one_sided);
      std::size_t different = 0;
      for (std::uint32_t t = 0; t < count; ++t) {
        different += forest.shell(t) != expected.shell[t];
        if (!one_sided.contains(expected.shell[t])) different += forest.turned(t) != expected.turned[t];
      }
      CHECK(different == 0);
    }
  }
}
