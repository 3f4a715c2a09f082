// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "mesh/read.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace weft::mesh {

/// What models are placed on.
struct Plate {
  Ring surface{};                ///< simple, counter-clockwise, maybe concave
  std::vector<Ring> keep_out{};  ///< areas of the surface that nothing may stand on
  Um height = 0;                 ///< highest that may be printed
};

/// Where a copy stands: the middle of its box on the bed, when it is turned so far, besides what turns all copies.
struct Stand {
  Point at;
  double turn_deg = 0;  ///< counter-clockwise
  friend bool operator==(const Stand&, const Stand&) = default;
};

/// What one model has of its own.
struct PlacementOfModel {
  std::vector<Stand> at{};  ///< one a copy; none: it is arranged with the others
  int copies = 0;           ///< 0: as many as of all models. Not looked at where it has places
  friend bool operator==(const PlacementOfModel&, const PlacementOfModel&) = default;
};

struct PlacedModel;

/// Something to be placed, and how often.
struct ToPlace {
  const PlacedModel* model = nullptr;
  std::size_t number = 0;  ///< of the model among those that `place` was given
  std::size_t copies = 1;
};

struct PlacementOptions {
  double stretch_xy = 1, stretch_z = 1;  ///< about the middle of each model, and the bed
  double rotate_deg = 0;                 ///< counter-clockwise about a vertical axis through the middle of each model
  bool keep_position = false;            ///< the file's coordinates stay; Pre: copies is 1
  bool drop = false;                     ///< … but what floats or dips is put down on the bed
  std::optional<Point> center{};         ///< of the box of everything; none: the middle of the plate
  int copies = 1;                        ///< of each model, > 0
  Um spacing = 6_mm;                     ///< between the boxes of two models or copies, >= 0
  std::vector<PlacementOfModel> of_model{};  ///< beside the models; empty: none has anything of its own
  /// Finds places for models that have none, on what is free; none: rows, or cells of a grid. Of a model without a
  /// place nothing is printed.
  std::function<std::vector<std::vector<Stand>>(std::span<const ToPlace> models, const Plate& free)> arranger{};
};

/// One file's objects, which keep their places among themselves. The model is sliced once, at its own origin; where its
/// copies stand are translations of the result by whole microns.
struct PlacedModel {
  std::string path;
  std::size_t number = 0;  ///< of the model among those that were to be placed; several have it where copies are turned
  double turned_deg = 0;   ///< of Stand: about Z, counter-clockwise
  std::vector<Mesh>
      objects;  ///< as many as were loaded; the middle of their box is x = y = 0, their lowest point z = 0
  std::vector<std::vector<Mark>> marks;  ///< of each object, placed with it
  Box3 box;                              ///< of all objects
  std::vector<Ring> footprints;          ///< of each object: the convex hull, counter-clockwise
  Ring hull;                             ///< of all of them
  std::vector<Point> instances;  ///< where the origin of each copy is on the plate; in rows from the front, from the
                                 ///< left. Empty: the arranger had none
  friend bool operator==(const PlacedModel&, const PlacedModel&) = default;
};

/// Turns the models, drops them to z = 0 and puts them on the plate: one alone in the middle, several in rows around
/// it, or, where rows do not fit (a round or a concave plate), in the cells of a grid that do. Copies that are turned
/// are models of their own, behind each other. What fits nowhere is
/// placed in rows nevertheless: check_fits and the audit find it. Throws: Error::Kind::usage for copies of kept
/// positions; Error::Kind::audit when the rows leave the lattice. Law: deterministic; turning by a multiple of 90° is
/// exact, by another angle rounds each vertex to a micron. Cost: linear in the models, and (copies × columns of the
/// plate) for the rows.
std::vector<PlacedModel> place(std::vector<Loaded> models, const PlacementOptions& options, const Plate& plate);

/// Throws Error::Kind::audit for the first model of which a copy reaches beyond the plate by more than `tolerance`,
/// with the size that it has and the size that is there. Exact also for a concave plate: the triangles are looked at.
void check_fits(std::span<const PlacedModel> models, const Plate& plate, Um tolerance);

/// The mesh turned about the z axis through `about`. Post: welded, no triangle has a corner twice.
Mesh rotated(Mesh mesh, double degrees, Point about);

/// The mesh stretched about a point: by one factor in X and Y, by another in Z. Pre: both > 0, and it stays on the
/// lattice. Post: as of `rotated`.
Mesh stretched(Mesh mesh, double xy, double z, Point3 about);

/// The mesh moved. Pre: it stays on the lattice.
Mesh moved(Mesh mesh, Point3 by);

}  // namespace weft::mesh
