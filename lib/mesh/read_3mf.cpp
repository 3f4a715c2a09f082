// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.h"
#include "core/stop.h"
#include "mesh/formats.h"
#include "mesh/three_mf.h"
#include "mesh/weld.h"

#include <fmt/format.h>

namespace weft::mesh {
namespace {

/// Makes the bodies of the build: each item is an object with all its components, transformed.
class Build {
 public:
  Build(const Source& source, ThreeMf document) : source_(source), document_(std::move(document)) {}

  Contents contents() {
    if (document_.items.empty())
      throw Error(Error::Kind::model, "its build holds nothing to print", source_.path, "export the model again");
    Contents contents;
    if (document_.items.size() > max_items)
      refuse(document_.items[max_items],
             fmt::format("the build has {} items, of which {} could be printed", document_.items.size(), max_items),
             "print fewer at once");
    std::size_t sum = 0;
    for (const Reference& item : document_.items) {
      sum += measure(item, 0);
      if (sum > max_triangles)
        refuse(item, fmt::format("the build asks for more than {} triangles and vertices", max_triangles));
    }
    for (const Reference& item : document_.items) stop_if_asked(), contents.bodies.push_back(body(item));
    contents.unit = document_.unit;
    contents.notices = std::move(document_.notices);
    return contents;
  }

 private:
  static constexpr int deepest = 64;

  const Resource& object(const Reference& reference) const {
    const auto at = document_.objects.find(reference.object);
    if (at == document_.objects.end()) refuse(reference, fmt::format("there is no object {}", reference.object.second));
    return at->second;
  }

  /// Triangles, vertices and components of the object, multiplied out; at most max_triangles + 1 of them. What is made
  /// of copies of copies is counted once, or counting would take as long as the copies themselves.
  std::size_t measure(const Reference& reference, int depth) {
    if (depth > deepest) refuse(reference, "components within components without end");
    if (const auto known = sizes_.find(reference.object); known != sizes_.end()) return known->second;
    const Resource& resource = object(reference);
    std::size_t size = resource.triangles.size() + resource.vertices.size() + 1;
    for (const Reference& component : resource.components)
      size = std::min(size + measure(component, depth + 1), max_triangles + 1);
    return sizes_[reference.object] = size;
  }

  Body body(const Reference& item) {
    Weld weld(sizes_[item.object] / 2);
    Body result{object(item).name, {}};
    add(item, Eigen::Affine3d(Eigen::Scaling(document_.mm_per_unit * source_.scale)), weld, result.mesh.triangles);
    result.mesh.vertices = weld.take_vertices();
    return result;
  }

  void add(const Reference& reference, const Eigen::Affine3d& outer, Weld& weld, std::vector<Triangle>& triangles) {
    const Resource& resource = object(reference);
    if (resource.type != "model" && resource.type != "surface") {
      document_.notices.push_back(
          {"mesh_object_left_out", fmt::format("{}: object {} is of type '{}' and was left out", reference.where,
                                               reference.object.second, resource.type)});
      return;
    }
    const Eigen::Affine3d transform = outer * reference.transform;
    std::vector<std::uint32_t> welded;
    welded.reserve(resource.vertices.size());
    for (const Eigen::Vector3d& vertex : resource.vertices) {
      const Eigen::Vector3d mm = transform * vertex;
      for (const double c : mm)
        if (!placeable(c))
          refuse(
              reference,
              fmt::format("object {}, vertex {}: a coordinate {}", reference.object.second, welded.size(), fault_of(c)),
              "check the unit and --scale");
      welded.push_back(weld.index({lattice(mm.x()), lattice(mm.y()), lattice(mm.z())}));
    }
    const bool mirrored = transform.linear().determinant() < 0;
    for (const auto& [a, b, c] : resource.triangles)
      triangles.push_back({welded[a], welded[mirrored ? c : b], welded[mirrored ? b : c]});
    for (const Reference& component : resource.components) add(component, transform, weld, triangles);
  }

  [[noreturn]] static void refuse(const Reference& reference, std::string what,
                                  std::string hint = "export the model again") {
    throw Error(Error::Kind::model, std::move(what), reference.where, std::move(hint));
  }

  const Source& source_;
  ThreeMf document_;
  std::map<ObjectKey, std::size_t> sizes_;
};

}  // namespace

bool is_3mf(std::string_view bytes) {
  return bytes.starts_with("PK\x03\x04");
}

Contents read_3mf(const Source& source) {
  Archive archive(source.bytes, source.path);
  return Build(source, parse_3mf(archive, source.path)).contents();
}

}  // namespace weft::mesh
