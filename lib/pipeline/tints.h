// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/notice.h"
#include "mesh/mark.h"
#include "plate/plate.h"
#include "settings/settings.h"

#include <optional>
#include <string>
#include <vector>

/// Which tools print what a file paints or colours.
namespace weft::pipeline {

/// Settings that a file says of something, with the extruder in the place of a colour: that of the filament which
/// differs least. A colour goes where no filament has one; what is far from it (colour_match) is told.
/// @param file for messages
std::vector<mesh::ForeignSetting> with_extruders(std::vector<mesh::ForeignSetting> said, const Settings& plate,
                                                 const std::string& file, Notices& notices);

/// Facets that are painted for a tool, as a volume of the object: all that lies below them is printed with it.
/// Nothing, which is told, where the printer has no such tool. Pre: the mark is a tint
std::optional<Volume> tint_of(mesh::Mark mark, const Object& object, const Settings& plate, const std::string& file,
                              Notices& notices);

/// Puts the facets of another tint of the same tool to it.
void join(Volume& tint, Mesh facets);

}  // namespace weft::pipeline
