// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "model/bead.h"
#include "settings/groups/tools.h"

#include <optional>
#include <span>
#include <vector>

/// A tower of what is purged when tools change: beads like any others, so that every stage treats them so.
namespace weft::tools {

/// What is purged in one section: in a layer, or in several that lie closer than a bead is high.
struct TowerLayer {
  Um z = 0;
  Um height = 0;  ///< from the section below
  struct Strip {
    std::size_t pass = 0;  ///< the caller's number of what it is purged before
    double mm3 = 0;
    bool ram = false;  ///< it is laid by the filament before, at a pace of its own, before the change
    Um height = 0;     ///< where it is laid lower than the section's top, with a layer below that; 0: the section's
  };
  Um height_of(const Strip& strip) const { return strip.height != 0 ? strip.height : height; }

  std::vector<Strip> strips;  ///< in the order they are printed
  std::size_t wall_pass = 0;  ///< what prints wall and grid, in the highest of its layers
  bool wall_purges = false;   ///< … which count to what that pass is to purge
};

/// What is purged just above a section, as supports with layers of their own have it, would be a film as wide as the
/// bed: it is laid beside what is purged in that one instead, where that needs less room.
/// @param film a section of its own, on the other
/// @param held as high beads hold on what is below; what is lower than half of the section may be as high as `nozzle`
/// @return whether `section` has it now
bool lay_beside(const TowerLayer& film, TowerLayer& section, Um held, Um nozzle);

/// The upright box that all layers fit in, in coordinates of its own: from 0, 0. What it stands by (prime_tower_shape)
/// reaches beyond.
struct TowerSize {
  Um width = 0, depth = 0;
  Um line = 0;       ///< width of its lines
  Um height = 0;     ///< of the whole tower
  Um first = 0;      ///< below this nothing is purged
  Point foot{0, 0};  ///< how much narrower the lowest section is, on either side (prime_tower_flare_angle)
};

/// @param layers upwards; a change of less height than that at which a bead holds is the caller's to avoid
/// @param nozzle the least of those that print it
/// Post: every layer's strips fit in, whether its lines run along X or along Y.
TowerSize tower_size(const ToolSettings& settings, std::span<const TowerLayer> layers, Um nozzle);

/// The beads of one pass of a layer.
struct TowerBeads {
  std::size_t pass = 0;
  Beads beads;
  bool ram = false;  ///< of such a strip: one bead
  Um height = 0;
};

/// Strips side by side, each crossing all of the tower, along X in even layers and along Y in odd ones, so that each
/// crosses every filament below; then lines prime_tower_max_bridging_distance apart, and a wall around all. Ribs and
/// cone are loops of their own beside the wall, full in the lowest layer. A plain tower is narrower where nothing is
/// purged yet: by prime_tower_flare_angle it gets as wide as it has to be.
/// @param index of the layer, from 0; the lowest is dense, and has the brim
/// @param corner where 0, 0 of the tower comes to lie; it is turned about that by prime_tower_angle
/// Post: the volume of what a pass lays down is what it is to purge; more where wall and grid alone are.
std::vector<TowerBeads> tower_beads(const ToolSettings& settings, const TowerSize& size, const TowerLayer& layer,
                                    std::size_t index, Point corner);

/// What the tower covers with its brim.
Ring tower_outline(const ToolSettings& settings, const TowerSize& size, Point corner);

/// Where its corner may be that its outline lies on the surface, off what is forbidden and off what stands there by
/// `gap`: as near to what stands as can be. Nothing: nowhere.
std::optional<Point> place_for_tower(const ToolSettings& settings, const TowerSize& size, const Ring& surface,
                                     std::span<const Ring> forbidden, std::span<const Box> standing, Um gap);

/// How far an outline leaves a surface, at most, and where: µm; 0: nowhere.
struct Outside {
  Um by = 0;
  Point at;
};
Outside outside_of(const Ring& outline, const Ring& surface);

}  // namespace weft::tools
