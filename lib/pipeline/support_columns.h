// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/bead.h"
#include "pipeline/near_below.h"
#include "settings/settings.h"
#include "support/support.h"

#include <vector>

namespace weft::pipeline {

/// Columns without walls, of all layers. Mostly they stand straight: of those that are the same on layers of one
/// height, the first one is filled.
class SupportColumns {
 public:
  /// @param near   where they are how near below what they carry
  /// @param origin where patterns are anchored: one point for all layers
  SupportColumns(const Settings& settings, const std::vector<support::SupportLayer>& layers, const NearBelow& near,
                 Point origin);

  Beads of(std::size_t layer) const;
  struct Unlike {
    Beads walls, lines;
  };
  /// Of the same those of columns that are like none of that layer: what goes round, as narrow ones do, and the rest.
  Unlike unlike(std::size_t layer, std::size_t other) const;

 private:
  struct Place {
    std::size_t layer, region;
  };
  void find_like(const Settings& settings, const std::vector<support::SupportLayer>& layers, const NearBelow& near,
                 const std::vector<Regions>& areas);

  std::vector<Place> firsts_;
  std::vector<Beads> filled_;                   ///< beside firsts_
  std::vector<std::vector<std::size_t>> like_;  ///< of each layer: which of firsts_ its columns are like
};

}  // namespace weft::pipeline
