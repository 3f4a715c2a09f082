// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/placement.h"

#include "core/convex_hull.h"
#include "core/error.h"
#include "mesh/arrange.h"
#include "mesh/holes_below.h"
#include "mesh/mapped.h"

#include <algorithm>
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

/// Moves the model so that the middle of its box is x = y = 0 and its lowest point z = 0; finds its box and footprints.
/// @return where that was
Point3 centre_on_origin(PlacedModel& model) {
  Box3 box;
  for (const Mesh& mesh : model.objects) box.add(box_of(mesh));
  const Point centre = box.footprint().centre();
  const Point3 home{centre.x, centre.y, box.min.z}, by{-home.x, -home.y, -home.z};
  std::vector<Point> corners;
  model.box = {}, model.footprints.clear();
  for (Mesh& mesh : model.objects) {
    mesh = moved(std::move(mesh), by);
    model.box.add(box_of(mesh));
    const Ring& footprint = model.footprints.emplace_back(footprint_of(mesh));
    corners.insert(corners.end(), footprint.begin(), footprint.end());
  }
  for (auto& marks : model.marks)
    for (Mark& mark : marks) mark.mesh = moved(std::move(mark.mesh), by);
  model.hull = convex_hull(std::move(corners));
  return home;
}

PlacedModel at_origin(Loaded loaded, const PlacementOptions& options, double rotate_deg, Point3& home) {
  PlacedModel model{std::move(loaded.path), 0, 0, {}, {}, {}, {}, {}, {}};
  Box3 in_file;
  for (const Object& object : loaded.objects) in_file.add(box_of(object.mesh));
  const Point about = in_file.footprint().centre();
  for (Object& object : loaded.objects) {
    const auto turned_in_place = [&](Mesh mesh) {
      mesh = stretched(std::move(mesh), options.stretch_xy, options.stretch_z, {about.x, about.y, 0});
      return rotated(std::move(mesh), rotate_deg, about);
    };
    model.objects.push_back(without_holes_below(turned_in_place(std::move(object.mesh))));
    for (Mark& mark : object.marks) mark.mesh = turned_in_place(std::move(mark.mesh));
    model.marks.push_back(std::move(object.marks));
  }
  home = centre_on_origin(model);
  return model;
}

/// The copies that are turned by the same, each with the model turned so, in the order they are first met.
std::vector<PlacedModel> by_turn(PlacedModel model, const std::vector<Stand>& stands) {
  std::vector<std::pair<double, std::vector<Point>>> turns;
  for (const auto& [at, turn_deg] : stands) {
    const auto same = [&, turn = turn_deg](const auto& each) { return each.first == turn; };
    auto found = std::find_if(turns.begin(), turns.end(), same);
    if (found == turns.end()) found = turns.insert(found, {turn_deg, {}});
    found->second.push_back(at);
  }
  std::vector<PlacedModel> out;
  for (auto& [turn_deg, at] : turns) {
    out.push_back(turns.size() == 1 ? std::move(model) : model);
    auto& own = out.back();
    own.instances = std::move(at), own.turned_deg = turn_deg;
    if (turn_deg == 0) continue;
    for (Mesh& mesh : own.objects) mesh = rotated(std::move(mesh), turn_deg, {});
    for (auto& marks : own.marks)
      for (Mark& mark : marks) mark.mesh = rotated(std::move(mark.mesh), turn_deg, {});
    centre_on_origin(own);
  }
  return out;
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

namespace {

/// What stands in a place of its own leaves less to the others.
void keep_free_of(const PlacedModel& model, const Stand& stand, Um spacing, Plate& free) {
  Ring hull = model.hull;
  if (stand.turn_deg != 0) {
    const Eigen::Matrix2d matrix = turn(stand.turn_deg);
    for (Point& p : hull) {
      const Eigen::Vector2d um = matrix * Eigen::Vector2d(p.x, p.y);
      p = {lattice(um.x() / 1000), lattice(um.y() / 1000)};
    }
  }
  const Point size = weft::box_of(hull).size() + Point{2 * spacing, 2 * spacing}, half{size.x / 2, size.y / 2};
  free.keep_out.push_back(
      {stand.at - half, stand.at + Point{half.x, -half.y}, stand.at + half, stand.at + Point{-half.x, half.y}});
}

/// In rows, or in cells of a grid.
void place_in_rows(const std::vector<ToPlace>& wanted, const PlacementOptions& options, const Plate& free,
                   std::vector<std::vector<Stand>>& stands) {
  std::vector<Item> items;
  std::vector<std::size_t> of_item;
  for (const auto& [model, number, copies] : wanted) {
    items.insert(items.end(), copies, {model->box.footprint().size(), &model->hull});
    of_item.resize(items.size(), number);
  }
  if (items.empty()) return;
  const Arrangement arrangement = arrange(items, free, options.center, options.spacing);
  for (std::size_t i = 0; i < items.size(); ++i) stands[of_item[i]].push_back({arrangement.at[i]});
}

}  // namespace

std::vector<PlacedModel> place(std::vector<Loaded> models, const PlacementOptions& options, const Plate& plate) {
  const auto refuse_copies = [] {
    throw Error(Error::Kind::usage, "copies of one position would lie in each other", "--keep-position",
                "leave out --copies or --keep-position");
  };
  if (options.keep_position && options.copies > 1) refuse_copies();
  const auto own = [&](std::size_t i) { return options.of_model.empty() ? PlacementOfModel{} : options.of_model[i]; };
  std::vector<PlacedModel> at_middle;
  std::vector<std::vector<Stand>> stands(models.size());
  std::vector<ToPlace> wanted;
  Plate free = plate;  // without what stands where it is told to
  at_middle.reserve(models.size());
  for (std::size_t i = 0; i < models.size(); ++i) {
    Point3 home;
    at_middle.push_back(at_origin(std::move(models[i]), options, options.rotate_deg, home));
    at_middle.back().number = i;
    stands[i] = own(i).at;
    for (const auto& stand : stands[i]) keep_free_of(at_middle.back(), stand, options.spacing, free);
    if (!stands[i].empty()) continue;
    if (options.keep_position) {
      if (own(i).copies > 1) refuse_copies();
      if (!options.drop) check_stands(at_middle.back().path, home.z);
      stands[i] = {{{home.x, home.y}}};
      continue;
    }
    wanted.push_back({&at_middle[i], i, static_cast<std::size_t>(own(i).copies > 0 ? own(i).copies : options.copies)});
  }
  if (options.arranger) {
    auto places = options.arranger(wanted, free);
    for (std::size_t k = 0; k < wanted.size(); ++k) stands[wanted[k].number] = std::move(places[k]);
  } else {
    place_in_rows(wanted, options, free, stands);
  }
  std::vector<PlacedModel> out;
  for (std::size_t i = 0; i < at_middle.size(); ++i)
    if (stands[i].empty())
      out.push_back(std::move(at_middle[i]));
    else
      for (auto& model : by_turn(std::move(at_middle[i]), stands[i])) out.push_back(std::move(model));
  return out;
}

}  // namespace weft::mesh
