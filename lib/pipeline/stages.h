// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "gcode/digest.h"
#include "mesh/mesh.h"
#include "model/layer.h"
#include "model/plan.h"
#include "model/statistics.h"
#include "pipeline/pipeline.h"

#include <string>
#include <vector>

/// The stages run over all layers of a plate, side by side.
namespace weft::pipeline {

/// A model on the bed: sliced once, printed at each offset.
struct PlacedObject {
  std::string name;
  Mesh mesh;                   ///< where its first copy stands, on z = 0; empty once it is sliced
  Ring hull;                   ///< of the mesh, seen from above
  std::vector<Point> offsets;  ///< one a copy, the first is usually {0, 0}
};

/// One layer of one object, in the coordinates of its first copy.
struct PrintedLayer {
  Um z = 0, height = 0;
  Regions outline;  ///< of the slice
  Regions skin;     ///< top, bottom and other solid fill
  Regions top;      ///< seen from above
  Regions sparse;
  Beads beads;  ///< walls of each part in the order they are printed, then fills
};
using PrintedLayers = std::vector<PrintedLayer>;

/// Slice, walls, shells and infill of one object.
/// @param cache may be null
PrintedLayers print_object(const Settings& settings, const PlacedObject& object, const Watch& watch, Report& report,
                           StageCache* cache);

/// A plan of which each layer's steps wait as bytes (codec.h), which take a third of the memory.
struct PlannedPlate {
  PrintPlan plan;                   ///< without steps
  std::vector<std::string> packed;  ///< the layers, with them
  std::vector<gcode::LayerDigest> digests;
  Statistics statistics;
};

/// The whole plate as steps: copies put in their places, adhesion around them, order, seams and travels, speeds and
/// times.
/// @param sequence of the copies, numbered object by object
PlannedPlate plan_plate(const Settings& settings, const std::vector<PlacedObject>& objects, const Sequence& sequence,
                        std::vector<PrintedLayers> layers, Report& report);

}  // namespace weft::pipeline
