// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/tell_marks.h"

#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "plate/silhouette.h"

#include <algorithm>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

bool is_of(const mesh::Mark& mark, mesh::MarkKind kind) {
  return mark.kind == kind && !mark.mesh.triangles.empty();
}

/// Nothing narrower than a line is missed.
Regions beyond(const Mesh& mesh, const Regions& room, Um line) {
  return geometry::opening(geometry::subtract(plate::silhouette_of({&mesh, 1}), room), line / 2);
}

}  // namespace

void tell_marks(const Settings& settings, const Object& object, const std::vector<slice::Cut>& cuts,
                const SupportOf& support, Notices& notices) {
  const auto& s = settings.support;
  const auto has = [&](mesh::MarkKind kind) {
    return std::any_of(object.marks.begin(), object.marks.end(), [&](const auto& mark) { return is_of(mark, kind); });
  };
  if (s.support_enable && !s.support_auto && s.support_enforce_layers == 0 && !has(mesh::MarkKind::support_enforcer) &&
      !has(mesh::MarkKind::support))
    notices.push_back({"support_unasked", fmt::format("{}: support_auto is off and there is no enforcer, so nothing is "
                                                      "supported",
                                                      object.name)});
  const Um top = cuts.empty() ? 0 : cuts.back().layer.z;
  const Um line = length_or(s.support_line_width, settings.machine.nozzle_diameter, settings.machine.nozzle_diameter);
  for (const auto& mark : object.marks) {
    if (!is_of(mark, mesh::MarkKind::support)) continue;
    const auto told = [&](std::string what) {
      notices.push_back({"support_mesh_cut", fmt::format("{}: {}", mark.name.empty() ? object.name : mark.name, what)});
    };
    if (const Um above = box_of(mark.mesh).max.z - top; above > settings.layers.layer_height / 2)
      told(fmt::format(
          "what is higher than {} mm lies above '{}', whose support ends below it, and is left out; name the "
          "mesh after the model that it is to hold",
          to_mm(top), object.name));
    const Regions outside = support.bounded ? beyond(mark.mesh, support.room, line) : Regions{};
    if (outside.empty()) continue;
    const Point at = outside.front().outer.front() + object.copies.front();
    told(
        fmt::format("{:.1f} mm² of it, first at ({:.3f}, {:.3f}), lies beyond the print surface, in a no-go area or "
                    "at another object, and is left out",
                    area_mm2(outside), to_mm(at.x), to_mm(at.y)));
  }
}

}  // namespace weft::pipeline
