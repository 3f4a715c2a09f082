// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/notice.h"
#include "model/bead.h"
#include "pipeline/figures.h"
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

  /// A way in which a model could be laid, and what it would ask for.
  struct Orientation {
    std::array<double, 3> down{0, 0, -1};     ///< the direction of the model that comes to point down
    double support_mm3 = 0;                   ///< of columns, as if they were solid
    double contact_mm2 = 0, on_part_mm2 = 0;  ///< support under the part, and on it
    double height_mm = 0, foot_mm2 = 0;
    double cost_mm3 = 0;  ///< of all that together: less is better
  };
  struct Model {
    std::string file, sha256;
    std::size_t triangles = 0;
    double volume_mm3 = 0;
    std::vector<std::string> repairs;
    /// One file of it, and the tool that is named behind it.
    struct Part {
      std::string file, sha256;
      std::optional<int> tool;
    };
    std::vector<Part> parts{};                ///< empty: one file, of which no tool is named
    std::vector<std::string> transforms{};    ///< what was done with it before it was placed, in words
    std::vector<Orientation> orientations{};  ///< the best that were found, best first, where it was to be laid
  };
  /// What was laid beside a model: for support, to modify it, to cut it.
  struct Mark {
    std::size_t model = 0;       ///< its place in the list of models
    std::string kind;            ///< support_enforcer, support_blocker, support_mesh, modifier, negative
    std::string source, sha256;  ///< a file and what it held, or `box:…` and nothing
    std::vector<std::pair<std::string, std::string>> settings{};  ///< of a modifier
  };
  /// A file that infill is laid by.
  struct InfillFile {
    std::string key, file, sha256;
  };
  /// How many of what stand on a plate.
  struct OnPlate {
    std::string file;
    std::size_t copies = 0;
  };
  /// A copy on the bed.
  struct Standing {
    std::string name;
    std::array<double, 2> at_mm{}, size_mm{};                     ///< the middle of its box, and that
    std::vector<std::pair<std::string, std::string>> settings{};  ///< of its own: key and value
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
    double s = 0;             ///< while it is loaded
    double cost = 0;          ///< of its filament, where there are prices
    double tower_mm3 = 0;     ///< of that volume, what went into the tower
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
    double trapped_mm3 = 0;                                ///< plastic that no tool gets to
    std::size_t layers = 0;                                ///< that are printed under objects
  };
  /// Of the object with most sparse infill; bounds are shares of the plastic's own (infill/figures.h).
  struct Infill {
    std::string pattern;
    double mm3 = 0, density_percent = 0, density_spread_percent = 0;  ///< the spread between layers
    double length_spread_percent = 0;                                 ///< of lines in a layer's room
    std::array<double, 3> fabric{};                                   ///< h₂, h₄, h₆ of directions
    double over_air_percent = 0;                                      ///< of the length
    double locality = 0, box_dimension = 0;
    double stiffness_plane_percent = 0, stiffness_z_percent = 0;
    double conductivity_plane_percent = 0, conductivity_z_percent = 0;
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
  std::vector<InfillFile> infill_files;
  std::vector<std::vector<OnPlate>> plates{};  ///< of a job that is arranged: what stands on each of its plates
  int plate = 0;                               ///< and which of them this is, from 1
  std::vector<Standing> objects{};             ///< as they are labelled
  std::string settings_sha256, gcode_sha256;   ///< of the G-code: "" when not asked for (Job), or there is none
  std::size_t layers = 0;
  double height_mm = 0, print_time_s = 0;
  double filament_mm = 0, filament_mm3 = 0, filament_g = 0;
  std::optional<Cost> cost;  ///< when there are prices
  std::string currency;
  std::array<Feature, roles.size()> features{};
  std::vector<Tool> tools;  ///< by number, T0 first; empty where the plan names none
  /// What is purged at changes of the tool: wanted (purge_volumes, or by colour), and of that into what is printed.
  struct Purged {
    double wanted_mm3 = 0, objects_mm3 = 0, support_mm3 = 0, infill_mm3 = 0;
  };
  Purged purged;
  Walls walls;
  Arcs arcs;
  /// The travels of a layer in their order, and a bound that no order could go below.
  struct Tour {
    double mm = 0, least_mm = 0;
  };
  std::optional<Figures> figures;          ///< where they are asked for: put empty ones there
  std::optional<std::vector<Tour>> tours;  ///< one a layer, where they are asked for: put an empty list there
  Support support;
  Infill infill;
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
