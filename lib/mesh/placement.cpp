// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/placement.h"

#include "core/convex_hull.h"
#include "core/error.h"
#include "mesh/arrange.h"
#include "mesh/mapped.h"

#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

namespace weft::mesh {
namespace {

/// Cosine and sine, which are whole numbers when the angle is a multiple of 90°.
Eigen::Rotation2Dd::Matrix2 turn(double degrees) {
  const double quarters = degrees / 90, whole = std::round(quarters);
  if (quarters != whole) return Eigen::Rotation2Dd(degrees * std::numbers::pi / 180).toRotationMatrix();
  Eigen::Matrix2d result = Eigen::Matrix2d::Identity(), quarter;
  quarter << 0, -1, 1, 0;
  for (int i = static_cast<int>(std::fmod(std::fmod(whole, 4) + 4, 4)); i > 0; --i) result = quarter * result;
  return result;
}

PlacedModel at_origin(Loaded loaded, const PlacementOptions& options, double rotate_deg, Point3& home) {
  PlacedModel model{std::move(loaded.path), {}, {}, {}, {}, {}, {}};
  Box3 in_file;
  for (const Object& object : loaded.objects) in_file.add(box_of(object.mesh));
  const Point about = in_file.footprint().centre();
  for (Object& object : loaded.objects) {
    const auto turned_in_place = [&](Mesh mesh) {
      mesh = stretched(std::move(mesh), options.stretch_xy, options.stretch_z, {about.x, about.y, 0});
      return rotated(std::move(mesh), rotate_deg, about);
    };
    model.objects.push_back(turned_in_place(std::move(object.mesh)));
    for (Mark& mark : object.marks) mark.mesh = turned_in_place(std::move(mark.mesh));
    model.marks.push_back(std::move(object.marks));
  }
  Box3 turned;
  for (const Mesh& mesh : model.objects) turned.add(box_of(mesh));
  const Point centre = turned.footprint().centre();
  home = {centre.x, centre.y, turned.min.z};
  const Point3 by{-home.x, -home.y, -home.z};
  std::vector<Point> corners;
  for (Mesh& mesh : model.objects) {
    mesh = moved(std::move(mesh), by);
    model.box.add(box_of(mesh));
    const Ring& footprint = model.footprints.emplace_back(footprint_of(mesh));
    corners.insert(corners.end(), footprint.begin(), footprint.end());
  }
  for (auto& marks : model.marks)
    for (Mark& mark : marks) mark.mesh = moved(std::move(mark.mesh), by);
  model.hull = convex_hull(std::move(corners));
  return model;
}

/// A part that keeps its place stands on the bed there.
void check_stands(const std::string& path, Um z) {
  constexpr Um rounding = 10;  // of exporters
  if (std::abs(z) <= rounding) return;
  throw Error(Error::Kind::model,
              z > 0 ? fmt::format("stands {:.3f} mm above the bed", to_mm(z))
                    : fmt::format("reaches {:.3f} mm below the bed", to_mm(-z)),
              path, "with --keep-position its Z is that of the file; --drop puts it down");
}

}  // namespace

Mesh rotated(Mesh mesh, double degrees, Point about) {
  const Eigen::Matrix2d matrix = turn(degrees);
  if (matrix.isIdentity(0)) return mesh;
  return mapped(std::move(mesh), [&](Point3 p) {
    const Eigen::Vector2d um = matrix * Eigen::Vector2d(p.x - about.x, p.y - about.y);
    return Point3{lattice(um.x() / 1000) + about.x, lattice(um.y() / 1000) + about.y, p.z};
  });
}

Mesh stretched(Mesh mesh, double xy, double z, Point3 about) {
  if (xy == 1 && z == 1) return mesh;
  const auto um = [](Um v, Um from, double factor) { return lattice((v - from) * factor / 1000) + from; };
  return mapped(std::move(mesh), [&](Point3 p) {
    return Point3{um(p.x, about.x, xy), um(p.y, about.y, xy), um(p.z, about.z, z)};
  });
}

Mesh moved(Mesh mesh, Point3 by) {
  for (Point3& p : mesh.vertices) p = {p.x + by.x, p.y + by.y, p.z + by.z};
  return mesh;
}

std::vector<PlacedModel> place(std::vector<Loaded> models, const PlacementOptions& options, const Plate& plate) {
  if (options.keep_position && options.copies > 1)
    throw Error(Error::Kind::usage, "copies of one position would lie in each other", "--keep-position",
                "leave out --copies or --keep-position");
  const auto own = [&](std::size_t i) { return options.of_model.empty() ? PlacementOfModel{} : options.of_model[i]; };
  std::vector<PlacedModel> placed;
  std::vector<Point3> homes(models.size());
  for (std::size_t i = 0; i < models.size(); ++i)
    placed.push_back(at_origin(std::move(models[i]), options, options.rotate_deg + own(i).rotate_deg, homes[i]));
  Plate free = plate;  // without what stands where it is told to
  for (std::size_t i = 0; i < placed.size(); ++i) {
    if (const auto at = own(i).at) {
      placed[i].instances = {*at};
      const Box box = placed[i].box.footprint().grown(options.spacing);
      free.keep_out.push_back(
          {box.min + *at, Point{box.max.x, box.min.y} + *at, box.max + *at, Point{box.min.x, box.max.y} + *at});
    } else if (options.keep_position) {
      if (own(i).copies > 1)
        throw Error(Error::Kind::usage, "copies of one position would lie in each other", "--keep-position",
                    "leave out --copies or --keep-position");
      if (!options.drop) check_stands(placed[i].path, homes[i].z);
      placed[i].instances = {{homes[i].x, homes[i].y}};
    }
  }
  if (options.arranger) {
    std::vector<ToPlace> wanted;
    std::vector<std::size_t> of_wanted;
    for (std::size_t i = 0; i < placed.size(); ++i) {
      if (!placed[i].instances.empty()) continue;
      wanted.push_back({&placed[i], static_cast<std::size_t>(own(i).copies > 0 ? own(i).copies : options.copies)});
      of_wanted.push_back(i);
    }
    auto places = options.arranger(wanted, free);
    for (std::size_t k = 0; k < of_wanted.size(); ++k) placed[of_wanted[k]].instances = std::move(places[k]);
    return placed;
  }
  std::vector<Item> items;
  std::vector<std::size_t> of_item;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    if (!placed[i].instances.empty()) continue;
    const int copies = own(i).copies > 0 ? own(i).copies : options.copies;
    items.insert(items.end(), static_cast<std::size_t>(copies), {placed[i].box.footprint().size(), &placed[i].hull});
    of_item.resize(items.size(), i);
  }
  if (items.empty()) return placed;
  const Arrangement arrangement = arrange(items, free, options.center, options.spacing);
  for (std::size_t i = 0; i < items.size(); ++i) placed[of_item[i]].instances.push_back(arrangement.at[i]);
  return placed;
}

}  // namespace weft::mesh
