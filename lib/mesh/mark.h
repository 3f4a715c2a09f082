// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "mesh/mesh.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace weft::mesh {

/// What a volume of an object is for, when it is no part of it.
enum class MarkKind : std::uint8_t { negative, modifier, support_enforcer, support_blocker, support };

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
};

/// A volume that is not printed, or a piece of painted surface: it says something of the part it lies in.
struct Mark {
  MarkKind kind = MarkKind::modifier;
  bool painted = false;  ///< facets of the part's own surface; enforcers and blockers only
  Mesh mesh;             ///< in the coordinates of its object
  friend bool operator==(const Mark&, const Mark&) = default;
};

}  // namespace weft::mesh
