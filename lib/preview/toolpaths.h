// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace weft::preview {

/// A straight piece of the nozzle's way; arcs are cut into such pieces.
struct Stroke {
  Point from, to;
  Um width =
      0;  ///< line width of the bead that the filament of this piece makes (model/flow.h); 0: nothing is extruded
  float speed_mm_s = 0;
  float flow_mm3_s = 0;
  std::uint8_t feature = 0;  ///< index into Toolpaths::features
  bool compensated = false;  ///< less filament than the width that the file announces (;WIDTH:) would take
  std::uint32_t line = 0;    ///< of the file, from 1

  bool extrudes() const { return width > 0; }
};

struct PathLayer {
  Um z = 0, height = 0;
  std::vector<Stroke> strokes;  ///< in the order of the file
};

/// How far the pieces of an arc may stand off it: the larger of a length, as fine as a bead is ever looked at, and of a
/// share of what the arc spans, which is less than a pixel of a picture that holds all of it.
struct Chord {
  double mm = 0.01;
  double share = 1.0 / 2000;
};

/// What a G-code file does, layer by layer.
struct Toolpaths {
  std::vector<std::string>
      features;  ///< weft's names of what beads are for ("outer_wall"), other slicers' where weft has none
  std::vector<PathLayer> layers;
};

/// What is put before the first layer (start G-code) counts to the first, what comes last to the last.
/// @param filament_diameter  what E is measured in
/// @throws Stopped, and nothing else: what cannot be understood is not drawn. Cost: linear in bytes, and in pieces of
/// arcs: √(radius / chord) for each
Toolpaths read(std::string_view gcode, Um filament_diameter, Chord chord = {});

/// One layer of a file that announces its layers in comments, as most slicers do: only its text is read, and what comes
/// right before it. Of other files all is read.
/// @param share  of the layers that lie below the one that is meant, 0 … 1
/// Post: at most one layer.
Toolpaths read_layer(std::string_view gcode, Um filament_diameter, double share);

}  // namespace weft::preview
