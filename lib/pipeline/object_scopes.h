// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/area.h"
#include "pipeline/tool_scopes.h"
#include "plate/plate.h"
#include "settings/scopes.h"
#include "slice/slice.h"

#include <string>
#include <vector>

/// Which settings hold where in an object: overlays become scopes, and layers get their areas.
namespace weft::pipeline {

/// From one height on, the scope of each part, alone and where modifiers hold.
struct ScopesFrom {
  Um bottom = 0;                ///< of the lowest layer
  std::vector<ScopeId> of_mix;  ///< beside mixes_of(object)
};

/// Upwards from the bed. The first is that of the first layer alone.
using ObjectScopes = std::vector<ScopesFrom>;

/// Lays the object's overlays over the plate's settings. @throws Error{settings} where a layer would be higher than the
/// nozzle is wide
ObjectScopes scopes_of(const Object& object, ToolScopes& tools, Scopes& scopes);

/// What holds for a layer that has its bottom there.
const ScopesFrom& at(const ObjectScopes& scopes, Um bottom);

/// The layers of several volumes put together: where parts overlap the later one has it, and those of one scope are
/// united; negative volumes cut parts before them; modifiers divide what they meet. Beside them goes what areas each
/// has. Modifiers that speak of sparse infill alone divide nothing: they make inner areas of what they meet.
/// @param cuts beside the object's volumes, all at the same heights
std::vector<slice::Cut> united(const Object& object, const ObjectScopes& scopes,
                               const std::vector<const std::vector<slice::Cut>*>& cuts, std::vector<Areas>& areas);

/// The areas of layers of one volume: one each.
std::vector<Areas> areas_of_one(const ObjectScopes& scopes, const std::vector<slice::Cut>& cuts);

/// What the files that infill is laid by hold, and where the object lies on them, as well where patterns stand still
/// against the plate, or are turned with the object; empty where nothing of that is asked for.
/// @throws Error{settings} for one that is not there
std::string files_of_infill(const Scopes& scopes, Point at, double turned_deg);

}  // namespace weft::pipeline
