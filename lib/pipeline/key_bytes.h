// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "mesh/mesh.h"

#include <cstdint>
#include <string>

/// Inputs of stages as bytes, for their keys: different ones have different bytes.
namespace weft::pipeline {

template <class Items>
void add_bytes(std::string& to, const Items& items) {
  const auto count = static_cast<std::uint64_t>(items.size());
  to.append(reinterpret_cast<const char*>(&count), sizeof(count));
  if (!items.empty()) to.append(reinterpret_cast<const char*>(items.data()), items.size() * sizeof(items[0]));
}

inline std::string bytes_of(const Mesh& mesh) {
  std::string out;
  add_bytes(out, mesh.vertices);
  add_bytes(out, mesh.triangles);
  return out;
}

inline std::string bytes_of(const Regions& regions) {
  std::string out;
  for (const auto& region : regions) {
    add_bytes(out, region.outer);
    for (const auto& hole : region.holes) add_bytes(out, hole);
    add_bytes(out, Ring{});
  }
  add_bytes(out, Ring{});
  return out;
}

}  // namespace weft::pipeline
