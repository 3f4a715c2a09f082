// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/weld.h"

#include <algorithm>
#include <bit>

namespace weft::mesh {

Weld::Weld(std::size_t expected) {
  vertices_.reserve(expected);
  resize(static_cast<unsigned>(std::bit_width(2 * expected | 15)));
}

std::vector<std::uint32_t> Weld::indices(std::span<const Point3> points) {
  constexpr std::size_t ahead = 24;  // memory answers in the time that so many points take
  std::vector<std::uint32_t> out;
  out.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i + ahead < points.size()) __builtin_prefetch(&slots_[hash(points[i + ahead]) >> shift_]);
    out.push_back(index(points[i]));
  }
  return out;
}

void Weld::clear() {
  vertices_.clear();
  std::fill(slots_.begin(), slots_.end(), vacant);
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
