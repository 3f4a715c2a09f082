#include "gcode/comments.h"

#include <array>

namespace weft::gcode {
namespace {

struct Spelling {
  Role role;
  std::string_view cura, orca;
};
constexpr std::array spellings{
    Spelling{Role::outer_wall, "WALL-OUTER", "Outer wall"},
    Spelling{Role::inner_wall, "WALL-INNER", "Inner wall"},
    Spelling{Role::overhang_wall, "WALL-OUTER", "Overhang wall"},
    Spelling{Role::infill, "FILL", "Sparse infill"},
    Spelling{Role::solid_infill, "SKIN", "Internal solid infill"},
    Spelling{Role::top_skin, "SKIN", "Top surface"},
    Spelling{Role::bridge, "SKIN", "Bridge"},
    Spelling{Role::gap_fill, "SKIN", "Gap infill"},
    Spelling{Role::skirt, "SKIRT", "Skirt"},
    Spelling{Role::brim, "SKIRT", "Brim"},
    Spelling{Role::support, "SUPPORT", "Support"},
    Spelling{Role::support_interface, "SUPPORT-INTERFACE", "Support interface"},
    Spelling{Role::wipe_tower, "PRIME-TOWER", "Prime tower"},
};
static_assert(
    spellings.size() == role_names.size() &&
        [] {
          for (std::size_t i = 0; i < spellings.size(); ++i)
            if (spellings[i].role != static_cast<Role>(i)) return false;
          return true;
        }(),
    "row i of spellings is role i");

}  // namespace

void Comments::feature(Text& out, Role role) const {
  const auto& spelling = spellings[static_cast<std::size_t>(role)];
  switch (dialect) {
    case CommentDialect::prusaslicer:
      out << ";TYPE:" << name_of(role).comment << '\n';
      break;
    case CommentDialect::cura:
      out << ";TYPE:" << spelling.cura << '\n';
      break;
    case CommentDialect::orca:
      out << ";TYPE:" << spelling.orca << '\n';
      return;
  }
  if (role == Role::brim) out << "; brim\n";  // they have one name for both; the audit tells them apart
}

void Comments::custom(Text& out) const {
  out << (dialect == CommentDialect::cura ? ";TYPE:CUSTOM\n" : ";TYPE:Custom\n");
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
