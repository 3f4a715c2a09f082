// SPDX-License-Identifier: GPL-3.0-or-later
#include "gcode/comments.h"

namespace weft::gcode {
void Comments::feature(Text& out, Role role) const {
  const auto& comment = row_of(role).comments[static_cast<std::size_t>(dialect)];
  out << ";TYPE:" << comment.type << '\n';
  if (!comment.aside.empty()) out << "; " << comment.aside << '\n';
}

void Comments::custom(Text& out) const {
  out << (dialect == CommentDialect::cura ? ";TYPE:CUSTOM\n" : ";TYPE:Custom\n");
}

void Comments::pause(Text& out, bool swaps_filament, ToolId tool) const {
  if (dialect == CommentDialect::cura) return;
  if (swaps_filament)
    out << ";COLOR_CHANGE,T" << std::int64_t{tool} << '\n';
  else
    out << ";PAUSE_PRINT\n";
}

void Comments::layer(Text& out, std::size_t index, Um z, Um height, bool names_itself) const {
  if (dialect == CommentDialect::cura) {
    out << ";LAYER:" << static_cast<std::int64_t>(index) << '\n';
    return;
  }
  out << ";LAYER_CHANGE\n;Z:";
  out.spelled(z) << "\n;HEIGHT:";
  out.spelled(height) << '\n';
  if (names_itself) return;
  out << ";BEFORE_LAYER_CHANGE\n;";  // where print servers look for the height of the object
  out.spelled(z) << '\n';
}

}  // namespace weft::gcode
