// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repair.h"

#include "mesh/adjacency.h"
#include "mesh/orient.h"
#include "mesh/weld.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace weft::mesh {
namespace {

/// Triangles that may have a twin: where three or more meet, or two that meet at all three edges.
std::vector<std::uint32_t> twin_suspects(const Adjacency& adjacency) {
  std::vector<std::uint32_t> suspects = adjacency.twins;
  for (const Edges::Side& side : adjacency.crowded) suspects.push_back(side.triangle());
  std::sort(suspects.begin(), suspects.end());
  suspects.erase(std::unique(suspects.begin(), suspects.end()), suspects.end());
  return suspects;
}

/// A triangle by its corners, whatever the one they begin with and whichever way they go.
struct Twin {
  Triangle sorted;
  std::uint32_t triangle;
  bool even;  ///< whether its corners go round in ascending order

  Twin(const Triangle& t, std::uint32_t index) : sorted(t), triangle(index) {
    std::sort(sorted.begin(), sorted.end());
    even = (t[0] < t[1]) + (t[1] < t[2]) + (t[2] < t[0]) == 2;
  }
};

void drop(Mesh& mesh, const std::vector<std::uint8_t>& unwanted) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (!unwanted[i]) mesh.triangles[kept++] = mesh.triangles[i];
  mesh.triangles.resize(kept);
}

/// Leaves one triangle of each set with the same corners, one of the side that has more.
/// @return the corners, sorted, of those whose sides are in balance: they may belong to a sheet
std::vector<Triangle> drop_twins(Mesh& mesh, const std::vector<std::uint32_t>& suspects, std::size_t& dropped) {
  std::vector<Twin> twins;
  for (const std::uint32_t i : suspects) twins.emplace_back(mesh.triangles[i], i);
  std::sort(twins.begin(), twins.end(), [](const Twin& a, const Twin& b) {
    return a.sorted != b.sorted ? a.sorted < b.sorted : a.triangle < b.triangle;
  });
  std::vector<std::uint8_t> unwanted(mesh.triangles.size());
  std::vector<Triangle> balanced;
  for (auto from = twins.begin(); from != twins.end();) {
    const auto to = std::find_if(from, twins.end(), [&](const Twin& t) { return t.sorted != from->sorted; });
    const auto even = std::count_if(from, to, [](const Twin&t) { return t.even; }), all = to - from;
    if (2 * even == all) balanced.push_back(from->sorted);
    const bool keep_even = 2 * even == all ? from->even : 2 * even > all;
    const auto kept = std::find_if(from, to, [&](const Twin& t) { return t.even == keep_even; });
    for (auto twin = from; twin != to; ++twin) unwanted[twin->triangle] = twin != kept;
    dropped += static_cast<std::size_t>(all - 1);
    from = to;
  }
  if (dropped > 0) drop(mesh, unwanted);
  return balanced;
}

/// Drops what is left of surfaces without thickness: pieces made of former pairs back to back that have an edge where
/// an odd number of triangles meets. Pieces without such an edge close the surface, or are one: a file in which every
/// triangle is there from both sides. Where two parts touch face to face, the faces are such a piece, and the parts
/// become one.
std::size_t drop_sheets(Mesh& mesh, const std::vector<Triangle>& balanced) {
  const std::size_t count = mesh.triangles.size();
  std::vector<std::uint8_t> in_sheet(count);
  for (std::uint32_t i = 0; i < count; ++i)
    in_sheet[i] = std::binary_search(balanced.begin(), balanced.end(), Twin(mesh.triangles[i], i).sorted);

  std::vector<std::uint32_t> piece(count);  // union-find
  std::iota(piece.begin(), piece.end(), 0u);
  const auto root = [&](std::uint32_t i) {
    while (piece[i] != i) i = piece[i] = piece[piece[i]];
    return i;
  };
  std::vector<std::uint8_t> odd(count);
  const Edges edges(mesh);
  for (std::size_t range = 0; range < edges.ranges(); ++range)
    for_each_edge(edges.sides(range), [&](std::span<const Edges::Side> edge) {
      std::optional<std::uint32_t> first;
      for (const Edges::Side& side : edge) {
        const std::uint32_t t = side.triangle();
        if (edge.size() % 2 == 1) odd[t] = true;
        if (!in_sheet[t]) continue;
        if (!first) first = t;
        piece[root(t)] = root(*first);
      }
    });
  std::vector<std::uint8_t> open_piece(count), unwanted(count);
  for (std::uint32_t i = 0; i < count; ++i)
    if (in_sheet[i] && odd[i]) open_piece[root(i)] = true;
  std::size_t dropped = 0;
  for (std::uint32_t i = 0; i < count; ++i) dropped += unwanted[i] = in_sheet[i] && open_piece[root(i)];
  if (dropped > 0) drop(mesh, unwanted);
  return dropped;
}

}  // namespace

Repaired repair(Mesh mesh) {
  Repairs repairs;
  repairs.degenerate = drop_degenerate(mesh);
  Adjacency adjacency = adjacency_of(mesh);
  if (const auto suspects = twin_suspects(adjacency); !suspects.empty()) {
    const auto balanced = drop_twins(mesh, suspects, repairs.duplicates);
    if (!balanced.empty()) repairs.sheets = drop_sheets(mesh, balanced);
    if (repairs.duplicates + repairs.sheets > 0) adjacency = adjacency_of(mesh);
  }
  repairs.open_edges = adjacency.open.size();
  repairs.non_manifold_edges = adjacency.crowded_ends.size();
  orient(mesh, std::move(adjacency), repairs);
  drop_unused_vertices(mesh);
  return {std::move(mesh), repairs};
}

Notices notices_of(const Repairs& repairs, const std::string& of) {
  Notices notices;
  const auto note = [&](std::size_t count, const char* code, const char* one, const char* many, const char* remark) {
    if (count > 0) notices.push_back({code, fmt::format("{}: {} {}{}", of, count, count == 1 ? one : many, remark)});
  };
  note(repairs.degenerate, "mesh_degenerate_triangles", "triangle", "triangles", " smaller than a micron dropped");
  note(repairs.duplicates, "mesh_duplicate_triangles", "triangle", "triangles", " dropped that another repeats");
  note(repairs.sheets, "mesh_sheets", "triangle", "triangles", " dropped of surfaces without thickness");
  note(repairs.flipped, "mesh_flipped_triangles", "triangle", "triangles",
       " turned round to agree with the neighbours");
  note(repairs.inverted_shells, "mesh_inverted_shells", "shell", "shells", " inside out turned round");
  note(repairs.open_edges, "mesh_open_edges", "edge is", "edges are",
       " open: the surface has holes, which are closed layer by layer");
  note(repairs.non_manifold_edges, "mesh_non_manifold_edges", "edge joins", "edges join", " more than two triangles");
  note(repairs.one_sided_shells, "mesh_one_sided_shells", "shell has", "shells have", " no inside and outside");
  return notices;
}

}  // namespace weft::mesh
