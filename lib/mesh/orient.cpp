// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/orient.h"

#include "mesh/box_tree.h"
#include "mesh/cuts.h"
#include "tasks/blocks.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <utility>

namespace weft::mesh {
namespace {

struct Shell {
  std::size_t triangles = 0, turned = 0, open_edges = 0;
  bool closed = true, one_sided = false, invert = false;
  Box3 box;
  double six_um3 = 0;  ///< signed volume, as turned but not inverted
  double facing() const { return invert ? -six_um3 : six_um3; }
  /// A triangle alone, or a strip, has no inside: what it and the middle of its box enclose says nothing.
  bool scrap() const { return open_edges >= triangles; }
};

/// What the triangles of each shell give together: add(part, t) for the triangles of a block, merge(shell, part) block
/// by block, so that what is summed up is the same on any number of threads.
template <class Part, class Add, class Merge>
void sum_by_shell(const ShellForest& shells, std::size_t triangles, Add add, Merge merge) {
  struct Run {
    std::uint32_t shell;
    Part part{};
  };
  constexpr std::size_t block_triangles = 1 << 14;
  const tasks::Blocks blocks(triangles, block_triangles, triangles);
  const auto sum = [&](std::size_t block) {
    std::vector<Run> runs;  // of neighbours in the file, most of which are of one shell
    for (std::size_t t = blocks.begin(block); t < blocks.end(block);) {
      Run run{shells.shell(t)};
      for (; t < blocks.end(block) && shells.shell(t) == run.shell; ++t) add(run.part, t);
      runs.push_back(run);
    }
    return runs;
  };
  tasks::parallel_in_order(blocks.count(), sum, [&](std::size_t, const std::vector<Run>& runs) {
    for (const Run& run : runs) merge(run.shell, run.part);
  });
}

std::vector<Shell> shells_of(const Mesh& mesh, Adjacency& adjacency) {
  std::vector<Shell> all(adjacency.shells.number_shells());
  const ShellForest& shells = adjacency.shells;
  for (const std::uint32_t t : adjacency.open) {
    Shell& shell = all[shells.shell(t)];
    shell.closed = false;
    ++shell.open_edges;
  }
  for (const std::uint32_t t : adjacency.one_sided) all[shells.shell(t)].one_sided = true;
  struct Part {
    std::size_t triangles = 0, turned = 0;
    Box3 box;
  };
  sum_by_shell<Part>(
      shells, mesh.triangles.size(),
      [&](Part& part, std::size_t t) {
        ++part.triangles;
        part.turned += shells.turned(t);
        for (const std::uint32_t corner : mesh.triangles[t]) part.box.add(mesh.vertices[corner]);
      },
      [&](std::uint32_t shell, const Part& part) {
        all[shell].triangles += part.triangles;
        all[shell].turned += part.turned;
        all[shell].box.add(part.box);
      });
  return all;
}

/// At an edge of several triangles a shell is closed when as many of its sides run up the edge as down.
void find_open_at_crowded_edges(const Adjacency& adjacency, std::vector<Shell>& shells) {
  std::vector<std::pair<std::uint32_t, int>> ways;  // shell, +1 or -1
  std::size_t begin = 0;
  for (const std::size_t end : adjacency.crowded_ends) {
    ways.clear();
    for (; begin < end; ++begin) {
      const Edges::Side side = adjacency.crowded[begin];
      const bool turned = adjacency.shells.turned(side.triangle());
      ways.emplace_back(adjacency.shells.shell(side.triangle()), side.upward() != turned ? 1 : -1);
    }
    std::sort(ways.begin(), ways.end());
    for (std::size_t i = 0, sum_end = 0; i < ways.size(); i = sum_end) {
      int sum = 0;
      for (sum_end = i; sum_end < ways.size() && ways[sum_end].first == ways[i].first; ++sum_end)
        sum += ways[sum_end].second;
      if (sum != 0) shells[ways[i].first].closed = false;
    }
  }
}

void measure(const Mesh& mesh, const ShellForest& forest, std::vector<Shell>& shells) {
  sum_by_shell<double>(
      forest, mesh.triangles.size(),
      [&](double& six_um3, std::size_t t) {
        const Shell& shell = shells[forest.shell(t)];
        const auto& [a, b, c] = mesh.triangles[t];
        const Point3 size = shell.box.size(), low = shell.box.min;  // seen from its middle an open one has a volume too
        const Point3 middle{low.x + size.x / 2, low.y + size.y / 2, low.z + size.z / 2};
        const double six = six_volumes_um3(middle, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
        six_um3 += forest.turned(t) && !shell.one_sided ? -six : six;
      },
      [&](std::uint32_t shell, double six_um3) { shells[shell].six_um3 += six_um3; });
}

/// The triangles of each shell, one behind the other.
struct TrianglesByShell {
  std::vector<std::size_t> first;
  std::vector<std::uint32_t> triangles;

  TrianglesByShell(const ShellForest& forest, std::size_t count, std::size_t shells)
      : first(shells + 1), triangles(count) {
    for (std::size_t t = 0; t < count; ++t) ++first[forest.shell(t) + 1];
    for (std::size_t s = 0; s < shells; ++s) first[s + 1] += first[s];
    auto next = first;
    for (std::uint32_t t = 0; t < count; ++t) triangles[next[forest.shell(t)]++] = t;
  }
  void add(std::size_t shell, std::vector<std::uint32_t>& to) const {
    to.insert(to.end(), triangles.begin() + static_cast<std::ptrdiff_t>(first[shell]),
              triangles.begin() + static_cast<std::ptrdiff_t>(first[shell + 1]));
  }
};

bool apart(const Box3& a, const Box3& b) {
  return a.max.x <= b.min.x || b.max.x <= a.min.x || a.max.y <= b.min.y || b.max.y <= a.min.y || a.max.z <= b.min.z ||
         b.max.z <= a.min.z;
}

/// Whether a shell cuts through one that faces outward.
bool cuts(const Mesh& mesh, const TrianglesByShell& triangles, const std::vector<Shell>& shells, std::size_t shell) {
  std::vector<std::uint32_t> own, others;
  for (std::size_t s = 0; s < shells.size(); ++s)
    if (shells[s].facing() > 0 && !apart(shells[s].box, shells[shell].box)) triangles.add(s, others);
  if (others.empty()) return false;
  triangles.add(shell, own);
  return cut_each_other(mesh, own, others);
}

/// Rule 4 of the header.
void turn_parts_inside_out(Mesh& mesh, const ShellForest& forest, std::vector<Shell>& shells) {
  const auto faces_inward = [](const Shell& s) { return s.closed && !s.one_sided && s.facing() < 0; };
  if (std::none_of(shells.begin(), shells.end(), faces_inward)) return;
  std::vector<Box3> outward;
  for (const Shell& shell : shells)
    if (shell.facing() > 0) outward.push_back(shell.box);
  const BoxTree tree(std::move(outward));
  const TrianglesByShell triangles(forest, mesh.triangles.size(), shells.size());
  std::vector<std::uint8_t> hole(shells.size());  // looked at while all face as the file says
  for (std::size_t s = 0; s < shells.size(); ++s) {
    if (!faces_inward(shells[s])) continue;
    hole[s] = tree.any_contains(shells[s].box);
    if (hole[s] || !cuts(mesh, triangles, shells, s)) continue;
    hole[s] = mesh.cut_through = true;
  }
  for (std::size_t s = 0; s < shells.size(); ++s)
    if (faces_inward(shells[s]) && !hole[s]) shells[s].invert = !shells[s].invert;
}

void decide(Mesh& mesh, const ShellForest& forest, std::vector<Shell>& shells) {
  double six_um3 = 0;
  for (Shell& shell : shells) {
    if (shell.one_sided) continue;
    shell.invert = 2 * shell.turned > shell.triangles;
    const std::size_t minority = std::min(shell.turned, shell.triangles - shell.turned);
    if (shell.closed && 4 * minority > shell.triangles) shell.invert = shell.six_um3 < 0;
    if (!shell.scrap()) six_um3 += shell.facing();
  }
  if (six_um3 < 0)
    for (Shell& shell : shells) shell.invert = !shell.one_sided && !shell.invert;
  turn_parts_inside_out(mesh, forest, shells);
}

}  // namespace

void orient(Mesh& mesh, Adjacency adjacency, Repairs& repairs) {
  std::vector<Shell> shells = shells_of(mesh, adjacency);
  find_open_at_crowded_edges(adjacency, shells);
  measure(mesh, adjacency.shells, shells);
  decide(mesh, adjacency.shells, shells);
  repairs.shells = shells.size();
  bool any = false;
  for (const Shell& shell : shells) {
    repairs.one_sided_shells += shell.one_sided;
    if (shell.one_sided) continue;
    any |= shell.turned > 0 || shell.invert;
    if (shell.turned == 0 && shell.invert)
      ++repairs.inverted_shells;
    else
      repairs.flipped += shell.invert ? shell.triangles - shell.turned : shell.turned;
  }
  if (!any) return;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Shell& shell = shells[adjacency.shells.shell(i)];
    if (!shell.one_sided && adjacency.shells.turned(i) != shell.invert)
      std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
  }
}

}  // namespace weft::mesh
