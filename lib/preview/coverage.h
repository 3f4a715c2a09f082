// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "preview/toolpaths.h"

#include <cstdint>
#include <vector>

namespace weft::preview {

/// What beads cover of a plane, in square cells of 0.1 mm, a quarter of the usual bead: coarser where the window is
/// wider than 8192 of them. A cell is covered when its middle is. Beads have round ends.
class Coverage {
 public:
  /// Nothing is covered. What lies outside of the window is left out.
  explicit Coverage(Box window);

  void add(const Stroke& bead);
  /// All beads of a layer but those of custom G-code.
  void add(const PathLayer& layer, const Toolpaths& paths);

  bool at(Point p) const;
  double cell_mm2() const { return to_mm(cell_) * to_mm(cell_); }

  /// Cells that are covered by the one, by the other, by both. Pre: the same window.
  struct Shared {
    std::uint64_t only_a = 0, only_b = 0, both = 0;
  };
  static Shared shared(const Coverage& a, const Coverage& b);

 private:
  void fill(std::int64_t row, double from_um, double to_um);

  Point origin_;
  Um cell_;
  std::int64_t width_, height_;  // cells
  std::size_t stride_;           // words a row
  std::vector<std::uint64_t> bits_;
};

/// The beads of a layer but those of custom G-code, with half their widths; empty: there are none.
Box box_of_beads(const PathLayer& layer, const Toolpaths& paths);

/// Does custom G-code lay it?
bool is_custom(const Toolpaths& paths, const Stroke& stroke);

/// Sets Stroke::support_percent: how much of a bead's width lies over what the layers below have laid, on average along
/// it, from nine places across. In the first layer, all of it. Cost: linear in the area of the beads, layers side by
/// side.
void set_support(Toolpaths& paths);

}  // namespace weft::preview
