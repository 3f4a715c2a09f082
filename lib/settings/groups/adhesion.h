// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/schema.h"

#include <array>

namespace weft {
using namespace weft::literals;

/// Which outlines a brim follows.
enum class BrimLocation { outside, inside, everywhere };
constexpr auto choices_of(BrimLocation) {
  return std::array{Choice<BrimLocation>{BrimLocation::outside, "outside"},
                    Choice<BrimLocation>{BrimLocation::inside, "inside"},
                    Choice<BrimLocation>{BrimLocation::everywhere, "everywhere"}};
}

/// What holds the print to the bed. as_set: whatever skirt_line_count and brim_width ask for.
enum class AdhesionType { as_set, none, skirt, brim, raft };
constexpr auto choices_of(AdhesionType) {
  return std::array{Choice<AdhesionType>{AdhesionType::as_set, "as_set"},
                    Choice<AdhesionType>{AdhesionType::none, "none"},
                    Choice<AdhesionType>{AdhesionType::skirt, "skirt"},
                    Choice<AdhesionType>{AdhesionType::brim, "brim"}, Choice<AdhesionType>{AdhesionType::raft, "raft"}};
}

/// What happens to a skirt or brim that would leave the print surface.
enum class AdhesionOutside { keep, clip };
constexpr auto choices_of(AdhesionOutside) {
  return std::array{Choice<AdhesionOutside>{AdhesionOutside::keep, "keep"},
                    Choice<AdhesionOutside>{AdhesionOutside::clip, "clip"}};
}

/// What is printed around the parts on the bed.
struct AdhesionSettings {
  AdhesionType adhesion_type = AdhesionType::as_set;
  int skirt_line_count = 1;
  Um skirt_gap = 6_mm;
  int skirt_height = 1;
  Um skirt_brim_minimal_length = 0_mm;
  Um brim_width = 0_mm;
  Um brim_gap = 0_mm;
  BrimLocation brim_location = BrimLocation::outside;
  bool brim_ears = false;
  double brim_ears_max_angle = 125;
  Um brim_narrow_width = 0_mm;
  std::optional<LengthOrShare> skirt_brim_line_width;
  AdhesionOutside adhesion_outside = AdhesionOutside::keep;
};

inline constexpr Rows adhesion_schema{
    setting("adhesion_type", Scope::plate, &AdhesionSettings::adhesion_type,
            "What holds the print to the bed: nothing, a skirt alone, a brim alone, a raft with the skirt that "
            "skirt_line_count says, or what skirt_line_count and brim_width say."),
    setting("skirt_line_count", Scope::plate, &AdhesionSettings::skirt_line_count, Unit::none, 0, 1000,
            "Loops of the skirt around everything on the bed."),
    setting("skirt_gap", Scope::plate, &AdhesionSettings::skirt_gap, Unit::mm, 0_mm, 200_mm,
            "Distance between the parts (or their brim) and the innermost loop of the skirt."),
    setting("skirt_height", Scope::plate, &AdhesionSettings::skirt_height, Unit::layers, 0, 100000,
            "Layers that the skirt is printed on; 0 prints none."),
    setting("skirt_brim_minimal_length", Scope::plate, &AdhesionSettings::skirt_brim_minimal_length, Unit::mm, 0_mm,
            16000_mm, "Loops are added to the skirt until skirt and brim are at least this long together."),
    setting("brim_width", Scope::object, &AdhesionSettings::brim_width, Unit::mm, 0_mm, 200_mm,
            "Width of the brim on the first layer; 0 prints none."),
    setting("brim_gap", Scope::object, &AdhesionSettings::brim_gap, Unit::mm, 0_mm, 10_mm,
            "Distance between the part and its brim, to make it easier to take off."),
    setting("brim_location", Scope::object, &AdhesionSettings::brim_location, "Outlines that the brim follows."),
    setting("brim_ears", Scope::object, &AdhesionSettings::brim_ears,
            "The brim is a disc of radius brim_width at each tip of the part, where it would come off first, and "
            "nothing elsewhere."),
    setting("brim_ears_max_angle", Scope::object, &AdhesionSettings::brim_ears_max_angle, Unit::degrees, 0, 180,
            "What is sharper than this is a tip, rounded or not."),
    setting("brim_narrow_width", Scope::object, &AdhesionSettings::brim_narrow_width, Unit::mm, 0_mm, 200_mm,
            "The brim is only where the foot of the part is narrower than this; 0: everywhere."),
    setting("skirt_brim_line_width", Scope::plate, &AdhesionSettings::skirt_brim_line_width, Unit::mm, 0.05_mm, 5_mm,
            "Line width of skirt and brim; auto keeps the cross-section of the nozzle; a share is of nozzle_diameter."),
    setting("adhesion_outside", Scope::plate, &AdhesionSettings::adhesion_outside,
            "Skirt and brim that leave the print surface: keep leaves them to the audit, clip cuts them off."),
};
static_assert(complete<AdhesionSettings>(adhesion_schema));

}  // namespace weft
