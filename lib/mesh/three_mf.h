// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/notice.h"
#include "core/rgb.h"
#include "mesh/archive.h"
#include "mesh/mesh.h"
#include "mesh/three_mf_paint.h"
#include "mesh/three_mf_parts.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

/// The model parts of a 3MF as they are written: resources and build, nothing multiplied out yet.
/// Source: 3MF Core Specification 1.3; Production Extension 1.1 (objects in parts of their own).
namespace weft::mesh {

/// A reference to an object: the part it is in and its id.
using ObjectKey = std::pair<std::string, std::uint32_t>;

struct Reference {
  ObjectKey object;
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  std::string where;  ///< part and line, for messages
};

/// A triangle that has a colour of its own.
struct ColouredTriangle {
  std::uint32_t triangle = 0;
  Rgb colour;
};

struct Resource {
  std::string name, type;
  std::vector<Eigen::Vector3d> vertices;  ///< in the file's unit
  std::vector<Triangle> triangles;        ///< indices are checked
  std::vector<Reference> components;
  std::vector<PaintedFacet> painted;  ///< for support, in the file's unit
  std::vector<TintedFacet> tinted;    ///< for extruders, likewise
  std::optional<Rgb> colour{};        ///< of all triangles that have none of their own
  std::vector<ColouredTriangle> coloured{};
  std::vector<ForeignSetting> settings;  ///< Cura's: metadata whose name begins with `cura:`
};

struct ThreeMf {
  std::string unit = "millimeter";
  double mm_per_unit = 1;
  std::map<ObjectKey, Resource> objects;
  std::vector<Reference> items;
  std::string root;    ///< the part that the build is in
  ThreeMfParts parts;  ///< which volumes are no parts
  Notices notices;
};

/// Reads the root model and the parts its components name. Throws: Error::Kind::model.
ThreeMf parse_3mf(Archive& archive, const std::string& path);

}  // namespace weft::mesh
