// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/edges.h"

#include "tasks/blocks.h"
#include "tasks/tasks.h"

#include <algorithm>
#include <utility>

namespace weft::mesh {
namespace {

constexpr std::uint32_t next_corner[3] = {1, 2, 0}, last_corner[3] = {2, 0, 1};

void sort_by_upper(std::span<Edges::Side> bucket) {
  constexpr std::size_t few = 24;
  if (bucket.size() > few) {
    std::sort(bucket.begin(), bucket.end(), [](const Edges::Side& a, const Edges::Side& b) {
      return a.upper != b.upper ? a.upper < b.upper : a.triangle_and_way < b.triangle_and_way;
    });
    return;
  }
  for (std::size_t i = 1; i < bucket.size(); ++i) {
    const Edges::Side side = bucket[i];
    std::size_t at = i;
    for (; at > 0 && bucket[at - 1].upper > side.upper; --at) bucket[at] = bucket[at - 1];
    bucket[at] = side;
  }
}

/// What is near in the mesh stays in the cache; and so few ranges that each has its page at hand while they are filled.
int range_bits_for(std::size_t vertices) {
  constexpr int near = 12, most = 10;
  int bits = near;
  while (vertices >> bits >> most) ++bits;
  return bits;
}

}  // namespace

// A counting sort by range, stable, in blocks of triangles: each block counts its sides, then all know their places.
Edges::Edges(const Mesh& mesh) : mesh_(mesh), range_bits_(range_bits_for(mesh.vertices.size())) {
  const std::size_t ranges = (mesh.vertices.size() >> range_bits_) + 1;
  const tasks::Blocks blocks(mesh.triangles.size(), 1 << 15, 256);
  std::vector<std::uint32_t> places(blocks.count() * ranges, 0);
  const auto for_each_side = [&](std::size_t block, const auto& see) {
    std::uint32_t* const of_block = places.data() + block * ranges;
    for (std::size_t t = blocks.begin(block); t < blocks.end(block); ++t) {
      const Triangle& corners = mesh.triangles[t];
      for (std::uint32_t i = 0; i < 3; ++i)
        see(of_block[std::min(corners[i], corners[next_corner[i]]) >> range_bits_],
            4 * static_cast<std::uint32_t>(t) + i);
    }
  };
  tasks::for_each_index(blocks.count(), [&](std::size_t block) {
    for_each_side(block, [](std::uint32_t& count, std::uint32_t) { ++count; });
  });
  starts_.reserve(ranges + 1);
  std::uint32_t sum = 0;
  for (std::size_t range = 0; range < ranges; ++range) {
    starts_.push_back(sum);
    for (std::size_t block = 0; block < blocks.count(); ++block) {
      const std::uint32_t count = std::exchange(places[block * ranges + range], sum);
      sum += count;
    }
  }
  starts_.push_back(sum);
  sides_.resize(sum);
  tasks::for_each_index(blocks.count(), [&](std::size_t block) {
    for_each_side(block, [&](std::uint32_t& place, std::uint32_t side) { sides_[place++] = side; });
  });
}

std::vector<Edges::Side> Edges::sides(std::size_t range) const {
  const std::span unsorted(sides_.data() + starts_[range], starts_[range + 1] - starts_[range]);
  const auto first = static_cast<std::uint32_t>(range << range_bits_);
  const std::size_t vertices = std::min(std::size_t{1} << range_bits_, mesh_.vertices.size() - first);
  const auto side_of = [&](std::uint32_t side) {
    const Triangle& corners = mesh_.triangles[side >> 2];
    const std::uint32_t i = side & 3, from = corners[i], to = corners[next_corner[i]];
    return Side{std::min(from, to), std::max(from, to), corners[last_corner[i]], 2 * (side >> 2) + (from < to)};
  };
  // A counting sort by the lower vertex; each bucket is short and sorted by the upper one.
  std::vector<std::uint32_t> ends(vertices + 1, 0);
  for (const std::uint32_t side : unsorted) ++ends[side_of(side).lower - first + 1];
  for (std::size_t v = 1; v < ends.size(); ++v) ends[v] += ends[v - 1];
  std::vector<Side> sorted(unsorted.size());
  for (const std::uint32_t side : unsorted) {
    const Side entry = side_of(side);
    sorted[ends[entry.lower - first]++] = entry;
  }
  std::size_t begin = 0;
  for (std::size_t v = 0; v < vertices; ++v) {  // by now ends[v] is where the bucket of v ends
    sort_by_upper(std::span(sorted.data() + begin, ends[v] - begin));
    begin = ends[v];
  }
  return sorted;
}

}  // namespace weft::mesh
