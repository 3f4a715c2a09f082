#pragma once
#include "core/notice.h"
#include "model/bead.h"
#include "settings/cost.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace weft {

/// What a job did, in numbers: the JSON report of `weft slice` (its fields are part of the contract with users).
struct Report {
  enum class Status { ok, rejected, failed };

  struct Model {
    std::string file, sha256;
    std::size_t triangles = 0;
    double volume_mm3 = 0;
    std::vector<std::string> repairs;
  };
  struct Feature {
    double mm = 0, mm3 = 0, s = 0;
  };
  struct Walls {
    std::size_t beads = 0;
    double variable_width_mm = 0, flow_compensated_mm = 0, min_flow_ratio = 1, min_width_mm = 0;
  };
  struct Travel {
    double mm = 0;
    std::size_t moves = 0, retractions = 0, wall_crossings = 0;
  };
  struct Violation {
    std::string move, feature, side, object, line_text;
    std::array<double, 3> at_mm{};
    double outside_mm = 0;
    int layer = 0;
    std::size_t line = 0;
  };
  struct Audit {
    std::string verdict;  ///< "pass", "annotated", "rejected"; empty when the job did not get that far
    std::size_t checked_moves = 0, not_audited = 0, violation_count = 0;
    std::vector<Violation> violations;
  };
  /// Wall-clock time of a stage, ms. The audit reads layers while others are written: its time counts in gcode, too.
  struct Timings {
    double read = 0, slice = 0, walls = 0, infill = 0, travel = 0, gcode = 0, audit = 0, total = 0;
  };

  Status status = Status::failed;
  std::string error;  ///< why it failed or was rejected, as on standard error
  std::vector<Model> models;
  std::string settings_sha256, gcode_sha256;  ///< of the G-code: "" when not asked for (Job), or there is none
  std::size_t layers = 0;
  double height_mm = 0, print_time_s = 0;
  double filament_mm = 0, filament_mm3 = 0, filament_g = 0;
  std::optional<Cost> cost;  ///< when there are prices
  std::string currency;
  std::array<Feature, role_names.size()> features{};
  Walls walls;
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
