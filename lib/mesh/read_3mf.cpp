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
    Body result{object(item).name, {}, {}};
    marks_.clear();
    add(item, Eigen::Affine3d(Eigen::Scaling(document_.mm_per_unit * source_.scale)), nullptr, weld,
        result.mesh.triangles);
    result.mesh.vertices = weld.take_vertices();
    for (auto& [name, mark] : marks_) {
      Mark out{name.first, name.second, {mark.weld.take_vertices(), std::move(mark.triangles)}};
      drop_degenerate(out.mesh);
      if (out.kind == MarkKind::modifier)
        document_.notices.push_back(
            {"mesh_modifier_left_out",
             fmt::format("{}: '{}' has modifiers, whose settings have no effect here", source_.path, result.name)});
      result.marks.push_back(std::move(out));
    }
    return result;
  }

  /// Corners of a triangle as they are wound in a mirrored object, too.
  static Triangle wound(const Triangle& t, bool mirrored) { return {t[0], t[mirrored ? 2 : 1], t[mirrored ? 1 : 2]}; }

  Point3 placed(const Eigen::Vector3d& mm, const Reference& reference, std::size_t vertex) const {
    for (const double c : mm)
      if (!placeable(c))
        refuse(reference,
               fmt::format("object {}, vertex {}: a coordinate {}", reference.object.second, vertex, fault_of(c)),
               "check the unit and --scale");
    return {lattice(mm.x()), lattice(mm.y()), lattice(mm.z())};
  }

  /// One mesh a kind: what it holds may overlap.
  struct MarkInWork {
    Weld weld{64};
    std::vector<Triangle> triangles;
  };
  void mark(const Resource& resource, const Eigen::Affine3d& transform, const Reference& reference, MarkKind kind,
            std::size_t t, bool mirrored) {
    auto& to = marks_[{kind, false}];
    Triangle corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto v = resource.triangles[t][i];
      corners[i] = to.weld.index(placed(transform * resource.vertices[v], reference, v));
    }
    to.triangles.push_back(wound(corners, mirrored));
  }
  void paint(const Resource& resource, const Eigen::Affine3d& transform, const Reference& reference, bool mirrored) {
    for (const auto& facet : resource.painted) {
      auto& to =
          marks_[{facet.paint == Paint::enforcer ? MarkKind::support_enforcer : MarkKind::support_blocker, true}];
      Triangle corners;
      for (std::size_t i = 0; i < 3; ++i)
        corners[i] = to.weld.index(placed(transform * facet.corners[i], reference, 0));
      to.triangles.push_back(wound(corners, mirrored));
    }
  }

  /// @param kind of all of it; null: it is part of the object
  void add(const Reference& reference, const Eigen::Affine3d& outer, const MarkKind* kind, Weld& weld,
           std::vector<Triangle>& triangles) {
    const Resource& resource = object(reference);
    const MarkKind stands = MarkKind::support;
    if (resource.type == "support" || resource.type == "solidsupport") {
      if (kind == nullptr) kind = &stands;
    } else if (resource.type != "model" && resource.type != "surface") {
      document_.notices.push_back(
          {"mesh_object_left_out", fmt::format("{}: object {} is of type '{}' and was left out", reference.where,
                                               reference.object.second, resource.type)});
      return;
    }
    const Eigen::Affine3d transform = outer * reference.transform;
    const bool mirrored = transform.linear().determinant() < 0;
    const auto& [part, number] = reference.object;
    std::vector<std::uint32_t> welded(resource.vertices.size(), unwelded);
    const auto corner = [&](std::uint32_t v) {
      if (welded[v] == unwelded) welded[v] = weld.index(placed(transform * resource.vertices[v], reference, v));
      return welded[v];
    };
    const bool all_of_it = kind == nullptr && document_.parts.ranges.count(number) == 0;
    if (all_of_it)
      for (std::uint32_t v = 0; v < welded.size(); ++v) corner(v);
    for (std::size_t t = 0; t < resource.triangles.size(); ++t) {
      const MarkKind* of = kind == nullptr && part == document_.root ? document_.parts.of_triangle(number, t) : kind;
      if (of != nullptr) {
        mark(resource, transform, reference, *of, t, mirrored);
        continue;
      }
      const auto& [a, b, c] = resource.triangles[t];
      triangles.push_back(wound({corner(a), corner(b), corner(c)}, mirrored));
    }
    if (kind == nullptr) paint(resource, transform, reference, mirrored);
    for (const Reference& component : resource.components) {
      const MarkKind* of =
          part == document_.root ? document_.parts.of_component(number, component.object.second) : nullptr;
      add(component, transform, kind != nullptr ? kind : of, weld, triangles);
    }
  }

  [[noreturn]] static void refuse(const Reference& reference, std::string what,
                                  std::string hint = "export the model again") {
    throw Error(Error::Kind::model, std::move(what), reference.where, std::move(hint));
  }

  const Source& source_;
  ThreeMf document_;
  std::map<ObjectKey, std::size_t> sizes_;
  static constexpr std::uint32_t unwelded = ~std::uint32_t{0};
  std::map<std::pair<MarkKind, bool>, MarkInWork> marks_;  ///< of the body in work; the flag: painted
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
