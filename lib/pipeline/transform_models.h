// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "mesh/read.h"
#include "pipeline/pipeline.h"

#include <optional>
#include <vector>

namespace weft::pipeline {

/// A model as it is typed: one file, or the parts of one object.
struct Typed {
  mesh::Loaded model;
  std::vector<std::optional<int>> tools;  ///< of each object of the file, or part; where one is named
  bool one_object = false;
};

/// Turns, mirrors, stretches, fits, cuts, splits and merges models as the placement says: what marks them goes with
/// them. What comes of a cut or a split is a model of its own, placed by itself. Adds to `told`,
/// beside the models, what was found out on the way. Pre: transforms(placement.transform). @throws Error{usage} for a
/// cut that leaves nothing on one side
std::vector<Typed> transformed(const Settings& settings, const Placement& placement, std::vector<Typed> models,
                               std::vector<Report::Model>& told);

/// Says in the report what the words ask for.
void tell_transforms(const Placement& placement, Report::Model& told);

}  // namespace weft::pipeline
