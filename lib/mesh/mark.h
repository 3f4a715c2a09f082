// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "mesh/mesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace weft::mesh {

/// What a volume of an object is for, when it is no part of it.
enum class MarkKind : std::uint8_t { negative, modifier, support_enforcer, support_blocker, support, tint };

struct MarkName {
  MarkKind kind;
  std::string_view name;         ///< weft's
  std::string_view prusaslicer;  ///< `volume_type`
  std::string_view orca;         ///< `subtype`, in OrcaSlicer and BambuStudio
};
inline constexpr std::array mark_names{
    MarkName{MarkKind::negative, "negative volume", "NegativeVolume", "negative_part"},
    MarkName{MarkKind::modifier, "modifier", "ParameterModifier", "modifier_part"},
    MarkName{MarkKind::support_enforcer, "support enforcer", "SupportEnforcer", "support_enforcer"},
    MarkName{MarkKind::support_blocker, "support blocker", "SupportBlocker", "support_blocker"},
    MarkName{MarkKind::support, "support", "", ""},
    MarkName{MarkKind::tint, "paint", "", ""},
};

/// A setting of a volume, in the words of the program that wrote the file.
struct ForeignSetting {
  std::string key, value;
  friend bool operator==(const ForeignSetting&, const ForeignSetting&) = default;
};

/// Whose words the settings of a file are.
enum class Author : std::uint8_t { unknown, prusaslicer, orca, cura };

/// A volume that is not printed, or a piece of painted surface: it says something of the part it lies in.
struct Mark {
  MarkKind kind = MarkKind::modifier;
  bool painted = false;  ///< facets of the part's own surface: enforcers, blockers, and what is for another tool
  Mesh mesh;             ///< in the coordinates of its object
  std::string name{};
  std::vector<ForeignSetting> settings{};  ///< of a modifier; of a tint which extruder, or colour, it is for
  Author author = Author::unknown;         ///< of them; unknown: they are weft's
  std::size_t after = ~std::size_t{0};     ///< a negative volume cuts so many of the item's parts: those before it
  friend bool operator==(const Mark&, const Mark&) = default;
};

}  // namespace weft::mesh
