#include "mesh/repair.h"

namespace weft::mesh {

Repaired repair(Mesh mesh) {
  Repaired result;
  result.repairs.degenerate =
      std::erase_if(mesh.triangles, [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  result.mesh = std::move(mesh);
  return result;
}

Notices notices_of(const Repairs&, const std::string&) {
  return {};
}

}  // namespace weft::mesh
