// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "infill/shells.h"
#include "pipeline/handed_to.h"
#include "pipeline/inner_infill.h"

#include <vector>

/// What of an object's layers is skin, bridge or sparse, where parts of it have other settings than others.
namespace weft::pipeline {

using FillHands = HandedTo<Stage::infill>;

/// An object as shells look at it, and which scope each of its parts is asked for there: what is skin hangs on layers
/// above and below, so lines that are wider on the first layer alone count for nothing.
struct Shelled {
  const FillHands& handed;
  const Scopes& scopes;
  const std::vector<Areas>& areas;
  std::vector<infill::ShellLayer> layers;
  Box box;
  double turned_rad = 0;      ///< against its file
  std::vector<Regions> open;  ///< of its layers (inner_infill.h)

  ScopeId scope_of(ScopeId id) const { return handed.alike(scopes.above_first_layer(id)); }
};

/// Shells of all layers. Layers are taken in runs, so that the skin's neighbours are looked at once a run.
std::vector<infill::LayerAreas> find_all_areas(const Shelled& object);

/// What is of other settings than its areas, looked at over all layers.
InnerLayers take_all_inner(const Shelled& object, std::vector<infill::LayerAreas>& areas);

/// What is decided of the rest by looking at all layers. Each scope sees its own parts.
void look_at_all(const Shelled& object, std::vector<infill::LayerAreas>& areas);

/// The scopes that fill something of the object.
std::vector<ScopeId> scopes_filling(const Shelled& object, const InnerLayers& inner);

}  // namespace weft::pipeline
