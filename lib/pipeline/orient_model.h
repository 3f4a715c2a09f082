// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "mesh/mesh.h"
#include "pipeline/report.h"
#include "settings/settings.h"

#include <vector>

namespace weft::pipeline {

/// How a model may be laid so that it wants least support: the best few, best first. The facets' directions and heights
/// choose among all candidates (mesh::facings_of); the few that are left are sliced coarsely and asked for their
/// demand. What counts is the plastic that columns and their roofs take, the area that support touches, the height, and
/// a foot to stand on. Law: deterministic, for any number of threads. Post: not empty.
std::vector<Report::Orientation> orientations_of(const Settings& settings, const Mesh& mesh);

}  // namespace weft::pipeline
