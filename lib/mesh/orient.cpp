#include "mesh/orient.h"

#include <algorithm>

namespace weft::mesh {
namespace {

struct Shell {
  std::size_t triangles = 0, turned = 0;  ///< turned: those whose `turn` says so
  bool closed = true, one_sided = false, invert = false;
  Box3 box;
  double six_um3 = 0;  ///< signed volume, as turned but not inverted
  double facing() const { return invert ? -six_um3 : six_um3; }
};

struct Shells {
  std::vector<Shell> all;
  std::vector<std::uint32_t> of;   ///< of each triangle
  std::vector<std::uint8_t> turn;  ///< of each triangle: whether to turn it to agree with the first of its shell
};

Shells shells_of(const Mesh& mesh, const EdgeTable& edges) {
  constexpr std::uint32_t unseen = ~std::uint32_t{0};
  Shells shells{{}, std::vector(mesh.triangles.size(), unseen), std::vector<std::uint8_t>(mesh.triangles.size())};
  std::vector<std::uint32_t> stack;
  for (std::uint32_t seed = 0; seed < mesh.triangles.size(); ++seed) {
    if (shells.of[seed] != unseen) continue;
    const auto id = static_cast<std::uint32_t>(shells.all.size());
    Shell shell;
    shells.of[seed] = id;
    stack.push_back(seed);
    while (!stack.empty()) {
      const std::uint32_t triangle = stack.back();
      stack.pop_back();
      ++shell.triangles;
      shell.turned += shells.turn[triangle];
      for (std::uint32_t i = 0; i < 3; ++i) {
        const EdgeTable::Neighbour neighbour = edges.neighbours[3 * triangle + i];
        if (neighbour.side == EdgeTable::none) shell.closed = false;
        if (neighbour.side >= EdgeTable::several) continue;
        const std::uint32_t other = neighbour.side / 3;
        const bool turn = shells.turn[triangle] == neighbour.agrees;
        if (shells.of[other] == unseen) {
          shells.of[other] = id;
          shells.turn[other] = turn;
          stack.push_back(other);
        } else if (shells.turn[other] != turn) {
          shell.one_sided = true;
        }
      }
    }
    shells.all.push_back(shell);
  }
  return shells;
}

/// At an edge of several triangles a shell is closed when as many of its sides run up the edge as down.
void find_open_at_crowded_edges(const Mesh& mesh, const EdgeTable& edges, Shells& shells) {
  std::vector<std::pair<std::uint32_t, int>> ways;  // shell, +1 or -1
  std::size_t begin = 0;
  for (const std::size_t end : edges.crowded_ends) {
    ways.clear();
    for (; begin < end; ++begin) {
      const std::uint32_t side = edges.crowded_sides[begin], triangle = side / 3;
      const Triangle& t = mesh.triangles[triangle];
      const bool upward = t[side % 3] < t[(side + 1) % 3];
      ways.emplace_back(shells.of[triangle], upward != (shells.turn[triangle] != 0) ? 1 : -1);
    }
    std::sort(ways.begin(), ways.end());
    for (std::size_t i = 0, sum_end = 0; i < ways.size(); i = sum_end) {
      int sum = 0;
      for (sum_end = i; sum_end < ways.size() && ways[sum_end].first == ways[i].first; ++sum_end)
        sum += ways[sum_end].second;
      if (sum != 0) shells.all[ways[i].first].closed = false;
    }
  }
}

void measure(const Mesh& mesh, Shells& shells) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (const std::uint32_t corner : mesh.triangles[i]) shells.all[shells.of[i]].box.add(mesh.vertices[corner]);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    Shell& shell = shells.all[shells.of[i]];
    const auto& [a, b, c] = mesh.triangles[i];
    const Point3 size = shell.box.size(), low = shell.box.min;  // seen from its middle an open shell has a volume too
    const Point3 middle{low.x + size.x / 2, low.y + size.y / 2, low.z + size.z / 2};
    const double six = six_volumes_um3(middle, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
    shell.six_um3 += shells.turn[i] && !shell.one_sided ? -six : six;
  }
}

/// Rule 4 of the header.
void turn_parts_inside_out(std::vector<Shell>& shells) {
  constexpr std::size_t most = 1000;  // of the outward shells, the largest: keeps a cloud of bubbles linear
  std::vector<Box3> outward;
  for (const Shell& shell : shells)
    if (shell.facing() > 0) outward.push_back(shell.box);
  const bool all_known = outward.size() <= most;
  const auto larger = [](const Box3& a, const Box3& b) {
    return std::int64_t{a.size().x} + a.size().y + a.size().z > std::int64_t{b.size().x} + b.size().y + b.size().z;
  };
  std::stable_sort(outward.begin(), outward.end(), larger);
  outward.resize(std::min(outward.size(), most));
  for (Shell& shell : shells) {
    if (!shell.closed || shell.one_sided || shell.facing() >= 0) continue;
    const bool is_void =
        std::any_of(outward.begin(), outward.end(), [&](const Box3& b) { return b.contains(shell.box); });
    if (!is_void && all_known) shell.invert = !shell.invert;
  }
}

void decide(std::vector<Shell>& shells) {
  double six_um3 = 0;
  for (Shell& shell : shells) {
    if (shell.one_sided) continue;
    shell.invert = 2 * shell.turned > shell.triangles;
    const std::size_t minority = std::min(shell.turned, shell.triangles - shell.turned);
    if (shell.closed && 4 * minority > shell.triangles) shell.invert = shell.six_um3 < 0;
    six_um3 += shell.facing();
  }
  if (six_um3 < 0)
    for (Shell& shell : shells) shell.invert = !shell.one_sided && !shell.invert;
  turn_parts_inside_out(shells);
}

}  // namespace

void orient(Mesh& mesh, const EdgeTable& edges, Repairs& repairs) {
  Shells shells = shells_of(mesh, edges);
  find_open_at_crowded_edges(mesh, edges, shells);
  measure(mesh, shells);
  decide(shells.all);
  repairs.shells = shells.all.size();
  for (const Shell& shell : shells.all) {
    repairs.one_sided_shells += shell.one_sided;
    if (shell.one_sided) continue;
    if (shell.turned == 0 && shell.invert)
      ++repairs.inverted_shells;
    else
      repairs.flipped += shell.invert ? shell.triangles - shell.turned : shell.turned;
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Shell& shell = shells.all[shells.of[i]];
    if (!shell.one_sided && (shells.turn[i] != 0) != shell.invert)
      std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
  }
}

}  // namespace weft::mesh
