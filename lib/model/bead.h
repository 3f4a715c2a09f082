#pragma once
#include "core/polygon.h"
#include "core/scope_id.h"
#include "model/tool.h"

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace weft {

/// What a bead is for. The order is that of `role_names`.
enum class Role : std::uint8_t {
  outer_wall,
  inner_wall,
  overhang_wall,
  infill,        ///< sparse
  solid_infill,  ///< inside, or a bottom
  top_skin,
  bridge,
  gap_fill,
  skirt,
  brim,
  support,
  support_interface,
  wipe_tower,
};

/// Names of a role: in weft's settings and reports, and in `;TYPE:` comments as PrusaSlicer spells them.
struct RoleName {
  Role role;
  std::string_view key;      ///< "outer_wall"
  std::string_view comment;  ///< "External perimeter"
};
inline constexpr std::array role_names{
    RoleName{Role::outer_wall, "outer_wall", "External perimeter"},
    RoleName{Role::inner_wall, "inner_wall", "Perimeter"},
    RoleName{Role::overhang_wall, "overhang_wall", "Overhang perimeter"},
    RoleName{Role::infill, "infill", "Internal infill"},
    RoleName{Role::solid_infill, "skin", "Solid infill"},
    RoleName{Role::top_skin, "top_skin", "Top solid infill"},
    RoleName{Role::bridge, "bridge", "Bridge infill"},
    RoleName{Role::gap_fill, "gap_fill", "Gap fill"},
    RoleName{Role::skirt, "skirt", "Skirt/Brim"},
    RoleName{Role::brim, "brim", "Skirt/Brim"},
    RoleName{Role::support, "support", "Support material"},
    RoleName{Role::support_interface, "support_interface", "Support material interface"},
    RoleName{Role::wipe_tower, "wipe_tower", "Wipe tower"},
};
static_assert(
    [] {
      for (std::size_t i = 0; i < role_names.size(); ++i)
        if (role_names[i].role != static_cast<Role>(i)) return false;
      return true;
    }(),
    "row i of role_names is role i");
constexpr const RoleName& name_of(Role role) {
  return role_names[static_cast<std::size_t>(role)];
}

/// One vertex of a bead's centreline.
struct Junction {
  Point at;
  Um width = 0;  ///< band: volume = width × layer height × length × flow (model/flow.h)
  float flow =
      1.F;  ///< share of the band's volume that is really extruded; width and flow vary linearly between junctions
  friend bool operator==(const Junction&, const Junction&) = default;
};

/// A line of plastic: a centreline whose width and flow vary along it.
struct Bead {
  std::vector<Junction> path;  ///< at least two; a closed bead does not repeat its first junction
  Role role = Role::outer_wall;
  bool closed = false;
  std::uint16_t inset = 0;  ///< walls: 0 is the outermost, counted inwards
  std::uint32_t part = 0;   ///< index of the region of the layer it belongs to: beads of a part are printed together
  std::uint32_t sequence =
      0;  ///< fills: beads of equal non-zero value are printed in their order in the list (monotonic skin)
  ToolId tool = any_tool;  ///< what it is printed with
  ScopeId scope = 0;       ///< what settings it is printed with
  friend bool operator==(const Bead&, const Bead&) = default;
};
using Beads = std::vector<Bead>;

/// Mean cross-section between two junctions of a bead of that height, mm²: the integral of the product of two linear
/// functions, so that cutting a segment changes no volume.
inline double mean_area_mm2(const Junction& a, const Junction& b, double height_mm) {
  const double wa = a.width, wb = b.width, fa = static_cast<double>(a.flow), fb = static_cast<double>(b.flow);
  return (2 * wa * fa + wa * fb + wb * fa + 2 * wb * fb) / 6000.0 * height_mm;
}

/// Around the centreline.
Box box_of(const Bead& bead);

/// Length of the centreline, mm; a closed bead's closing segment counts.
double length_mm(const Bead& bead);

/// Extruded volume, mm³, at that layer height: ∫ width · flow ds · height.
double volume_mm3(const Bead& bead, Um height);

}  // namespace weft
