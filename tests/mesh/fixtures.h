// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/error.h"
#include "mesh/mesh.h"
#include "mesh/read.h"

#include <array>
#include <cstring>
#include <string>
#include <vector>

/// Small models and files, built in place.
namespace fixtures {

struct Corner {
  float x, y, z;
};
using Facet = std::array<Corner, 3>;
using Facets = std::vector<Facet>;

/// The twelve outward triangles of a box, mm.
inline Facets box(Corner low, Corner high) {
  const auto at = [&](int i) { return Corner{i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z}; };
  constexpr int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  Facets facets;
  for (const auto& q : quads) {
    facets.push_back({at(q[0]), at(q[1]), at(q[2])});
    facets.push_back({at(q[0]), at(q[2]), at(q[3])});
  }
  return facets;
}

inline Facet reversed(Facet facet) {
  return {facet[0], facet[2], facet[1]};
}

inline Facets reversed(Facets facets) {
  for (Facet& facet : facets) facet = reversed(facet);
  return facets;
}

inline Facets operator+(Facets a, const Facets& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

inline std::string binary_stl(const Facets& facets, std::string header = "") {
  header.resize(80, '\0');
  const auto count = static_cast<std::uint32_t>(facets.size());
  std::string bytes = header + std::string(reinterpret_cast<const char*>(&count), 4);
  for (const Facet& facet : facets) {
    bytes.append(12, '\0');
    bytes.append(reinterpret_cast<const char*>(facet.data()), 36);
    bytes.append(2, '\0');
  }
  return bytes;
}

inline std::string ascii_stl(const Facets& facets, const std::string& name = "part", const std::string& eol = "\n") {
  std::string text = "solid " + name + eol;
  for (const Facet& facet : facets) {
    text += "  facet normal 0 0 1" + eol + "    outer loop" + eol;
    for (const Corner& c : facet)
      text += "      vertex " + std::to_string(c.x) + " " + std::to_string(c.y) + " " + std::to_string(c.z) + eol;
    text += "    endloop" + eol + "  endfacet" + eol;
  }
  return text + "endsolid " + name + eol;
}

inline weft::mesh::Loaded read(const std::string& bytes, const weft::mesh::ReadOptions& options = {}) {
  return weft::mesh::read(bytes, "part", options);
}

/// The message of the error that reading gives; the kind must be `model`.
inline std::string refusal(const std::string& bytes) {
  try {
    read(bytes);
  } catch (const weft::Error& error) {
    return error.kind() == weft::Error::Kind::model ? error.what() : "of another kind: " + std::string(error.what());
  }
  return "read without an error";
}

}  // namespace fixtures
