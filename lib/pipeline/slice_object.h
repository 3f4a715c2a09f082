// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/area.h"
#include "pipeline/handed_to.h"
#include "plate/plate.h"
#include "settings/scopes.h"

#include <string>
#include <vector>

namespace weft::pipeline {

using Cuts = ResultOf<Stage::slice>;
using SliceHands = HandedTo<Stage::slice>;

/// The object's layers, each with its areas: its volumes are cut at the same heights, and put together.
Result<Cuts> slice_object(const Running& job, const Object& object, const ObjectScopes& scopes,
                          const Scopes& all_scopes, const SliceHands& handed, std::vector<Areas>& areas);

/// What the layers are a function of: the keys of the slices of each volume, and what the volume is.
std::vector<std::string> slice_hashes(const Object& object, const ObjectScopes& scopes, const Scopes& all_scopes,
                                      const SliceHands& handed);

}  // namespace weft::pipeline
