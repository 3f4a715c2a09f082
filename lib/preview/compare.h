// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "preview/figures.h"
#include "preview/toolpaths.h"

#include <string>
#include <utility>
#include <vector>

/// What differs between two prints, of whichever slicers.
namespace weft::preview {

/// A figure of both. `percent`: by how much they differ, as a share of what `of` is of the larger print: a feature's
/// time counts against all of the time, so that ten seconds of an hour are little, whatever the feature.
struct FigureDifference {
  std::string name, unit;
  double a = 0, b = 0, percent = 0;
};

/// What beads cover at a height, mm²; see coverage.h.
struct LayerDifference {
  double z_mm = 0, only_a_mm2 = 0, only_b_mm2 = 0, both_mm2 = 0;
};

struct SettingDifference {
  std::string key, a, b;  ///< "": it has none of that name
};

struct Comparison {
  bool same_moves = false;  ///< each move of the one is one of the other: place, width, height, speed, feature, tool
  std::vector<FigureDifference> figures;
  std::vector<LayerDifference> layers;  ///< ascending; layers less than half a height apart are one

  double worst_percent() const;
  /// Is no figure further apart? 0: is each move the same?
  bool alike(double tolerance_percent) const;
};

/// Pre: both have seconds (timing.h) by the same machine. Cost: linear in strokes and in the area of the beads, layers
/// side by side.
Comparison compare(const Toolpaths& a, const Toolpaths& b);

/// Settings that differ: lines `key = value`, in the order of the first text, then those that only the second has.
std::vector<SettingDifference> differences(std::string_view settings_a, std::string_view settings_b);

/// What a report says of it (README, "weft compare"): one object of JSON.
struct CompareReport {
  std::string file_a, file_b;
  double tolerance_percent = 0;
  std::vector<SettingDifference> settings;
  std::string settings_note;  ///< why there are none, where it is not that they agree
};
std::string json_of(const Comparison& comparison, const CompareReport& about);

/// A sentence: "alike: each move is the same", "they differ by 12.3 % in area: ...".
std::string verdict_of(const Comparison& comparison, double tolerance_percent);

/// The same for the page's script (page/panel.js).
std::string page_json_of(const Comparison& comparison, const CompareReport& about);

}  // namespace weft::preview
