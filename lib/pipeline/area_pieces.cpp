// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/area_pieces.h"

#include <cstdint>
#include <iterator>
#include <utility>

namespace weft::pipeline {

AreaPieces::AreaPieces(Regions regions, const Areas& areas) {
  auto next = std::make_move_iterator(regions.begin());
  for (const Area& area : areas) {
    of_area_.emplace_back(next, next + area.regions);
    next += area.regions;
  }
}

void AreaPieces::put_back(Regions& regions, Areas& areas) && {
  regions.clear();
  for (std::size_t a = 0; a < of_area_.size(); ++a) {
    areas[a].regions = static_cast<std::uint32_t>(of_area_[a].size());
    std::move(of_area_[a].begin(), of_area_[a].end(), std::back_inserter(regions));
  }
}

}  // namespace weft::pipeline
