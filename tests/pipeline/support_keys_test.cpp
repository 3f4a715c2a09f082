// SPDX-License-Identifier: GPL-3.0-or-later
#include "model_of_boxes.h"
#include "pipeline/pipeline.h"
#include "settings/catalogue.h"

#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

using namespace weft;
using weft::test::Corners;
using Model = weft::test::ModelOfBoxes;

namespace {

/// What a row is tried on.
enum class On { tee, over, bridge, stairs, slope, tiny, fork, corner };

std::vector<Corners> boxes_of(On on) {
  std::vector<Corners> out;
  switch (on) {
    case On::tee:
      return {{-2, -2, 0, 2, 2, 8}, {-10, -7, 8, 10, 7, 9}};
    case On::over:
      return {{-14, -10, 0, 14, 10, 1.1}, {-2, -2, 1.1, 2, 2, 8}, {-10, -7, 8, 10, 7, 9}};
    case On::bridge:
      return {{-8, -4, 0, -5, 4, 4}, {5, -4, 0, 8, 4, 4}, {-8, -4, 4, 8, 4, 5}};
    case On::stairs:  // a slope below, which support stands on
      for (int i = 0; i < 20; ++i) out.push_back({-10, -6, i * 0.2, 8 - i * 0.4, 6, (i + 1) * 0.2});
      out.push_back({-10, -6, 4, -8, 6, 8}), out.push_back({-10, -6, 8, 8, 6, 9});
      return out;
    case On::slope:  // above: 56° from the vertical
      for (int i = 0; i < 20; ++i) out.push_back({-3, -4, i * 0.2, 3 + i * 0.3, 4, (i + 1) * 0.2});
      return out;
    case On::tiny:
      return {{-6, -6, 0, 6, 6, 8}, {6, -0.7, 6, 7.5, 0.7, 8}};
    case On::fork:
      return {{-2, -8, 0, 2, 8, 6}, {-9, -8, 6, 9, -5, 7}, {-9, -2, 6, 9, 1, 7}, {-9, 4, 6, 9, 8, 7}};
    case On::corner:
      return {{-3, -3, 0, 3, 3, 2}, {5, -3, 0, 11, 3, 2}, {5, 3, 0, 11, 11, 2}};
  }
  return out;
}

struct Result {
  std::string gcode;
  Report report;
};

double volume(const Result& r, Role role) {
  return r.report.features[static_cast<std::size_t>(role)].mm3;
}
double length(const Result& r) {
  return r.report.features[static_cast<std::size_t>(Role::support)].mm;
}

/// What is compared.
double all_support(const Result& r) {
  return volume(r, Role::support) + volume(r, Role::support_interface);
}
double columns(const Result& r) {
  return volume(r, Role::support);
}
double interface(const Result& r) {
  return volume(r, Role::support_interface);
}
double needed(const Result& r) {
  return r.report.support.needed_mm2;
}
double contact(const Result& r) {
  return r.report.support.contact_mm2;
}
double on_part(const Result& r) {
  return r.report.support.on_part_mm2;
}
double tips(const Result& r) {
  return static_cast<double>(r.report.support.tips);
}
double slender(const Result& r) {
  return r.report.support.slenderest;
}
double layers(const Result& r) {
  return static_cast<double>(r.report.layers);
}
double height(const Result& r) {
  return r.report.height_mm;
}
double seconds(const Result& r) {
  return r.report.print_time_s;
}
double any(const Result&) {
  return 0;
}

enum class Becomes { less, more, other };

using Sets = std::vector<std::pair<std::string, std::string>>;

struct Row {
  std::string key, value;
  On on;
  double (*of)(const Result&);
  Becomes becomes;
  Sets besides{};  ///< in both
};

const Sets by_columns{{"support_enable", "true"}, {"support_structure", "normal"}};
const Sets by_branches{{"support_enable", "true"}, {"support_structure", "tree"}};
const Sets on_raft{{"adhesion_type", "raft"}};

Sets with(Sets sets, const Sets& more) {
  sets.insert(sets.end(), more.begin(), more.end());
  return sets;
}

std::vector<Row> rows() {
  using enum Becomes;
  const Sets c = by_columns, t = by_branches, r = on_raft;
  const Sets bare = with(t, {{"support_roof_enable", "false"}});
  return {
      {"support_enable", "true", On::tee, all_support, more},
      {"support_auto", "false", On::tee, all_support, less, c},
      {"support_structure", "tree", On::tee, tips, more, c},
      {"support_structure", "hybrid", On::fork, tips, less, by_branches},
      {"support_normal_shape", "grid", On::tee, columns, more, c},
      {"support_type", "buildplate", On::over, on_part, less, c},
      {"support_angle", "80", On::slope, needed, less, c},
      {"support_bridges", "true", On::bridge, needed, more, c},
      {"support_max_bridge_length", "3", On::bridge, needed, more, c},
      {"support_cantilever_length", "100", On::tiny, needed, less,
       with(c, {{"minimum_support_area", "9000"}, {"support_cantilever_length", "1"}})},
      {"minimum_support_area", "9000", On::tiny, needed, less, with(c, {{"support_cantilever_length", "100"}})},
      {"support_enforce_layers", "1000", On::tee, all_support, more},
      {"support_z_distance", "0.6", On::over, all_support, less, c},
      {"support_top_distance", "0.6", On::tee, all_support, less, with(c, {{"gradual_support_infill_steps", "0"}})},
      {"support_bottom_distance", "0.8", On::over, all_support, less, c},
      {"support_xy_distance", "3", On::tee, all_support, less, c},
      {"support_xy_distance_overhang", "0.6", On::tee, contact, less, c},
      {"support_xy_overrides_z", "true", On::tee, contact, less, c},
      {"support_bottom_stair_step_height", "1", On::stairs, all_support, less, c},
      {"support_bottom_stair_step_width", "0.3", On::stairs, all_support, more,
       with(c, {{"support_bottom_stair_step_height", "1"}})},
      {"support_synchronize_layers", "true", On::tee, layers, less, with(c, {{"support_top_distance", "0.13"}})},
      {"support_infill_sparse_thickness", "0.1", On::tee, layers, more, c},
      {"support_line_width", "0.8", On::tee, length, less, c},
      {"support_wall_count", "2", On::tee, columns, more, c},
      {"support_pattern", "lines", On::tee, any, other, c},
      {"support_pattern", "grid", On::tee, any, other, c},
      {"support_pattern", "triangles", On::tee, any, other, c},
      {"support_pattern", "concentric", On::tee, any, other, c},
      {"support_pattern", "gyroid", On::tee, any, other, c},
      {"support_infill_rate", "40", On::tee, columns, more, c},
      {"support_infill_angle", "45", On::tee, any, other, c},
      {"gradual_support_infill_steps", "0", On::tee, columns, more, c},
      {"gradual_support_infill_step_height", "6", On::tee, columns, more, c},
      {"support_join_distance", "8", On::fork, columns, more, c},
      {"support_initial_layer_density", "30", On::tee, columns, less, c},
      {"support_brim_width", "0", On::tee, columns, less, c},
      {"support_roof_enable", "false", On::tee, interface, less, c},
      {"support_bottom_enable", "true", On::over, interface, more, c},
      {"support_roof_height", "1.2", On::tee, interface, more, c},
      {"support_bottom_height", "1.6", On::over, interface, more, with(c, {{"support_bottom_enable", "true"}})},
      {"support_interface_density", "50", On::tee, interface, less, c},
      {"support_interface_pattern", "concentric", On::tee, any, other, with(c, {{"support_interface_density", "50"}})},
      {"support_roof_wall_count", "2", On::tee, any, other, c},
      {"support_conical_enabled", "true", On::tee, columns, less, with(c, {{"gradual_support_infill_steps", "0"}})},
      {"support_conical_angle", "5", On::tee, columns, more, with(c, {{"support_conical_enabled", "true"}})},
      {"support_conical_min_width", "15", On::tee, columns, more, with(c, {{"support_conical_enabled", "true"}})},
      {"support_use_towers", "true", On::tiny, columns, more, with(c, {{"support_roof_enable", "false"}})},
      {"support_tower_diameter", "5", On::tiny, columns, more, with(c, {{"support_use_towers", "true"}})},
      {"support_tower_maximum_supported_diameter", "1", On::tiny, columns, less,
       with(c, {{"support_use_towers", "true"}})},
      {"support_tower_roof_angle", "85", On::tiny, columns, less, with(c, {{"support_use_towers", "true"}})},
      {"support_tree_style", "strong", On::tee, columns, more, t},
      {"support_tree_angle", "10", On::tee, any, other, t},
      {"support_tree_angle_slow", "10", On::tee, any, other, t},
      {"support_tree_branch_diameter", "4", On::tee, columns, more, t},
      {"support_tree_branch_diameter_angle", "20", On::tee, columns, more, t},
      {"support_tree_branch_diameter_double_wall", "0.5", On::tee, columns, more, t},
      {"support_tree_tip_diameter", "1.8", On::tee, any, other, t},
      {"support_tree_branch_distance", "4", On::tee, tips, less, with(bare, {{"support_tree_top_rate", "100"}})},
      {"support_tree_top_rate", "2", On::tee, tips, less, bare},
      {"support_tree_infill_rate", "60", On::tee, columns, more, with(t, {{"support_tree_branch_diameter", "4"}})},
      {"support_tree_max_diameter", "1", On::tee, slender, more, t},
      {"support_tree_bp_diameter", "2", On::tee, columns, less, t},
      {"raft_surface_layers", "4", On::tee, layers, more, r},
      {"raft_interface_layers", "3", On::tee, layers, more, r},
      {"raft_airgap", "0.6", On::tee, height, more, r},
      {"raft_margin", "10", On::tee, all_support, more, r},
      {"raft_smoothing", "0", On::corner, all_support, less, with(r, {{"raft_margin", "1"}})},
      {"raft_base_thickness", "0.2", On::tee, height, less, r},
      {"raft_base_line_spacing", "2", On::tee, columns, less, r},
      {"raft_interface_thickness", "0.3", On::tee, height, more, r},
      {"raft_interface_line_spacing", "3", On::tee, columns, less, r},
      {"raft_surface_thickness", "0.3", On::tee, height, more, r},
      {"raft_surface_line_spacing", "2", On::tee, interface, less, r},
      {"raft_base_speed", "5", On::tee, seconds, more, r},
      {"raft_interface_speed", "5", On::tee, seconds, more, r},
      {"raft_surface_speed", "5", On::tee, seconds, more, r},
      {"speed_layer_0_over_raft", "5", On::tee, seconds, more, r},
      {"acceleration_layer_0_over_raft", "10", On::over, seconds, more, with(r, {{"acceleration_enabled", "true"}})},
      {"speed_support_infill", "10", On::tee, seconds, more, c},
      {"speed_support_interface", "10", On::tee, seconds, more, c},
      {"support_fan_enable", "true", On::tee, any, other, c},
      {"support_supported_skin_fan_speed", "50", On::tee, any, other, with(c, {{"support_fan_enable", "true"}})},
      {"support_interface_fan_speed", "0", On::tee, any, other, c},
  };
}

Result sliced(const Sets& sets, const Model& model) {
  Job job;
  job.models = {model.path()};
  job.audit = audit::Mode::annotate;
  job.settings.adhesion.skirt_line_count = 0;
  job.settings.cooling.cool_min_layer_time = 0;  // so that a layer takes what its moves take
  job.settings.cooling.cool_fan_speed_min = job.settings.cooling.cool_fan_speed_max = 70;
  for (const auto& [key, value] : sets) {
    const auto* entry = find_setting(key);
    REQUIRE(entry != nullptr);
    entry->parse(job.settings, value);
  }
  Result out;
  const auto gcode = run(job, {}, out.report);
  REQUIRE(gcode);
  // Settings stand in the file, too: what counts is what moves.
  std::string_view text = gcode->gcode();
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    if (!text.starts_with(';')) out.gcode.append(text.substr(0, end)).push_back('\n');
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return out;
}

}  // namespace

