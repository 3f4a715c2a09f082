// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "mesh/placement.h"
#include "pipeline/pipeline.h"
#include "pipeline/transform_models.h"
#include "plate/by_name.h"
#include "plate/plate.h"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace weft::pipeline {

/// Objects of one model that are placed together.
struct Together {
  std::size_t model = 0;
  std::vector<std::size_t> objects;  ///< of the model
  mesh::PlacementOfModel own{};
};

inline constexpr std::size_t all_before = ~std::size_t{0};  ///< of a negative volume: it cuts every part

/// What is no part, and behind which part it stands.
struct Later {
  std::size_t after = all_before;
  Volume volume;
};

/// Puts what files say of objects on the plate, and makes them findable by name: first all objects are made, without
/// their meshes; what is placed together is taken, placed by others, and put back.
class PlateBuilder {
 public:
  /// @param models as they are typed, transformed. Pre: they outlive it
  PlateBuilder(const Job& job, std::vector<Typed>& models, Report& report);

  /// What is placed: a model each, but for its objects of which something of their own is said.
  /// @throws Error{usage} for copies in one place
  std::vector<Together> together() const;
  /// The model's objects, for once.
  mesh::Loaded take(const Together& what);
  /// Again and again where copies are turned; without a place it is only known by name.
  void put(const Together& what, mesh::PlacedModel placed);
  /// Everything that has a place, with what is said of it by name. @throws Error{usage} for a name that nothing has
  Plate plate() &&;

 private:
  void add(std::size_t model);
  void lay_words(mesh::Author author, const std::vector<mesh::ForeignSetting>& said, const std::string& path,
                 Overlay& to);
  void lay(const mesh::Loaded& model, const std::vector<mesh::ForeignSetting>& said, Overlay& to);
  std::size_t number_of(std::size_t model) const;
  std::optional<mesh::PlacementOfModel> own_of(std::size_t object) const;
  Volume volume_of(mesh::Mark mark, const std::string& path);
  void add_tint(mesh::Mark mark, const std::string& path, const Object& object, std::vector<Later>& to);

  const Job& job_;
  std::vector<Typed>& typed_;
  Notices& notices_;
  Plate all_;                                                             ///< every object, without meshes and marks
  plate::Origins origins_;                                                ///< of them
  std::vector<std::pair<std::size_t, Object>> put_;                       ///< with their number in all_
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> object_of_;  ///< in all_, by model and item
  std::map<std::size_t, std::vector<std::size_t>> item_of_, volume_of_;   ///< of each object of a model
};

}  // namespace weft::pipeline
