// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "audit/audit.h"
#include "command.h"
#include "preview/preview.h"
#include "settings/settings.h"

#include <string>
#include <string_view>
#include <vector>

/// What pages of weft need to know beyond the moves: the machine, the findings of an audit, the model.
namespace weft::app {

/// Settings that G-code says of itself: weft's own, or a configuration of PrusaSlicer, SuperSlicer or Slic3r in its
/// comments; nullopt: none.
std::optional<Settings> settings_in(const std::string& path);

/// The settings that the command asks for; where it names neither profile nor setting, those that the file says of
/// itself; else the defaults. @throws Error
Settings settings_for(const Command& command, const std::string& path);

/// Reads moves with their times and what lies below them. @throws Error{file} when there is nothing to draw
preview::Toolpaths toolpaths_of(std::string_view gcode, const Settings& settings, const std::string& path);

/// The machine, and what an audit has found.
preview::Overlay overlay_of(const MachineSettings& machine, const audit::Report& report);

/// The page of one print. @param models files that it was made of; empty: those that it names and that lie beside it
std::string page_of(const preview::Toolpaths& paths, std::string_view gcode, const std::string& path,
                    const preview::View& view, const std::optional<preview::Overlay>& overlay,
                    const std::vector<std::string>& models);

/// The model that G-code of weft was made of, where it stands, packed for a page; "" where it is not at hand.
std::string packed_model_of(std::string_view gcode, const std::string& path, const std::vector<std::string>& models);

}  // namespace weft::app
