// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/mesh.h"

#include "core/convex_hull.h"
#include "tasks/blocks.h"
#include "tasks/parallel.h"

namespace weft {
namespace {

/// make(begin, end) for each block of neighbours of so many, side by side; returned in order.
template <class Make>
auto by_blocks(std::size_t length, Make make) {
  constexpr std::size_t worth_a_task = 1 << 15;
  const tasks::Blocks blocks(length, worth_a_task, length);
  return tasks::parallel_map(blocks.count(), [&](std::size_t i) { return make(blocks.begin(i), blocks.end(i)); });
}

}  // namespace

Box3 box_of(const Mesh& mesh) {
  const auto boxes = by_blocks(mesh.vertices.size(), [&](std::size_t begin, std::size_t end) {
    Box3 box;
    for (std::size_t i = begin; i < end; ++i) box.add(mesh.vertices[i]);
    return box;
  });
  Box3 all;
  for (const Box3& box : boxes) all.add(box);
  return all;
}

Ring footprint_of(const Mesh& mesh) {
  const auto outermost = by_blocks(mesh.vertices.size(), [&](std::size_t begin, std::size_t end) {
    Outermost of_block;
    for (std::size_t i = begin; i < end; ++i) of_block.add(flat(mesh.vertices[i]));
    return of_block;
  });
  Outermost of_all;
  for (const Outermost& of_block : outermost) of_all.add(of_block);
  const Ring octagon = of_all.octagon();
  const auto hulls = by_blocks(mesh.vertices.size(), [&](std::size_t begin, std::size_t end) {
    std::vector<Point> points;
    for (std::size_t i = begin; i < end; ++i)
      if (const Point p = flat(mesh.vertices[i]); !strictly_inside(p, octagon)) points.push_back(p);
    return convex_hull(std::move(points));
  });
  std::vector<Point> corners;
  for (const Ring& hull : hulls) corners.insert(corners.end(), hull.begin(), hull.end());
  return convex_hull(std::move(corners));
}

double volume_mm3(const Mesh& mesh) {
  const Box3 box = box_of(mesh);
  if (box.empty()) return 0;
  // Seen from the middle of the box the terms are small, wherever the mesh lies.
  const Point3 size = box.size();
  const Point3 centre{box.min.x + size.x / 2, box.min.y + size.y / 2, box.min.z + size.z / 2};
  const auto sums = by_blocks(mesh.triangles.size(), [&](std::size_t begin, std::size_t end) {
    double six_um3 = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [a, b, c] = mesh.triangles[i];
      six_um3 += six_volumes_um3(centre, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
    }
    return six_um3;
  });
  double six_um3 = 0;
  for (const double sum : sums) six_um3 += sum;
  return six_um3 / 6e9;
}

}  // namespace weft
