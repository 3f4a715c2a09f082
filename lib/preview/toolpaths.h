// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace weft::preview {

/// A straight piece of the nozzle's way; arcs are cut into such pieces. A piece that only rises or sinks has one place.
struct Stroke {
  Point from, to;
  Um z = 0;  ///< of the nozzle where it ends
  Um width =
      0;  ///< line width of the bead that the filament of this piece makes (model/flow.h); 0: nothing is extruded
  Um height = 0;  ///< of the bead, as the file announces it, else of the layer
  float speed_mm_s = 0;
  float flow_mm3_s = 0;
  float seconds = 0;                     ///< see set_seconds
  std::uint32_t line = 0;                ///< of the file, from 1
  std::uint16_t acceleration_mm_s2 = 0;  ///< in force; 0: the file has not said
  std::int16_t nozzle_c = 0;             ///< what the nozzle was last told to reach; 0: nothing
  std::uint8_t feature = 0;              ///< index into Toolpaths::features
  std::uint8_t tool = 0;
  std::uint8_t fan_percent = 0;
  std::uint8_t support_percent = 100;  ///< see set_support
  bool compensated = false;            ///< less filament than the width that the file announces (;WIDTH:) would take

  bool extrudes() const { return width > 0; }
};

/// What happens between two strokes, at one place.
struct Event {
  enum class Kind : std::uint8_t { retract, prime, tool_change, pause };
  Kind kind = Kind::retract;
  std::uint32_t stroke = 0;  ///< of the layer: the one before which it happens; their number: at the end
  float mm = 0;              ///< of filament, of the first two; 0: as the firmware has it
  float seconds = 0;         ///< that it takes, of the first two
};

struct PathLayer {
  Um z = 0, height = 0;
  std::vector<Stroke> strokes;  ///< in the order of the file
  std::vector<Event> events;    ///< likewise
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
  double filament_mm2 = 0;  ///< cross-section of what E is measured in
};

/// What is put before the first layer (start G-code) counts to the first, what comes last to the last.
/// @param filament_diameter  what E is measured in
/// @throws Stopped, and nothing else: what cannot be understood is not drawn. Cost: linear in bytes, and in pieces of
/// arcs: √(radius / chord) for each
Toolpaths read(std::string_view gcode, Um filament_diameter, Chord chord = {});

}  // namespace weft::preview
