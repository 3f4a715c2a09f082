// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/convex_hull.h"
#include "core/error.h"
#include "mesh/fits.h"
#include "mesh/placement.h"

#include <algorithm>

#include <fmt/format.h>

namespace weft::mesh {
namespace {

/// How far the copy at `at` reaches beyond the surface, fractional microns, and where.
struct Overhang {
  double um = 0;
  Point at;
};

Overhang overhang_of(const PlacedModel& model, Point at, const Ring& surface) {
  Overhang worst;
  for (const Point corner : model.hull)
    if (const double um = outside_by(corner + at, surface); um > worst.um) worst = {um, corner + at};
  return worst;
}

/// Whether an edge of the concave surface goes through the footprint although all corners are on it.
bool is_cut(const PlacedModel& model, Point at, const Ring& surface, Um tolerance) {
  for (const Mesh& mesh : model.objects)
    for (const Triangle& triangle : mesh.triangles) {
      Ring shape{flat(mesh.vertices[triangle[0]]) + at, flat(mesh.vertices[triangle[1]]) + at,
                 flat(mesh.vertices[triangle[2]]) + at};
      if (orient(shape[0], shape[1], shape[2]) < 0) std::swap(shape[1], shape[2]);
      const Box box = box_of(shape);
      for (std::size_t i = 0; i < surface.size(); ++i) {
        const Point a = surface[i], b = surface[(i + 1) % surface.size()];
        if (!box.overlaps(box_of(Ring{a, b}))) continue;
        if (cuts(a, b, shape)) return true;
      }
      for (const Point p : shape)
        if (outside_by(p, surface) > tolerance) return true;
    }
  return false;
}

std::string size_text(Point3 size) {
  return fmt::format("{:.2f} × {:.2f} × {:.2f} mm", to_mm(size.x), to_mm(size.y), to_mm(size.z));
}

void check_copy(const PlacedModel& model, Point at, const Plate& plate, Um tolerance) {
  const Box bed = box_of(plate.surface);
  const Point3 there{bed.size().x, bed.size().y, plate.height}, has = model.box.size();
  const auto refuse = [&](const std::string& what, const std::string& hint) {
    throw Error(
        Error::Kind::audit,
        fmt::format("does not fit: it is {}, the build volume is {}; {}", size_text(has), size_text(there), what),
        model.path, hint);
  };
  if (has.z > plate.height + tolerance)
    refuse(fmt::format("it is {:.2f} mm too high", to_mm(has.z - plate.height)), "scale or cut it, or lay it down");
  const char* const hint = has.x > there.x + tolerance || has.y > there.y + tolerance
                               ? "scale or cut it, or turn it with --rotate"
                               : "place it with --center, or print fewer copies";
  if (const Overhang worst = overhang_of(model, at, plate.surface); worst.um > tolerance)
    // Of a concave surface the hull says nothing but where the corners of the model are, which is enough here.
    refuse(fmt::format("at ({:.2f}, {:.2f}) it is {:.2f} mm outside the print surface", to_mm(worst.at.x),
                       to_mm(worst.at.y), worst.um / 1000),
           hint);
  if (!is_convex(plate.surface) && is_cut(model, at, plate.surface, tolerance))
    refuse("it reaches over a notch of the print surface", hint);
}

}  // namespace

void check_fits(std::span<const PlacedModel> models, const Plate& plate, Um tolerance) {
  for (const PlacedModel& model : models)
    for (const Point at : model.instances) check_copy(model, at, plate, tolerance);
}

}  // namespace weft::mesh
