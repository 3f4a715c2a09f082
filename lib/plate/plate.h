// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "mesh/layer_profile.h"
#include "mesh/mark.h"
#include "mesh/mesh.h"
#include "settings/overlay.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// What is to be printed, before anything of it is sliced: what a command line, a line of a job list or a 3MF says.
namespace weft {

/// What a volume does to its object.
enum class VolumeKind : std::uint8_t {
  model,             ///< is printed
  negative,          ///< cuts a hole
  modifier,          ///< gives what it meets other settings
  tint,              ///< facets of the object's surface: what lies below them has other settings
  support_enforcer,  ///< asks for support
  support_blocker,   ///< keeps support away
  support,           ///< is printed as support
};
std::string_view name_of(VolumeKind kind);

struct Volume {
  std::string name{};
  Mesh mesh;  ///< in the coordinates of the object's first copy; let go of once it is sliced
  VolumeKind kind = VolumeKind::model;
  Overlay overlay{};
  Overlay said{};  ///< of it by name: holds over everything else
};

/// Settings of the layers whose bottoms lie in [from, to).
struct HeightRange {
  Um from = 0, to = 0;
  Overlay overlay{};
};

/// Printed as one: its volumes are in one place, and firmware can cancel it.
struct Object {
  std::string name;
  std::vector<Volume> volumes;  ///< where they overlap, the later one wins
  Overlay overlay{};
  std::vector<HeightRange> ranges{};
  std::vector<mesh::HeightAt> heights{};  ///< of its layers, as its file says; z ascending; empty: it says nothing
  std::vector<Point> copies{{}};          ///< where each stands, against the first, which is usually {0, 0}
  double turned_deg = 0;                  ///< about Z, counter-clockwise, against its file
  Ring hull{};                            ///< of what is printed, seen from above
  std::vector<mesh::Mark> marks{};        ///< what is not printed but says something of it, in its coordinates
  Overlay said{};                         ///< of it by name: holds over everything but what is said of its volumes
};

struct Plate {
  std::vector<Object> objects;
};

/// How many objects a printer sees.
std::size_t copies_on(const Plate& plate);

/// @throws Error{model} for a plate without objects, an object without copies or parts, and volumes of kinds that are
/// marks (Object::marks)
void check_printable(const Plate& plate);

/// Comment lines that say what is laid over the plate's settings where; empty where nothing is.
std::string overlay_lines(const Plate& plate);

/// The heights of an object from which on other overlays hold, ascending, the first at 0.
std::vector<Um> heights_of_change(const Object& object);

/// What is laid over the plate's settings for a part at a height where modifiers hold: the object's, its ranges', the
/// part's own, the modifiers', and what is said of any of them by name.
/// @param modifiers indices of volumes, in their order: modifiers and a tint
std::vector<const Overlay*> overlays_at(const Object& object, const Volume& part, Um bottom,
                                        std::span<const std::size_t> modifiers = {});

/// A part of an object and the modifiers that hold: what an area of a layer can be.
struct Mix {
  std::size_t part = 0;                     ///< index into Object::volumes, of kind model
  std::vector<std::size_t> modifiers = {};  ///< the same, of kind modifier, and at most one tint; ascending
  friend bool operator==(const Mix&, const Mix&) = default;
};

/// All that areas of the object's layers can be, as far as the boxes of its volumes tell: each part alone, in order,
/// then what modifiers make of them. @throws Error{settings} when so many modifiers overlap that they are no more
/// counted
std::vector<Mix> mixes_of(const Object& object);

}  // namespace weft
