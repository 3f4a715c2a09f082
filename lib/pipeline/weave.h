// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/area.h"
#include "pipeline/object_scopes.h"
#include "slice/interlock.h"
#include "slice/slice.h"

#include <map>
#include <optional>
#include <vector>

namespace weft::pipeline {

/// How parts of an object that are printed with different tools are woven into each other where they touch.
struct Weave {
  slice::InterlockStyle style;
  std::map<ScopeId, ToolId> tool;  ///< that walls of a scope are printed with
};
/// Nothing: they are not. @param scopes of the object
std::optional<Weave> weave_of(const ObjectScopes& scopes, const Scopes& all);

/// Regions change hands where beams of one part lie in the other; what a layer covers stays.
/// @param layers, areas of the object, beside each other
void weave(const Weave& how, std::vector<slice::Cut>& layers, std::vector<Areas>& areas);

}  // namespace weft::pipeline
