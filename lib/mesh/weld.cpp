#include "mesh/weld.h"

#include <bit>

namespace weft::mesh {

Weld::Weld(std::size_t expected) {
  vertices_.reserve(expected);
  resize(static_cast<unsigned>(std::bit_width(2 * expected | 15)));
}

std::uint32_t Weld::insert(Point3 p, std::size_t slot) {
  const auto index = static_cast<std::uint32_t>(vertices_.size());
  slots_[slot] = index;
  vertices_.push_back(p);
  if (2 * vertices_.size() > slots_.size()) resize(static_cast<unsigned>(std::bit_width(slots_.size())));
  return index;
}

void Weld::resize(unsigned bits) {
  slots_.assign(std::size_t{1} << bits, vacant);
  mask_ = slots_.size() - 1;
  shift_ = 64 - bits;
  for (std::uint32_t index = 0; index < vertices_.size(); ++index) {
    std::size_t slot = hash(vertices_[index]) >> shift_;
    while (slots_[slot] != vacant) slot = (slot + 1) & mask_;
    slots_[slot] = index;
  }
}

std::size_t drop_degenerate(Mesh& mesh) {
  return std::erase_if(mesh.triangles, [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
}

void drop_unused_vertices(Mesh& mesh) {
  std::vector<std::uint32_t> renumbered(mesh.vertices.size(), 0);
  for (const Triangle& triangle : mesh.triangles)
    for (const std::uint32_t corner : triangle) renumbered[corner] = 1;
  std::uint32_t used = 0;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (!renumbered[i]) continue;
    mesh.vertices[used] = mesh.vertices[i];
    renumbered[i] = used++;
  }
  if (used == mesh.vertices.size()) return;
  mesh.vertices.resize(used);
  for (Triangle& triangle : mesh.triangles)
    for (std::uint32_t& corner : triangle) corner = renumbered[corner];
}

}  // namespace weft::mesh
