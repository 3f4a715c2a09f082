// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/slice_object.h"
#include "slice/slice.h"

#include <vector>

namespace weft::pipeline {

/// Did a profile of heights come with its file that is for an object as high as this one?
bool follows_profile(const Object& object, Um top);

/// The layers of an object: of the heights that its scopes and layer_height_ranges say; by its surface where that is
/// asked for; those of the profile that came with its file, where there is one.
/// @param top how high what is printed of it reaches
std::vector<slice::Plane> layers_of(const Object& object, const ObjectScopes& scopes, const SliceHands& handed, Um top);

}  // namespace weft::pipeline
