// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "contour/surface.h"
#include "core/polygon.h"
#include "gcode/digest.h"
#include "model/layer.h"
#include "model/plan.h"
#include "model/statistics.h"
#include "pipeline/object_scopes.h"
#include "pipeline/pipeline.h"
#include "plate/plate.h"
#include "settings/scopes.h"

#include <string>
#include <utility>
#include <vector>

/// The stages run over all layers of a plate, side by side.
namespace weft::pipeline {

struct Running;
struct SupportOf;

/// One layer of one object, in the coordinates of its first copy.
struct PrintedLayer {
  Um z = 0, height = 0;
  Regions outline;  ///< of the slice
  Regions skin;     ///< top, bottom and other solid fill
  Regions top;      ///< seen from above
  Regions sparse;
  Regions over_air;  ///< nothing lies below
  Beads beads;       ///< walls of each part in the order they are printed, then fills
};
using PrintedLayers = std::vector<PrintedLayer>;

/// Slice, walls, shells and infill of one object.
/// @param scopes those of the object (object_scopes.h), all of which are among `all`
/// @param support what stands under it (support_object.h): its room is given, the rest is made
PrintedLayers print_object(const Running& job, const Scopes& all, const ToolScopes& tools, const ObjectScopes& scopes,
                           const Object& object, SupportOf& support);

/// A plan of which each layer's steps wait as bytes (codec.h), which take a third of the memory.
struct PlannedPlate {
  PrintPlan plan;                   ///< without steps
  std::vector<std::string> packed;  ///< the layers, with them
  std::vector<gcode::LayerDigest> digests;
  Statistics statistics;
  struct Layer {
    Statistics statistics;
    bool bottom = false;  ///< of an object, whose lowest layers stand for themselves in an estimate
  };
  std::vector<Layer> layers;  ///< for figures only
  /// Of each layer: what nozzles are told before the step of that number, ascending. Empty where there is one tool.
  std::vector<std::vector<std::pair<std::size_t, SetTemperature>>> heat;
  std::vector<ToolId> cold_at_start;  ///< nozzles that are heated later
  Report::Purged purged;              ///< at changes of the tool
};

/// What a plan is for: to be written, or for its figures only.
enum class PlanFor { writing, figures };
struct PlanOptions {
  PlanFor use = PlanFor::writing;
  std::vector<ScopeId> feet{};  ///< of each object of the plate: the settings of what it stands on, as its brim
  bool annotate = false;        ///< what is wrong with it is told, and does not end the job
  std::vector<contour::Surface> surfaces{};  ///< of each object, where layers follow them; empty: nowhere
};

/// The whole plate as steps: copies put in their places, adhesion around them, order, seams and travels, speeds and
/// times.
/// @param sequence of the copies, numbered object by object
/// @param supports of each object
/// @param tools which print it
/// @param scopes 0 is the plate's own; its first layer's is added
PlannedPlate plan_plate(Scopes& scopes, ToolScopes& tools, const Plate& plate, const Sequence& sequence,
                        std::vector<PrintedLayers> layers, std::vector<SupportOf> supports, Report& report,
                        const PlanOptions& options = {});

}  // namespace weft::pipeline
