// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/area.h"

#include <cstddef>
#include <vector>

namespace weft::pipeline {

/// The regions of a layer, taken out of it, each area's for itself, to be changed and put back.
class AreaPieces {
 public:
  /// Pre: areas count the regions
  AreaPieces(Regions regions, const Areas& areas);

  std::size_t size() const { return of_area_.size(); }
  Regions& operator[](std::size_t area) { return of_area_[area]; }
  const Regions& operator[](std::size_t area) const { return of_area_[area]; }

  void put_back(Regions& regions, Areas& areas) &&;

 private:
  std::vector<Regions> of_area_;
};

}  // namespace weft::pipeline
