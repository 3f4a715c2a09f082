// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "preview/toolpaths.h"

#include <cstdint>
#include <vector>

namespace weft::preview {

/// What a kind of beads takes.
struct Share {
  double mm = 0, mm3 = 0, seconds = 0;
};

/// How much lies in each step of what is measured; the last holds all beyond.
struct Histogram {
  double step;                 ///< of what is measured
  std::vector<double> amount;  ///< [i]: from i·step to (i + 1)·step
  void add(double at, double much);
};

struct LayerFigures {
  double z_mm = 0, height_mm = 0, seconds = 0, mm3 = 0;
  std::uint64_t moves = 0;
};

/// What a print takes, counted over its strokes. Custom G-code counts as the feature "custom".
struct Figures {
  std::vector<Share> features;  ///< by Toolpaths::features
  Share travel;                 ///< mm3 is 0
  double seconds = 0;           ///< all of it, standing still included
  double mm3 = 0;               ///< of plastic laid
  double mm2 = 0;               ///< cross-section of the filament
  std::uint64_t moves = 0, beads = 0, travels = 0, retractions = 0, tool_changes = 0, pauses = 0;
  std::vector<LayerFigures> layers;
  Histogram flow{0.5, {}};    ///< seconds by mm³/s
  Histogram speed{10, {}};    ///< mm by mm/s
  Histogram width{0.05, {}};  ///< mm by mm
};

/// Pre: set_seconds (timing.h). Cost: linear.
Figures figures_of(const Toolpaths& paths);

}  // namespace weft::preview
