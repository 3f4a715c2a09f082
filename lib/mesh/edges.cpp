#include "mesh/edges.h"

#include <algorithm>
#include <span>

namespace weft::mesh {
namespace {

constexpr std::uint32_t next_corner[3] = {1, 2, 0};

/// A side in the bucket of its lower vertex.
struct Entry {
  std::uint32_t upper;         ///< its other vertex
  std::uint32_t side_and_way;  ///< 2 * side + whether it leaves from the lower vertex
  std::uint32_t side() const { return side_and_way >> 1; }
  bool upward() const { return side_and_way & 1; }
};

void sort_by_upper(std::span<Entry> bucket) {
  constexpr std::size_t few = 24;
  if (bucket.size() > few) {
    std::sort(bucket.begin(), bucket.end(), [](Entry a, Entry b) {
      return a.upper != b.upper ? a.upper < b.upper : a.side_and_way < b.side_and_way;
    });
    return;
  }
  for (std::size_t i = 1; i < bucket.size(); ++i) {
    const Entry entry = bucket[i];
    std::size_t at = i;
    for (; at > 0 && bucket[at - 1].upper > entry.upper; --at) bucket[at] = bucket[at - 1];
    bucket[at] = entry;
  }
}

void link(std::span<const Entry> edge, EdgeTable& table) {
  if (edge.size() == 2) {
    const std::uint32_t agrees = edge[0].upward() != edge[1].upward();
    table.neighbours[edge[0].side()] = {edge[1].side() & EdgeTable::none, agrees & 1};
    table.neighbours[edge[1].side()] = {edge[0].side() & EdgeTable::none, agrees & 1};
  } else if (edge.size() == 1) {
    table.neighbours[edge[0].side()] = {EdgeTable::none, 0};
    ++table.open_edges;
  } else {
    for (const Entry& entry : edge) {
      table.neighbours[entry.side()] = {EdgeTable::several, 0};
      table.crowded_sides.push_back(entry.side());
    }
    table.crowded_ends.push_back(table.crowded_sides.size());
  }
}

}  // namespace

EdgeTable edges_of(const Mesh& mesh) {
  // A counting sort of the sides by their lower vertex; each bucket is short and sorted by the upper one.
  std::vector<std::uint32_t> ends(mesh.vertices.size() + 1, 0);
  for (const Triangle& t : mesh.triangles)
    for (std::uint32_t i = 0; i < 3; ++i) ++ends[std::min(t[i], t[next_corner[i]]) + 1];
  for (std::size_t v = 1; v < ends.size(); ++v) ends[v] += ends[v - 1];
  std::vector<Entry> entries(3 * mesh.triangles.size());
  std::uint32_t side = 0;
  for (const Triangle& t : mesh.triangles)
    for (std::uint32_t i = 0; i < 3; ++i, ++side) {
      const std::uint32_t from = t[i], to = t[next_corner[i]];
      entries[ends[std::min(from, to)]++] = {std::max(from, to), 2 * side + (from < to)};
    }

  EdgeTable table;
  table.neighbours.resize(entries.size());
  std::size_t begin = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {  // by now ends[v] is where the bucket of v ends
    const std::span bucket(entries.data() + begin, ends[v] - begin);
    begin = ends[v];
    sort_by_upper(bucket);
    for (std::size_t from = 0; from < bucket.size();) {
      std::size_t to = from + 1;
      while (to < bucket.size() && bucket[to].upper == bucket[from].upper) ++to;
      link(bucket.subspan(from, to - from), table);
      from = to;
    }
  }
  return table;
}

}  // namespace weft::mesh
