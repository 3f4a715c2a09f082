// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "infill/shells.h"
#include "model/area.h"
#include "model/layer.h"
#include "settings/scopes.h"

#include <optional>
#include <vector>

namespace weft::pipeline {

/// What of a layer's sparse infill is of other settings than its area's.
struct InnerInfill {
  ScopeId scope = 0;
  infill::LayerAreas parts{};
};

using InnerLayers = std::vector<std::vector<InnerInfill>>;  ///< of all layers

/// What of a layer may be sparse where areas that are solid throughout have inner ones that are not, or the other way
/// round. @returns nothing where neither is so in any layer
std::vector<Regions> open_to_infill(const Scopes& scopes, const std::vector<Areas>& areas,
                                    const std::vector<const Regions*>& outlines);

/// Takes it out of the layer's parts: one each inner area, in their order. What is to be solid becomes solid: shells
/// are found by cells, and at the borders a strip is left.
std::vector<InnerInfill> take_inner(const Areas& areas, const Scopes& scopes, infill::LayerAreas& parts);

/// All parts of an object's layers together; nothing where no inner area has any.
std::optional<std::vector<infill::LayerAreas>> with_inner(const std::vector<infill::LayerAreas>& parts,
                                                          const InnerLayers& inner);

/// One filling behind the other. Sequences of one are not continued by the next.
void put_behind(FillLayer filled, FillLayer& to);

}  // namespace weft::pipeline
