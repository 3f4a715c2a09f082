// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/microns.h"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace weft::mesh {

/// A point of a profile of heights: layers there are so high, and between two points as much as lies between.
struct HeightAt {
  Um z = 0, height = 0;
  friend bool operator==(const HeightAt&, const HeightAt&) = default;
};

/// Profiles by the object's place among objects, from 1: lines of `object_id=1|z;height;z;height…`, in mm.
/// Source: Metadata/Slic3r_PE_layer_heights_profile.txt and Metadata/layer_heights_profile.txt, as PrusaSlicer 2.9 and
/// BambuStudio write them.
/// @throws Error{model} for what is no number, no height of a layer, or does not ascend
std::map<std::uint32_t, std::vector<HeightAt>> layer_profiles(std::string_view text, const std::string& path);

}  // namespace weft::mesh
