// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "mesh/archive.h"
#include "mesh/mark.h"
#include "mesh/read.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// What slicers say beside the model of a 3MF: which volumes objects are made of, and what holds for them.
/// Sources: the files that PrusaSlicer 2.5 … 2.9, OrcaSlicer and BambuStudio write.
namespace weft::mesh {

struct VolumeSaid {
  std::uint32_t first = 0, last = 0;  ///< PrusaSlicer's: triangles of the object
  std::size_t number = 0;             ///< its place among the object's volumes
  std::optional<MarkKind> kind{};     ///< none: it is a part
  std::string name{};
  std::vector<ForeignSetting> settings{};
};

struct ObjectSaid {
  std::string name{};
  std::vector<ForeignSetting> settings{};
  std::vector<VolumeSaid> volumes{};                 ///< PrusaSlicer's
  std::map<std::uint32_t, VolumeSaid> components{};  ///< OrcaSlicer's, by the id of the object that they name
};

/// A plate of a project: which instances of which objects stand on it.
struct PlateSaid {
  int number = 0;
  std::string name{};
  std::vector<std::pair<std::uint32_t, std::uint32_t>> instances{};  ///< id of an object, and of which of its copies
};

struct ThreeMfParts {
  Author author = Author::unknown;
  std::map<std::uint32_t, ObjectSaid> objects{};               ///< by id
  std::map<std::uint32_t, std::vector<RangeOfItem>> ranges{};  ///< by the object's place among objects, from 1
  std::map<std::uint32_t, std::vector<HeightAt>> heights{};    ///< likewise
  std::vector<PlateSaid> plates{};
  std::vector<std::string> unread{};         ///< parts that say something and are not read
  std::vector<std::string> unknown_kinds{};  ///< of volumes, which count as parts

  const ObjectSaid* of(std::uint32_t object) const;
  /// The volume of triangle `t` of that object; null where nothing is said of it.
  const VolumeSaid* of_triangle(std::uint32_t object, std::size_t t) const;
  const VolumeSaid* of_component(std::uint32_t object, std::uint32_t component) const;
};

/// Reads `Metadata/Slic3r_PE_model.config`, `Metadata/model_settings.config` and what they say of heights of layers,
/// where they are.
/// Throws: Error::Kind::model.
ThreeMfParts parts_of(Archive& archive, const std::string& path);

}  // namespace weft::mesh
