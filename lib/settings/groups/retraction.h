// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/schema.h"

#include <array>

namespace weft {
using namespace weft::literals;

/// The way up of a lift.
enum class HopType { vertical, slope, spiral };
constexpr auto choices_of(HopType) {
  return std::array{Choice<HopType>{HopType::vertical, "vertical"}, Choice<HopType>{HopType::slope, "slope"},
                    Choice<HopType>{HopType::spiral, "spiral"}};
}

/// When filament is drawn back, and how.
struct RetractionSettings {
  bool retraction_enable = true;
  Um retraction_amount = 1_mm;
  double retraction_retract_speed = 40;
  std::optional<double> retraction_prime_speed;
  Um retraction_extra_prime_amount = 0_mm;
  bool firmware_retraction = false;
  Um retraction_min_travel = 1.5_mm;
  bool retract_only_when_crossing = true;
  bool retract_at_layer_change = false;
  std::optional<int> retraction_count_max;
  Um retraction_extrusion_window = 1_mm;
  bool wipe = false;
  Um wipe_distance = 1_mm;
  double retract_before_wipe = 0;
  Um retraction_hop = 0_mm;
  HopType retraction_hop_type = HopType::vertical;
  double travel_slope = 20;
  bool retraction_hop_only_when_collides = false;
  Um retraction_hop_above = 0_mm;
  std::optional<Um> retraction_hop_below;
};

inline constexpr Rows retraction_schema{
    setting("retraction_enable", Scope::tool, &RetractionSettings::retraction_enable,
            "Filament is drawn back before travels that may string."),
    setting("retraction_amount", Scope::tool, &RetractionSettings::retraction_amount, Unit::mm, 0_mm, 50_mm,
            "Length of filament drawn back."),
    setting("retraction_retract_speed", Scope::tool, &RetractionSettings::retraction_retract_speed, Unit::mm_s, 0.1,
            500, "Speed at which filament is drawn back."),
    setting("retraction_prime_speed", Scope::tool, &RetractionSettings::retraction_prime_speed, Unit::mm_s, 0.1, 500,
            "Speed at which it is pushed forward again; auto is retraction_retract_speed."),
    setting("retraction_extra_prime_amount", Scope::tool, &RetractionSettings::retraction_extra_prime_amount, Unit::mm,
            -10_mm, 10_mm, "Length of filament pushed forward beyond what was drawn back: what oozed on the way."),
    setting("firmware_retraction", Scope::tool, &RetractionSettings::firmware_retraction,
            "Retractions are written as G10 and G11; the firmware knows length and speed."),
    setting("retraction_min_travel", Scope::tool, &RetractionSettings::retraction_min_travel, Unit::mm, 0_mm, 1000_mm,
            "Travels shorter than this are not retracted unless they cross a wall."),
    setting("retract_only_when_crossing", Scope::tool, &RetractionSettings::retract_only_when_crossing,
            "Travels that stay inside the comb boundary are not retracted, however long; off: every travel of "
            "retraction_min_travel "
            "or more is retracted."),
    setting("retract_at_layer_change", Scope::tool, &RetractionSettings::retract_at_layer_change,
            "Filament is drawn back before the next layer."),
    setting("retraction_count_max", Scope::tool, &RetractionSettings::retraction_count_max, Unit::none, 0, 10000,
            "Most retractions within retraction_extrusion_window of filament, so that the same piece is not ground "
            "down; auto: any number."),
    setting("retraction_extrusion_window", Scope::tool, &RetractionSettings::retraction_extrusion_window, Unit::mm,
            0_mm, 1000_mm, "Length of filament within which retractions are counted for retraction_count_max."),
    setting("wipe", Scope::tool, &RetractionSettings::wipe,
            "The nozzle runs over what it has just printed while filament is drawn back."),
    setting("wipe_distance", Scope::tool, &RetractionSettings::wipe_distance, Unit::mm, 0_mm, 100_mm,
            "Length of that run."),
    setting("retract_before_wipe", Scope::tool, &RetractionSettings::retract_before_wipe, Unit::percent, 0, 100,
            "Least share of retraction_amount drawn back before the wipe begins; more where the wipe is too short for "
            "the rest."),
    setting("retraction_hop", Scope::tool, &RetractionSettings::retraction_hop, Unit::mm, 0_mm, 100_mm,
            "How far the nozzle is lifted on retracted travels."),
    setting("retraction_hop_type", Scope::tool, &RetractionSettings::retraction_hop_type,
            "How it is lifted: straight up, while travelling (slope), or on a circle (spiral)."),
    setting("travel_slope", Scope::tool, &RetractionSettings::travel_slope, Unit::degrees, 1, 89,
            "Angle of lifts that are not vertical."),
    setting("retraction_hop_only_when_collides", Scope::tool, &RetractionSettings::retraction_hop_only_when_collides,
            "Only travels that pass over walls are lifted."),
    setting("retraction_hop_above", Scope::tool, &RetractionSettings::retraction_hop_above, Unit::mm, 0_mm, 10000_mm,
            "Lowest Z at which travels are lifted."),
    setting("retraction_hop_below", Scope::tool, &RetractionSettings::retraction_hop_below, Unit::mm, 0_mm, 10000_mm,
            "Highest Z at which travels are lifted; auto: any."),
};
static_assert(complete<RetractionSettings>(retraction_schema));

}  // namespace weft
