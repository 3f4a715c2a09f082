// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "preview/colours.h"
#include "preview/preview.h"

/// One layer made ready to draw, the same for every kind of picture.
namespace weft::preview {

/// Strokes that join and look alike.
struct Line {
  Polyline path;
  Um width = 0;
  Rgb colour;
};

struct LegendRow {
  Rgb colour;
  std::string text;
};

struct Scene {
  Box box;                    ///< what is shown
  std::vector<Line> beads;    ///< in the order they are printed
  std::vector<Line> marks;    ///< centrelines of compensated beads
  std::vector<Line> travels;  ///< width 0: a hairline, as are the following
  std::vector<Line> offending;
  Ring bed, reach;
  std::vector<Ring> no_go;
  std::vector<std::string> title;
  std::vector<LegendRow> legend;
};

/// Pre: as preview.h. The box holds the layer but for custom G-code and travels, the overlay and what it found outside.
Scene scene_of(const Toolpaths& paths, const View& view, const std::optional<Overlay>& overlay);

/// Title and legend of a picture of solids, and nothing else.
Scene words_of(const Toolpaths& paths, const View& view);

/// Pixels of the drawing, and of the legend to the right of it.
struct Frame {
  double pixels_per_mm;
  int width, height;  ///< of the drawing
  static constexpr int legend_width = 320;
  double x(Um at, const Scene& scene) const { return to_mm(at - scene.box.min.x) * pixels_per_mm; }
  double y(Um at, const Scene& scene) const { return to_mm(scene.box.max.y - at) * pixels_per_mm; }
};
Frame frame_of(const Scene& scene, int size);

}  // namespace weft::preview
