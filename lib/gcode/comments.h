// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "gcode/text.h"
#include "model/bead.h"
#include "settings/groups/gcode.h"

#include <string_view>

namespace weft::gcode {

/// How slicers name features and layers in comments. Source: the files that PrusaSlicer 2.9, OrcaSlicer 2.3 and
/// CuraEngine 5 write.
struct Comments {
  CommentDialect dialect = CommentDialect::prusaslicer;

  /// `;TYPE:` and a line end.
  void feature(Text& out, Role role) const;
  void custom(Text& out) const;
  void pause(Text& out, bool swaps_filament, ToolId tool) const;

  /// What a layer begins with.
  /// @param names_itself the custom G-code that follows holds ;BEFORE_LAYER_CHANGE
  void layer(Text& out, std::size_t index, Um z, Um height, bool names_itself) const;

  /// Are widths and heights of beads said where they change?
  bool says_sizes() const { return dialect != CommentDialect::cura; }
};

}  // namespace weft::gcode
