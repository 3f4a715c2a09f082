// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/sequence.h"
#include "pipeline/object_scopes.h"
#include "pipeline/stages.h"
#include "pipeline/support_object.h"
#include "plate/plate.h"
#include "settings/scopes.h"

#include <cstddef>
#include <vector>

/// Copies of objects, and what stands under them.
namespace weft::pipeline {

/// Where a copy's layers come from. What stands under a copy is a copy of its own, which firmware knows as the same.
struct Copy {
  std::size_t of = 0;  ///< index into the lists of layers
  Point by;
  bool last = false;   ///< of that list
  ObjectId label = 0;  ///< of the copy that it is, or stands under
  bool support = false;
  const TravelSettings* seams = nullptr;  ///< of its own, if any
};

inline constexpr ObjectId any_object = ~ObjectId{0};  // none

/// Copies whose infill stands still against the plate are not alike: each becomes an object, of the same name.
/// @param of_object scopes, beside the plate's objects
/// @returns whether there are any
bool tell_copies_apart(const Scopes& scopes, std::vector<ObjectScopes>& of_object, Plate& plate);

/// Object by object, as they stand on the plate.
std::vector<Copy> copies_of(const Plate& plate);

/// Objects whose seams are to be elsewhere than the plate's.
/// @param feet of each object, the settings of what it stands on; empty: nobody has seams of its own
void give_seams(const Scopes& scopes, const std::vector<ScopeId>& feet, std::vector<Copy>& copies);

/// Of each of the first so many copies, what is said of its object.
std::vector<ScopeId> by_copy(const std::vector<ScopeId>& feet, const std::vector<Copy>& copies, std::size_t count);

/// Support goes with the copies that it stands under: its layers and copies follow those of the objects.
Sequence with_supports(Sequence sequence, std::vector<SupportOf> supports, std::vector<Copy>& copies,
                       std::vector<PrintedLayers>& layers);

}  // namespace weft::pipeline
