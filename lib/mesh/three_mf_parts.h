// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "mesh/archive.h"
#include "mesh/mark.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace weft::mesh {

/// What slicers say beside the model of the volumes that an object is made of: which of them are no parts.
struct ThreeMfParts {
  /// PrusaSlicer: triangles [first, last] of an object.
  struct Range {
    std::uint32_t first = 0, last = 0;
    MarkKind kind = MarkKind::modifier;
  };
  std::map<std::uint32_t, std::vector<Range>> ranges;  ///< by the object's id
  /// OrcaSlicer and BambuStudio: components of an object, by the id of the object that they name.
  std::map<std::uint32_t, std::map<std::uint32_t, MarkKind>> components;  ///< by the object's id

  /// The kind of triangle `t` of that object; null when it is part of it.
  const MarkKind* of_triangle(std::uint32_t object, std::size_t t) const;
  const MarkKind* of_component(std::uint32_t object, std::uint32_t component) const;
};

/// Reads `Metadata/Slic3r_PE_model.config` and `Metadata/model_settings.config`, where they are.
/// Throws: Error::Kind::model.
ThreeMfParts parts_of(Archive& archive, const std::string& path);

}  // namespace weft::mesh
