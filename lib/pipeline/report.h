// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/notice.h"
#include "model/bead.h"
#include "pipeline/timings.h"
#include "settings/cost.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace weft {

/// What a job did, in numbers: the JSON report of `weft slice` (its fields are part of the contract with users).
struct Report {
  /// annotated: written although the audit found something, as it was asked for.
  enum class Status { ok, rejected, failed, annotated };

  struct Model {
    std::string file, sha256;
    std::size_t triangles = 0;
    double volume_mm3 = 0;
    std::vector<std::string> repairs;
  };
  /// What was laid beside a model for support.
  struct Mark {
    std::size_t model = 0;       ///< its place in the list of models
    std::string kind;            ///< support_enforcer, support_blocker, support_mesh
    std::string source, sha256;  ///< a file and what it held, or `box:…` and nothing
  };
  struct Feature {
    double mm = 0, mm3 = 0, s = 0;
  };
  struct Walls {
    std::size_t beads = 0;
    double variable_width_mm = 0, flow_compensated_mm = 0, min_flow_ratio = 1, min_width_mm = 0;
    /// Length by how much of the width lies over air: more than a tenth, a quarter, a half, three quarters of it.
    std::array<double, 4> over_air_mm{};
    double whole_over_air_mm = 0;  ///< of the last of them: with all of it
  };
  struct Arcs {
    std::size_t count = 0, pieces = 0;  ///< and the pieces of paths that they stand for
    double worst_um = 0;                ///< how far one of these is from its arc
  };
  struct Tool {
    double filament_mm = 0, filament_mm3 = 0, filament_g = 0;
    std::size_t changes = 0;  ///< to it
  };
  struct Travel {
    double mm = 0;
    std::size_t moves = 0, retractions = 0, wall_crossings = 0;
  };
  struct Support {
    double needed_mm2 = 0, bridged_mm2 = 0, left_mm2 = 0;  ///< of overhang: all, crossed by strands, out of reach
    double contact_mm2 = 0, on_part_mm2 = 0;               ///< right below the part; what stands on it
    std::size_t islands = 0;                               ///< places that begin in the air
    std::size_t tips = 0, trunks = 0;                      ///< of branches: where they begin, and on what they stand
    double slenderest = 0;                                 ///< of trunks: height by width
  };
  struct Violation {
    std::string move, feature, side, object, line_text, setting;  ///< setting: the custom G-code it came from, or ""
    std::array<double, 3> at_mm{};
    double outside_mm = 0;
    int layer = 0;
    std::size_t line = 0;
  };
  struct Gap {
    std::string command, why;
    std::size_t line = 0, moves = 0;
  };
  struct Audit {
    std::string verdict;  ///< "pass", "annotated", "rejected", "unaudited"; empty when the job did not get that far
    std::string summary;  ///< in words
    std::size_t checked_moves = 0, not_audited = 0, violation_count = 0;
    std::vector<Violation> violations;
    std::vector<std::pair<std::string, double>> reach_beyond_mm;  ///< of the print surface, by side
    std::vector<Gap> gaps;                                        ///< why moves were not audited
    std::vector<std::string> opaque;                              ///< macros that only the printer knows
  };
  Status status = Status::failed;
  std::string error;  ///< why it failed or was rejected, as on standard error
  std::vector<Model> models;
  std::vector<Mark> marks;
  std::string settings_sha256, gcode_sha256;  ///< of the G-code: "" when not asked for (Job), or there is none
  std::size_t layers = 0;
  double height_mm = 0, print_time_s = 0;
  double filament_mm = 0, filament_mm3 = 0, filament_g = 0;
  std::optional<Cost> cost;  ///< when there are prices
  std::string currency;
  std::array<Feature, roles.size()> features{};
  std::vector<Tool> tools;  ///< by number, T0 first; empty where the plan names none
  Walls walls;
  Arcs arcs;
  /// The travels of a layer in their order, and a bound that no order could go below.
  struct Tour {
    double mm = 0, least_mm = 0;
  };
  std::optional<std::vector<Tour>> tours;  ///< one a layer, where they are asked for: put an empty list there
  Support support;
  Travel travel;
  Audit audit;
  Notices warnings;
  Timings timings_ms;
  double peak_memory_mb = 0;
};

/// The report as JSON, UTF-8, ending in a newline. Times and memory apart, equal jobs give equal text.
std::string to_json(const Report& report);

/// Peak resident memory of this process so far, MB.
double peak_memory_mb();

}  // namespace weft
