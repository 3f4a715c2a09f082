// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/passes.h"

/// What is purged at changes of the tool, as far as it goes into what is printed anyway.
namespace weft::pipeline {

/// Gives each change that purges whole beads of its layer, in this order, until they hold what is wanted: those of
/// objects with purge_into_object; support of any tool; sparse infill of objects with purge_into_infill that is behind
/// two walls or more, which are printed before. Never where one of the two filaments is soluble.
/// @param layers whose beads of that kind go to `Passes::into`
void purge_into(ToolScopes& tools, Scopes& scopes, std::span<travel::LayerInput> layers, Passes& passes);

}  // namespace weft::pipeline
