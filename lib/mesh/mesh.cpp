#include "mesh/mesh.h"

namespace weft {

Box3 box_of(const Mesh& mesh) {
  Box3 box;
  for (const Point3& vertex : mesh.vertices) box.add(vertex);
  return box;
}

double volume_mm3(const Mesh& mesh) {
  const Box3 box = box_of(mesh);
  if (box.empty()) return 0;
  // Seen from the middle of the box the terms are small, wherever the mesh lies.
  const Point3 size = box.size();
  const Point3 centre{box.min.x + size.x / 2, box.min.y + size.y / 2, box.min.z + size.z / 2};
  double six_um3 = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    six_um3 += six_volumes_um3(centre, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
  return six_um3 / 6e9;
}

}  // namespace weft
