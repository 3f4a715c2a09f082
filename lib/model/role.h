// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/rgb.h"
#include "core/table.h"
#include "settings/groups/gcode.h"
#include "settings/groups/speeds.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

/// What beads are for: one row a role, and everything that differs from role to role stands in it.
namespace weft {

/// What a bead is for. The order is that of `roles`.
enum class Role : std::uint8_t {
  outer_wall,
  inner_wall,
  overhang_wall,
  infill,        ///< sparse
  solid_infill,  ///< inside, or a bottom
  top_skin,
  bridge,
  overhang_skin,  ///< solid infill over air that is no bridge: held at one end of its lines, or at none
  gap_fill,
  skirt,
  brim,
  support,
  support_interface,
  wipe_tower,
  ironing,  ///< over skin, for its gloss
};

/// What roles have in common.
enum class RoleKind : std::uint8_t { wall, skin, fill, adhesion, support, tower };

/// How a dialect of comments calls a role: behind `;TYPE:`, and in a comment of its own where one name stands for two
/// roles that the audit tells apart.
struct RoleComment {
  std::string_view type;
  std::string_view aside{};
};

/// The setting that a role's speed comes from: `speed`, mm/s; where `share` is named, that share of it. Where `own` is
/// named and not auto it holds, also on the first layer.
struct RoleSpeed {
  double SpeedSettings::*speed;
  SpeedOrShare SpeedSettings::*share = nullptr;
  std::optional<double> SpeedSettings::*own = nullptr;
};

/// The settings that a role's acceleration comes from: the first that is not auto; else acceleration_print.
using RoleAcceleration = std::array<std::optional<double> SpeedSettings::*, 2>;

struct RoleRow {
  Role role;
  std::string_view key;  ///< in weft's settings, reports and pictures
  RoleKind kind;
  std::array<RoleComment, 3> comments;  ///< by CommentDialect
  RoleSpeed speed;
  RoleAcceleration acceleration;
  Rgb colour;                      ///< in pictures
  bool outside = false;            ///< walls: nothing lies further out
  bool over_air = false;           ///< nothing lies below: printed with the bridges' fan
  std::optional<Role> hangs_as{};  ///< what it is where nothing lies below any of its width
};

/// Comments as PrusaSlicer 2.9, CuraEngine 5 and OrcaSlicer 2.3 write them.
inline constexpr auto roles = [] {
  using S = SpeedSettings;
  using enum RoleKind;
  return std::array{
      RoleRow{.role = Role::outer_wall,
              .key = "outer_wall",
              .kind = wall,
              .comments = {{{"External perimeter"}, {"WALL-OUTER"}, {"Outer wall"}}},
              .speed = {&S::speed_wall_0},
              .acceleration = {&S::acceleration_wall_0},
              .colour = {238, 121, 52},
              .outside = true,
              .hangs_as = Role::overhang_wall},
      RoleRow{.role = Role::inner_wall,
              .key = "inner_wall",
              .kind = wall,
              .comments = {{{"Perimeter"}, {"WALL-INNER"}, {"Inner wall"}}},
              .speed = {&S::speed_wall_x},
              .acceleration = {&S::acceleration_wall_x},
              .colour = {246, 199, 68},
              .hangs_as = Role::overhang_wall},
      RoleRow{.role = Role::overhang_wall,
              .key = "overhang_wall",
              .kind = wall,
              .comments = {{{"Overhang perimeter"}, {"WALL-OUTER"}, {"Overhang wall"}}},
              .speed = {&S::speed_wall_0, &S::speed_overhang},
              .acceleration = {&S::acceleration_wall_0},
              .colour = {48, 88, 214},
              .outside = true,
              .over_air = true,
              .hangs_as = Role::overhang_wall},
      RoleRow{.role = Role::infill,
              .key = "infill",
              .kind = fill,
              .comments = {{{"Internal infill"}, {"FILL"}, {"Sparse infill"}}},
              .speed = {&S::speed_infill},
              .acceleration = {&S::acceleration_infill},
              .colour = {178, 62, 52}},
      RoleRow{.role = Role::solid_infill,
              .key = "skin",
              .kind = skin,
              .comments = {{{"Solid infill"}, {"SKIN"}, {"Internal solid infill"}}},
              .speed = {&S::speed_topbottom},
              .acceleration = {&S::acceleration_topbottom},
              .colour = {146, 98, 214},
              .hangs_as = Role::overhang_skin},
      RoleRow{.role = Role::top_skin,
              .key = "top_skin",
              .kind = skin,
              .comments = {{{"Top solid infill"}, {"SKIN"}, {"Top surface"}}},
              .speed = {&S::speed_top_skin},
              .acceleration = {&S::acceleration_top_skin, &S::acceleration_topbottom},
              .colour = {226, 76, 96}},
      RoleRow{.role = Role::bridge,
              .key = "bridge",
              .kind = skin,
              .comments = {{{"Bridge infill"}, {"SKIN"}, {"Bridge"}}},
              .speed = {&S::speed_bridge},
              .acceleration = {&S::acceleration_bridge},
              .colour = {88, 156, 236},
              .over_air = true},
      RoleRow{.role = Role::overhang_skin,
              .key = "overhang_skin",
              .kind = skin,
              .comments = {{{"Bridge infill", "overhang"}, {"SKIN", "overhang"}, {"Bridge", "overhang"}}},
              .speed = {&S::speed_topbottom, &S::speed_overhang},
              .acceleration = {&S::acceleration_topbottom},
              .colour = {120, 60, 150},
              .over_air = true,
              .hangs_as = Role::overhang_skin},
      RoleRow{.role = Role::gap_fill,
              .key = "gap_fill",
              .kind = fill,
              .comments = {{{"Gap fill"}, {"SKIN"}, {"Gap infill"}}},
              .speed = {&S::speed_gap_fill},
              .acceleration = {&S::acceleration_wall_x},
              .colour = {190, 196, 204}},
      RoleRow{.role = Role::skirt,
              .key = "skirt",
              .kind = adhesion,
              .comments = {{{"Skirt/Brim"}, {"SKIRT"}, {"Skirt"}}},
              .speed = {&S::speed_wall_0, nullptr, &S::skirt_brim_speed},
              .acceleration = {},
              .colour = {44, 160, 112}},
      RoleRow{.role = Role::brim,
              .key = "brim",
              .kind = adhesion,
              .comments = {{{"Skirt/Brim", "brim"}, {"SKIRT", "brim"}, {"Brim"}}},
              .speed = {&S::speed_wall_0, nullptr, &S::skirt_brim_speed},
              .acceleration = {},
              .colour = {24, 130, 90}},
      RoleRow{.role = Role::support,
              .key = "support",
              .kind = support,
              .comments = {{{"Support material"}, {"SUPPORT"}, {"Support"}}},
              .speed = {&S::speed_support_infill},
              .acceleration = {},
              .colour = {98, 196, 116}},
      RoleRow{.role = Role::support_interface,
              .key = "support_interface",
              .kind = support,
              .comments = {{{"Support material interface"}, {"SUPPORT-INTERFACE"}, {"Support interface"}}},
              .speed = {&S::speed_support_interface},
              .acceleration = {},
              .colour = {40, 130, 66}},
      RoleRow{.role = Role::wipe_tower,
              .key = "wipe_tower",
              .kind = tower,
              .comments = {{{"Wipe tower"}, {"PRIME-TOWER"}, {"Prime tower"}}},
              .speed = {&S::speed_infill},
              .acceleration = {},
              .colour = {170, 190, 150}},
      RoleRow{.role = Role::ironing,
              .key = "ironing",
              .kind = skin,
              .comments = {{{"Ironing"}, {"SKIN", "ironing"}, {"Ironing"}}},
              .speed = {&S::speed_ironing},
              .acceleration = {&S::acceleration_top_skin, &S::acceleration_topbottom},
              .colour = {255, 140, 180}},
  };
}();
static_assert(in_order(roles, &RoleRow::role), "row i of roles is role i");
static_assert(roles[0].comments.size() == choices_of(CommentDialect{}).size(), "a dialect has no column");

constexpr const RoleRow& row_of(Role role) {
  return row_of(roles, role);
}
constexpr bool is_wall(Role role) {
  return row_of(role).kind == RoleKind::wall;
}

}  // namespace weft