TEST_CASE("support: each setting of support and raft changes the print as its meaning says", "[support]") {
  std::map<On, Model> models;
  std::map<std::pair<On, Sets>, Result> without;
  for (const Row& row : rows()) {
    INFO(row.key << " = " << row.value);
    const Model& model = models.try_emplace(row.on, boxes_of(row.on)).first->second;
    const std::pair base{row.on, row.besides};
    if (without.count(base) == 0) without.emplace(base, sliced(row.besides, model));
    const Result& before = without.at(base);
    const Result after = sliced(with(row.besides, {{row.key, row.value}}), model);
    CHECK(before.gcode != after.gcode);
    const double was = row.of(before), is = row.of(after);
    if (row.becomes == Becomes::less) CHECK(is < 0.995 * was);
    if (row.becomes == Becomes::more) CHECK(is > 1.005 * was);
  }
}

TEST_CASE("support: no setting of support or raft is left without a row that shows what it does", "[support]") {
  // Shown where tools are many, with marks, and at the edge of the bed.
  std::set<std::string> shown{"support_infill_extruder_nr", "support_interface_extruder_nr", "support_blockers_avoided",
                              "support_outside"};
  for (const Row& row : rows()) shown.insert(row.key);
  for (const auto& entry : catalogue())
    if (entry.section == "support" || entry.section == "raft") CHECK(shown.count(std::string(entry.key)) == 1);
}

TEST_CASE("support: what hangs too near to the plate for a level of support gets none, whatever columns are",
          "[support]") {
  const Model model({{-4, -4, 0, 4, 4, 0.1}, {-8, -8, 0.1, 8, 8, 1}});
  const Sets near{{"support_enforce_layers", "2"}, {"layer_height", "0.08"}, {"initial_layer_height", "0.08"}};
  for (const Sets& widening : {Sets{},
                               {{"support_normal_shape", "grid"}},
                               {{"support_use_towers", "true"}},
                               {{"support_conical_enabled", "true"}, {"support_conical_angle", "-20"}}})
    for (const char* structure : {"normal", "tree", "hybrid"}) {
      CAPTURE(widening, structure);
      Sets sets = widening;
      sets.insert(sets.end(), near.begin(), near.end());
      sets.push_back({"support_structure", structure});
      CHECK(all_support(sliced(sets, model)) == 0);
    }
}
