// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "prusaslicer/lines.h"

#include <functional>
#include <string>
#include <string_view>

namespace weft::prusaslicer {

/// What becomes of a line: one of weft's settings, or a remark of what is lost.
struct Outlet {
  std::function<void(std::string_view key, std::string text, const IniEntry&)> set;
  std::function<void(const IniEntry&, std::string why)> approximate;
  std::function<void(std::string_view theirs)> instead_of;  ///< that key's own line says nothing more
};

/// With automatic_extrusion_widths no width holds but the automatic one: the lines say 0 from now on.
void automatic_widths(Lines& lines);

/// Keys that ask for nothing of other keys' arithmetic: what stands in the file and what is done to it, scarfs,
/// slanting lifts, draft shields, a fan of its own time, and the filament's bounds of infill.
/// @param infill_mm_s, solid_mm_s what sparse and solid infill are printed at
/// @throws Error{settings} for a configuration of a resin printer
void import_single_keys(Lines& lines, double infill_mm_s, double solid_mm_s, const Outlet& out);

}  // namespace weft::prusaslicer
