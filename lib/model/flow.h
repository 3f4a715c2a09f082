// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/microns.h"

#include <algorithm>
#include <cmath>
#include <numbers>

/// How much plastic a bead holds. One convention for the whole program:
///
/// * A *line width* is what users set and viewers show: the widest place of a bead of rounded cross-section.
/// * A *band* is what planning uses: the width of the rectangle of the bead's height that holds the same volume. Bands
///   side by side fill a plane without gap or overlap, and volume = band × height × length, exactly.
///
/// Source: Slic3r manual, "Flow math" (rounded cross-section, spacing); SuperSlicer's wiki (overlap factor).
namespace weft::flow {

/// Share of a bead's height by which neighbours that touch may move together until they are dense: 1 − π/4.
inline constexpr double rounding = 1.0 - std::numbers::pi / 4.0;

/// Cross-section of a bead of that line width, mm²: h(w − h) + πh²/4. Below w = h nothing rounds it: the rectangle w·h.
inline double area_mm2(double width_mm, double height_mm) {
  if (width_mm < height_mm) return width_mm * height_mm;
  return height_mm * (width_mm - height_mm) + std::numbers::pi / 4.0 * height_mm * height_mm;
}

/// Distance between the centres of neighbouring beads: w − h(1 − π/4)·overlap_factor; for w < h the width itself.
/// With overlap_factor 1 it is the band.
inline double spacing_mm(double width_mm, double height_mm, double overlap_factor = 1.0) {
  if (width_mm < height_mm) return width_mm;
  return width_mm - height_mm * rounding * overlap_factor;
}

/// The band of a line width: the width of the rectangle of equal volume. Post: area = band × height.
inline Um band(Um line_width, Um height) {
  return from_mm(spacing_mm(to_mm(line_width), to_mm(height)));
}

/// Distance between the centres of neighbours of that line width, to the micron; see spacing_mm.
inline Um spacing(Um line_width, Um height, double overlap_factor) {
  return from_mm(spacing_mm(to_mm(line_width), to_mm(height), overlap_factor));
}

/// How much narrower than their spacing the bands of neighbours are that overlap less than is dense.
inline Um spread(Um height, double overlap_factor) {
  return rounded(height * rounding * (1 - overlap_factor));
}

/// The line width of a band; the inverse of `band` up to the rounding to microns.
inline Um line_width(Um band_width, Um height) {
  const double band_mm = to_mm(band_width), height_mm = to_mm(height);
  constexpr double half_micron = 0.0005;  // the band was rounded
  if (band_mm < height_mm * (1.0 - rounding) - half_micron) return band_width;
  return from_mm(band_mm + height_mm * rounding);
}

/// How far the widest point of a bead of that line width stands out beyond half the way to its neighbour, µm.
inline double bulge_um(Um line_width, Um height, double overlap_factor) {
  return (line_width - 1000 * spacing_mm(to_mm(line_width), to_mm(height), overlap_factor)) / 2;
}

/// Automatic width of outer walls: 1.05 × nozzle, narrow for a fine surface.
inline Um automatic_outer_width(Um nozzle) {
  return rounded(1.05 * nozzle);
}

/// Automatic width of everything else: the line that a strand of the nozzle's own cross-section makes at that height,
/// at most 1.7 × nozzle (sparse infill takes any width) and at least the nozzle.
inline Um automatic_width(Um nozzle, Um height, bool capped = true) {
  const double d = to_mm(nozzle), h = to_mm(height);
  const double width = std::numbers::pi / 4.0 * (d * d - h * h) / h + h;
  const double most = capped ? 1.7 * d : 3.0 * d;
  return from_mm(std::clamp(width, d, most));
}

/// A strand over air is a circle of the nozzle's diameter, mm². Laid side by side its spacing is the diameter.
inline double bridge_area_mm2(Um nozzle) {
  return std::numbers::pi / 4.0 * to_mm(nozzle) * to_mm(nozzle);
}

/// The flow ratio that gives a bead of band `nozzle` and that height the volume of a bridge strand.
inline double bridge_flow(Um nozzle, Um height) {
  return bridge_area_mm2(nozzle) / (to_mm(nozzle) * to_mm(height));
}

}  // namespace weft::flow
