// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "mesh/placement.h"
#include "pipeline/pipeline.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace weft::pipeline {

/// Where models stand by their true outlines, as the placement asks: on one bed, as many as there is room for, or on as
/// many plates as it takes, of which those of Placement::on_plate are given.
/// @param models what has no place yet  @param free what is left to them
/// @param report is told of the plates
/// @throws Error{audit} where not all have room, Error{usage} for a plate that there is not
std::vector<std::vector<mesh::Stand>> arranged(const Job& job, std::span<const mesh::ToPlace> models,
                                               const mesh::Plate& free, Report& report);

/// The file of one of several plates: of "a/b.gcode" the second is "a/b_plate_2.gcode".
std::string name_of_plate(const std::string& file, std::size_t plate);

}  // namespace weft::pipeline
