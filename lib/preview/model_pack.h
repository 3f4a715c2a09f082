// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "preview/thumbnail.h"

#include <span>
#include <string>

namespace weft::preview {

/// Meshes where they stand, made coarse enough for a page: corners within a cube become one, and cubes grow until no
/// more than `most` triangles are left. For looking through, not for measuring. As page/unpack.js reads it: number of
/// corners and of triangles, corners (steps of 5 µm), indices (steps); packed as pack.h says. No triangle: "".
/// Source: Rossignac and Borrel 1993, vertex clustering. Cost: linear, some twelve times at most.
std::string packed_model(std::span<const Standing> meshes, std::size_t most = 10'000);

}  // namespace weft::preview
