// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/shell_forest.h"

#include "tasks/blocks.h"
#include "tasks/tasks.h"

#include <utility>

namespace weft::mesh {
namespace {

// A word tells all there is to know, and no other memory goes by it: the order of others does not matter.
constexpr auto relaxed = std::memory_order_relaxed;

template <class F>
void for_each_triangle(std::size_t count, F f) {
  const tasks::Blocks blocks(count, 1 << 16, 256);
  tasks::for_each_index(blocks.count(), [&](std::size_t block) {
    for (std::size_t t = blocks.begin(block); t < blocks.end(block); ++t) f(static_cast<std::uint32_t>(t));
  });
}

}  // namespace

ShellForest::ShellForest(std::size_t triangles) : words_(triangles) {
  for_each_triangle(triangles, [&](std::uint32_t t) { words_[t].store(2 * t, relaxed); });
}

ShellForest::Place ShellForest::find(std::uint32_t triangle) {
  std::uint32_t turned = 0;
  for (;;) {
    std::uint32_t here = word(triangle);
    const std::uint32_t parent = here >> 1;
    if (parent == triangle) return {triangle, turned};
    const std::uint32_t above = word(parent), grandparent = above >> 1, way = (here ^ above) & 1;
    if (grandparent == parent) return {parent, turned ^ (here & 1)};
    words_[triangle].compare_exchange_weak(here, 2 * grandparent + way, relaxed);  // halves the way of the next to ask
    turned ^= way;
    triangle = grandparent;
  }
}

bool ShellForest::unite(std::uint32_t a, std::uint32_t b, bool agree) {
  for (;;) {
    Place first = find(a), other = find(b);
    const std::uint32_t disagree = first.turned ^ other.turned ^ static_cast<std::uint32_t>(!agree);
    if (first.root == other.root) return disagree == 0;
    if (first.root > other.root) std::swap(first, other);
    std::uint32_t still_root = 2 * other.root;
    if (words_[other.root].compare_exchange_strong(still_root, 2 * first.root + disagree, relaxed)) return true;
  }
}

std::size_t ShellForest::number_shells() {
  const tasks::Blocks blocks(words_.size(), 1 << 16, 256);
  std::vector<std::uint32_t> numbers(blocks.count(), 0);  // of the first shell that begins in each block
  tasks::for_each_index(blocks.count(), [&](std::size_t block) {
    for (std::size_t t = blocks.begin(block); t < blocks.end(block); ++t) {
      const Place place = find(static_cast<std::uint32_t>(t));
      words_[t].store(2 * place.root + place.turned, relaxed);
      numbers[block] += place.root == t;
    }
  });
  std::uint32_t shells = 0;
  for (std::uint32_t& number : numbers) {
    const std::uint32_t begun = std::exchange(number, shells);
    shells += begun;
  }
  constexpr std::uint32_t numbered = std::uint32_t{1} << 31;
  tasks::for_each_index(blocks.count(), [&](std::size_t block) {
    for (std::size_t t = blocks.begin(block); t < blocks.end(block); ++t)
      if (word(t) == 2 * t) words_[t].store(numbered | 2 * numbers[block]++, relaxed);
  });
  for_each_triangle(words_.size(), [&](std::uint32_t t) {
    const std::uint32_t here = word(t);
    const std::uint32_t number = here & numbered ? here & ~numbered : (word(here >> 1) & ~numbered) | (here & 1);
    words_[t].store(number, relaxed);
  });
  return shells;
}

}  // namespace weft::mesh
