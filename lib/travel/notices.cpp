// SPDX-License-Identifier: GPL-3.0-or-later
#include "travel/travel.h"

#include <fmt/format.h>

namespace weft::travel {
namespace {

std::string place(Point3 p) {
  return fmt::format("({:.3f}, {:.3f}, {:.3f})", to_mm(p.x), to_mm(p.y), to_mm(p.z));
}

class Check {
 public:
  /// `key` has been given a value that cannot matter.
  void without_effect(bool given, std::string_view key, std::string_view why) {
    if (given) notices.push_back({"setting_without_effect", fmt::format("{} has no effect: {}", key, why)});
  }
  void contradiction(bool given, std::string message) {
    if (given) notices.push_back({"settings_contradict", std::move(message)});
  }
  Notices notices;
};

void check_combing(const TravelSettings& t, const RetractionSettings& r, Check& check) {
  const TravelSettings usual;
  const bool off = t.retraction_combing == Combing::off;
  check.without_effect(t.retraction_combing_offset != 0 && t.retraction_combing != Combing::all,
                       "retraction_combing_offset", "it moves the boundary of retraction_combing = all only");
  check.without_effect(off && t.retraction_combing_max_distance, "retraction_combing_max_distance",
                       "retraction_combing is off");
  check.without_effect(off && t.retraction_combing_max_distance_wall_0 != usual.retraction_combing_max_distance_wall_0,
                       "retraction_combing_max_distance_wall_0", "retraction_combing is off");
  check.without_effect(!off && t.retraction_combing_max_distance && t.retraction_combing_max_distance_wall_0 &&
                           t.retraction_combing_max_distance_wall_0 != usual.retraction_combing_max_distance_wall_0 &&
                           *t.retraction_combing_max_distance_wall_0 >= *t.retraction_combing_max_distance,
                       "retraction_combing_max_distance_wall_0",
                       "retraction_combing_max_distance, which holds for all beads, is no more");
  check.without_effect(off && t.retraction_combing_max_detour != usual.retraction_combing_max_detour,
                       "retraction_combing_max_detour", "retraction_combing is off");
  check.without_effect(
      !t.travel_avoid_other_parts && !t.travel_avoid_supports && t.travel_avoid_distance != usual.travel_avoid_distance,
      "travel_avoid_distance", "travel_avoid_other_parts and travel_avoid_supports are off");
  check.contradiction(
      t.retraction_combing_max_distance && *t.retraction_combing_max_distance < r.retraction_min_travel,
      fmt::format("retraction_combing_max_distance ({:.3f} mm) is less than retraction_min_travel ({:.3f} mm): combed "
                  "travels between the two are retracted, straight ones of that length are not",
                  to_mm(t.retraction_combing_max_distance.value_or(0)), to_mm(r.retraction_min_travel)));
}

void check_seams(const TravelSettings& t, Check& check) {
  const TravelSettings usual;
  const bool free_of_corners = t.z_seam_type == SeamType::random || t.z_seam_type == SeamType::shortest;
  check.without_effect(t.z_seam_x != 0 && t.z_seam_type != SeamType::user, "z_seam_x", "z_seam_type is not user");
  check.without_effect(t.z_seam_y != 0 && t.z_seam_type != SeamType::user, "z_seam_y", "z_seam_type is not user");
  check.without_effect(free_of_corners && t.z_seam_corner != usual.z_seam_corner, "z_seam_corner",
                       "seams that are random or shortest look at no corners");
  check.without_effect(t.z_seam_corner == SeamCorner::none && t.z_seam_corner_weight != usual.z_seam_corner_weight,
                       "z_seam_corner_weight", "z_seam_corner is none");
  check.without_effect(t.staggered_inner_seams && t.z_seam_type == SeamType::shortest, "staggered_inner_seams",
                       "with z_seam_type = shortest every wall begins where it is nearest");
  const bool scarf = t.scarf_joint_seam_length > 0;
  check.without_effect(!scarf && t.scarf_joint_seam_start_height_ratio != usual.scarf_joint_seam_start_height_ratio,
                       "scarf_joint_seam_start_height_ratio", "scarf_joint_seam_length is 0");
  check.without_effect(!scarf && t.scarf_split_distance != usual.scarf_split_distance, "scarf_split_distance",
                       "scarf_joint_seam_length is 0");
  check.without_effect(!scarf && t.scarf_joint_inner_walls, "scarf_joint_inner_walls", "scarf_joint_seam_length is 0");
  check.without_effect(scarf && t.seam_gap_distance != usual.seam_gap_distance, "seam_gap_distance",
                       "a scarf seam (scarf_joint_seam_length) has no gap");
  check.without_effect(scarf && t.scarf_joint_seam_start_height_ratio == 100, "scarf_joint_seam_length",
                       "a ramp that begins at 100 % of the layer height is none");
  check.without_effect(!t.coasting_enable && t.coasting_volume != usual.coasting_volume, "coasting_volume",
                       "coasting_enable is off");
}

void check_retraction(const TravelSettings& t, const RetractionSettings& r, Check& check) {
  const RetractionSettings usual;
  check.without_effect(r.wipe && r.firmware_retraction, "wipe",
                       "with firmware_retraction the firmware draws the filament back at once");
  check.without_effect(!r.wipe && r.wipe_distance != usual.wipe_distance, "wipe_distance", "wipe is off");
  check.without_effect(!r.wipe && r.retract_before_wipe != usual.retract_before_wipe, "retract_before_wipe",
                       "wipe is off");
  check.without_effect(r.firmware_retraction && r.retraction_amount != usual.retraction_amount, "retraction_amount",
                       "with firmware_retraction the firmware knows the length");
  check.without_effect(!r.retraction_enable && r.retraction_hop > 0, "retraction_hop",
                       "lifts go with retractions, and retraction_enable is off");
  check.without_effect(!r.retraction_enable && t.coasting_enable, "coasting_enable",
                       "beads are cut short before retractions only, and retraction_enable is off");
  check.without_effect(!r.retraction_enable && r.wipe, "wipe", "retraction_enable is off");
  check.without_effect(!r.retraction_enable && r.retract_at_layer_change, "retract_at_layer_change",
                       "retraction_enable is off");
  check.without_effect(r.retraction_hop == 0 && r.retraction_hop_type != usual.retraction_hop_type,
                       "retraction_hop_type", "retraction_hop is 0");
  check.without_effect(!r.retraction_count_max && r.retraction_extrusion_window != usual.retraction_extrusion_window,
                       "retraction_extrusion_window", "retraction_count_max is auto");
  check.contradiction(
      r.retraction_hop_below && *r.retraction_hop_below < r.retraction_hop_above,
      fmt::format("retraction_hop_below ({:.3f} mm) is less than retraction_hop_above ({:.3f} mm): nothing is lifted",
                  to_mm(r.retraction_hop_below.value_or(0)), to_mm(r.retraction_hop_above)));
  check.contradiction(r.retraction_enable && !r.firmware_retraction && r.retraction_amount == 0,
                      "retraction_enable is on and retraction_amount is 0: no filament is drawn back");
  check.contradiction(r.retraction_count_max && *r.retraction_count_max == 0 && r.retraction_enable,
                      "retraction_enable is on and retraction_count_max is 0: travels cross walls unretracted");
}

}  // namespace

Notices check(const TravelSettings& settings, const RetractionSettings& retraction) {
  Check check;
  check_combing(settings, retraction, check);
  check_seams(settings, check);
  check_retraction(settings, retraction, check);
  return std::move(check.notices);
}

Notices notices_of(std::span<const Routed> layers) {
  Departures all;
  for (const auto& layer : layers)
    for (const auto kind : {&Departures::sloped, &Departures::vertical, &Departures::lowered, &Departures::outside,
                            &Departures::unretracted}) {
      const auto& one = layer.departures.*kind;
      if (one.count == 0) continue;
      if ((all.*kind).count == 0) (all.*kind).first = one.first;
      (all.*kind).count += one.count;
    }
  Notices notices;
  const auto say = [&](const Departures::Kind& kind, std::string code, std::string_view what) {
    if (kind.count > 0)
      notices.push_back({std::move(code), fmt::format("{} {}, first at {}", kind.count, what, place(kind.first))});
  };
  say(all.sloped, "lift_gave_way", "lifts on a circle would have left what the nozzle can reach and became slopes");
  say(all.vertical, "lift_gave_way", "lifts had no room for a circle or a slope and became vertical");
  say(all.lowered, "lift_gave_way", "lifts were made less high than retraction_hop: machine_reach_z_max is above them");
  say(all.outside, "travel_outside_reach",
      "travels leave what the nozzle can reach, or enter bed_exclude_areas: no way inside was found");
  say(all.unretracted, "crossed_unretracted", "travels cross a wall unretracted: retraction_count_max was reached");
  return notices;
}

}  // namespace weft::travel
