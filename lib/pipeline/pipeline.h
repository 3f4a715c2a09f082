// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "audit/audit.h"
#include "cache/stage_cache.h"
#include "mesh/mark.h"
#include "mesh/mesh.h"
#include "model/sequence.h"
#include "pipeline/report.h"
#include "pipeline/write_gcode.h"
#include "plate/by_name.h"
#include "plate/plate.h"
#include "settings/settings.h"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace weft {

/// Which way a model is laid.
struct Orientation {
  bool automatic = true;         ///< so that it wants least support
  std::array<double, 3> face{};  ///< else the direction that comes to point down; not 0
  friend bool operator==(const Orientation&, const Orientation&) = default;
};

enum class CutKeep { both, lower, upper };

/// What is done with models before they are placed, beside Placement::scale and rotate_deg, in this order.
struct Transform {
  double mm_per_unit = 1;                     ///< of files that do not say
  std::array<double, 3> stretch{1, 1, 1};     ///< along the file's axes, beside the scale; 0 < each <= 1
  std::array<bool, 3> mirror{};               ///< along X, Y, Z
  double rotate_x_deg = 0, rotate_y_deg = 0;  ///< about X, then Y; then the orientation, then rotate_deg
  std::optional<Orientation> orient{};
  std::optional<std::array<double, 3>> fit_mm{};  ///< as large as it can be in a box of that size
  std::optional<Um> cut{};                        ///< height above its lowest point
  CutKeep keep = CutKeep::both;
  bool split = false;  ///< each body that touches no other is an object of its own
  bool merge = false;  ///< all models are parts of one object
  friend bool operator==(const Transform&, const Transform&) = default;
};

/// Where the models go on the bed.
struct Placement {
  std::optional<Point> centre;  ///< of the models' common box; absent: the centre of the bed
  bool keep_position = false;   ///< the file's coordinates stay
  bool drop = false;            ///< … but what floats or dips is put down on the bed
  double scale = 1.0;
  double rotate_deg = 0.0;  ///< about Z, counter-clockwise
  int copies = 1;
  Um spacing = 6000;     ///< between copies and models
  bool arrange = false;  ///< close together, by their true outlines
  bool fill = false;     ///< the same, with as many copies of each as there is room for
  bool plates = false;   ///< close together as well, on as many plates as it takes: one is printed, on_plate
  int on_plate = 1;      ///< of these, from 1
  double turn_deg = 45;  ///< where things are put close together they may be turned by multiples of it; 0: not at all
  int plate = 0;         ///< of projects of several plates, the one that is printed, from 1; 0: they have one
  Transform transform{};

  /// Are models put close together by their true outlines?
  bool by_outlines() const { return arrange || fill || plates; }
};

/// A file, or a box, that marks something of a model: `box:x,y,z,x,y,z` in mm, two opposite corners.
struct ModelMark {
  std::size_t model = 0;  ///< index into Job::models, in whose coordinates it is
  mesh::MarkKind kind = mesh::MarkKind::support_enforcer;
  std::string source;                                           ///< as typed
  std::vector<std::pair<std::string, std::string>> settings{};  ///< of a modifier: what holds in it
};

/// Everything a slice depends on: two equal jobs give equal bytes.
struct Job {
  std::vector<std::string> models;  ///< paths as typed
  Settings settings;
  Placement placement;
  std::vector<ModelMark> marks{};
  ByName by_name{};
  audit::Mode audit = audit::Mode::reject;
  unsigned threads = 0;    ///< 0: all cores. The result does not depend on it
  bool hash_gcode = true;  ///< whether the report is to hold the SHA-256 of the G-code
};

/// How a caller watches a job and stops it.
struct Watch {
  std::function<void(std::string_view stage, double share)> progress = [](std::string_view, double) {};
  std::function<bool()> cancelled = [] { return false; };  ///< asked often, also within a layer, from any thread
};

/// The whole program: reads, places, slices, plans, writes and audits.
/// @param cache   null: everything is computed. Results are the same with one
/// @param report  is filled as the job goes on, so that a caller has what was known when an Error ended it
/// @return the G-code, or nothing when the audit rejected it; report.status and report.error say so
/// @throws Error of any other kind
std::optional<audit::Passed> run(const Job& job, const Watch& watch, Report& report, StageCache* cache = nullptr);

/// How many plates a job takes (Placement::plates): its models are read and arranged, and no more.
/// @throws Error as `run` before it slices
std::size_t plates_of(const Job& job, const Watch& watch = {}, StageCache* cache = nullptr);

/// The same of a plate that is there already: objects in their places, each volume's mesh on z = 0, with overlays of
/// their own. Of the job the models and their placement are not looked at.
/// @param sequence of the copies, numbered object by object; empty: all of them layer by layer
std::optional<audit::Passed> run(const Job& job, Plate plate, const Sequence& sequence, const Watch& watch,
                                 Report& report, StageCache* cache = nullptr);

}  // namespace weft
