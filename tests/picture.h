// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

/// What a test is looking at, drawn when one of its assertions fails: a geometry test's helpers name what they make,
/// and the SVG that is left beside the test program (failed/<test>-<n>.svg) shows where to look.
namespace tests {

/// A line as it is drawn, mm: an outline (width 0), or a bead of that width.
struct Stroke {
  std::vector<std::pair<double, double>> path;
  std::vector<double> widths;  ///< one a point; empty: an outline
  bool closed = true;
};

/// Begins a new picture of what follows. The one before is forgotten, unless an assertion failed.
void new_picture();
void add_to_picture(Stroke stroke);

/// The picture as it stands, in SVG; empty where nothing was shown.
std::string picture_svg();

/// Writes it; the file's path, or an empty one where nothing was shown or it could not be written.
std::filesystem::path leave_picture(const std::string& test, int number);

inline void show(const weft::Ring& ring) {
  Stroke stroke;
  for (const weft::Point p : ring) stroke.path.emplace_back(weft::to_mm(p.x), weft::to_mm(p.y));
  add_to_picture(std::move(stroke));
}

inline void show(const weft::Region& region) {
  show(region.outer);
  for (const weft::Ring& hole : region.holes) show(hole);
}

/// Shows regions in a picture of their own.
inline void look_at(const weft::Regions& regions) {
  new_picture();
  for (const weft::Region& region : regions) show(region);
}
/// … and others in the same.
inline void look_at(const weft::Regions& regions, const weft::Regions& others) {
  look_at(regions);
  for (const weft::Region& region : others) show(region);
}

/// Shows beads in the picture that is there. (A template: not every test knows of beads.)
template <class Beads>
void show_beads(const Beads& beads) {
  for (const auto& bead : beads) {
    Stroke stroke{{}, {}, bead.closed};
    for (const auto& junction : bead.path) {
      stroke.path.emplace_back(weft::to_mm(junction.at.x), weft::to_mm(junction.at.y));
      stroke.widths.push_back(weft::to_mm(junction.width));
    }
    add_to_picture(std::move(stroke));
  }
}

}  // namespace tests
