// SPDX-License-Identifier: GPL-3.0-or-later
#include "travel/travel.h"

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::travel;
using Catch::Matchers::StartsWith;

namespace {

struct Case {
  std::string says;
  void (*set)(TravelSettings&, RetractionSettings&);
};

}  // namespace

TEST_CASE("travel: settings as they come have nothing to be said about", "[travel]") {
  CHECK(check({}, {}).empty());
}

TEST_CASE("travel: each setting that cannot matter, or contradicts another, is named once", "[travel]") {
  const Case c = GENERATE(
      Case{"retraction_combing_offset has no effect",
           [](TravelSettings& t, RetractionSettings&) {
             t.retraction_combing_offset = 400, t.retraction_combing = Combing::noskin;
           }},
      Case{"retraction_combing_max_distance has no effect",
           [](TravelSettings& t, RetractionSettings&) {
             t.retraction_combing_max_distance = 9000, t.retraction_combing = Combing::off;
           }},
      Case{"retraction_combing_max_distance_wall_0 has no effect: retraction_combing is off",
           [](TravelSettings& t, RetractionSettings&) {
             t.retraction_combing_max_distance_wall_0 = 9000, t.retraction_combing = Combing::off;
           }},
      Case{"retraction_combing_max_distance_wall_0 has no effect: retraction_combing_max_distance,",
           [](TravelSettings& t, RetractionSettings&) {
             t.retraction_combing_max_distance_wall_0 = 9000, t.retraction_combing_max_distance = 8000;
           }},
      Case{"retraction_combing_max_detour has no effect",
           [](TravelSettings& t, RetractionSettings&) {
             t.retraction_combing_max_detour = length(9000), t.retraction_combing = Combing::off;
           }},
      Case{"travel_avoid_distance has no effect",
           [](TravelSettings& t, RetractionSettings&) {
             t.travel_avoid_supports = false, t.travel_avoid_distance = 2000;
           }},
      Case{"retraction_combing_max_distance (0.500 mm) is less",
           [](TravelSettings& t, RetractionSettings&) { t.retraction_combing_max_distance = 500; }},
      Case{"z_seam_x has no effect", [](TravelSettings& t, RetractionSettings&) { t.z_seam_x = 1000; }},
      Case{"z_seam_corner has no effect",
           [](TravelSettings& t, RetractionSettings&) {
             t.z_seam_type = SeamType::random, t.z_seam_corner = SeamCorner::outer;
           }},
      Case{"z_seam_corner_weight has no effect",
           [](TravelSettings& t, RetractionSettings&) {
             t.z_seam_corner = SeamCorner::none, t.z_seam_corner_weight = 2;
           }},
      Case{"staggered_inner_seams has no effect",
           [](TravelSettings& t, RetractionSettings&) {
             t.z_seam_type = SeamType::shortest, t.staggered_inner_seams = true;
           }},
      Case{"scarf_joint_seam_start_height_ratio has no effect",
           [](TravelSettings& t, RetractionSettings&) { t.scarf_joint_seam_start_height_ratio = 50; }},
      Case{"scarf_split_distance has no effect",
           [](TravelSettings& t, RetractionSettings&) { t.scarf_split_distance = 500; }},
      Case{"seam_gap_distance has no effect",
           [](TravelSettings& t, RetractionSettings&) {
             t.scarf_joint_seam_length = 10000, t.seam_gap_distance = length(100);
           }},
      Case{"scarf_joint_seam_length has no effect",
           [](TravelSettings& t, RetractionSettings&) {
             t.scarf_joint_seam_length = 10000, t.scarf_joint_seam_start_height_ratio = 100;
           }},
      Case{"coasting_volume has no effect", [](TravelSettings& t, RetractionSettings&) { t.coasting_volume = 0.1; }},
      Case{"wipe has no effect: with firmware",
           [](TravelSettings&, RetractionSettings& r) { r.wipe = r.firmware_retraction = true; }},
      Case{"wipe_distance has no effect", [](TravelSettings&, RetractionSettings& r) { r.wipe_distance = 3000; }},
      Case{"retract_before_wipe has no effect",
           [](TravelSettings&, RetractionSettings& r) { r.retract_before_wipe = 70; }},
      Case{"retraction_amount has no effect",
           [](TravelSettings&, RetractionSettings& r) { r.firmware_retraction = true, r.retraction_amount = 2000; }},
      Case{"retraction_hop has no effect",
           [](TravelSettings&, RetractionSettings& r) { r.retraction_enable = false, r.retraction_hop = 400; }},
      Case{"coasting_enable has no effect",
           [](TravelSettings& t, RetractionSettings& r) { r.retraction_enable = false, t.coasting_enable = true; }},
      Case{"wipe has no effect: retraction_enable",
           [](TravelSettings&, RetractionSettings& r) { r.retraction_enable = false, r.wipe = true; }},
      Case{"retract_at_layer_change has no effect",
           [](TravelSettings&, RetractionSettings& r) {
             r.retraction_enable = false, r.retract_at_layer_change = true;
           }},
      Case{"retraction_hop_type has no effect",
           [](TravelSettings&, RetractionSettings& r) { r.retraction_hop_type = HopType::spiral; }},
      Case{"retraction_extrusion_window has no effect",
           [](TravelSettings&, RetractionSettings& r) { r.retraction_extrusion_window = 2000; }},
      Case{"retraction_hop_below (1.000 mm) is less",
           [](TravelSettings&, RetractionSettings& r) {
             r.retraction_hop = 400, r.retraction_hop_above = 2000, r.retraction_hop_below = 1000;
           }},
      Case{"retraction_enable is on and retraction_amount is 0",
           [](TravelSettings&, RetractionSettings& r) { r.retraction_amount = 0; }},
      Case{"retraction_enable is on and retraction_count_max is 0",
           [](TravelSettings&, RetractionSettings& r) { r.retraction_count_max = 0; }});
  TravelSettings travel;
  RetractionSettings retraction;
  c.set(travel, retraction);
  const auto notices = check(travel, retraction);
  INFO(c.says);
  REQUIRE(notices.size() == 1);
  CHECK_THAT(notices[0].message, StartsWith(c.says));
}
