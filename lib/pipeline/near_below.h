// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/settings.h"
#include "support/support.h"

#include <cstddef>
#include <vector>

namespace weft::pipeline {

/// Shares of plastic of columns, from what they carry down, and the band that they are of.
struct ColumnShares {
  std::vector<double> shares;
  Um band = 0;
};
ColumnShares shares_of_columns(const Settings& settings);

/// By step: where columns are denser than from there down; none where they are as dense everywhere.
using NearSteps = std::vector<Regions>;

/// Where columns are how near below what they carry. Denser lines begin and end on those below that lie across them:
/// these areas are whole cells between such lines.
class NearBelow {
 public:
  /// @param origin  where patterns are anchored
  NearBelow(const Settings& settings, const std::vector<support::SupportLayer>& layers, const ColumnShares& of_columns,
            Point origin);

  /// On a layer.
  NearSteps on(std::size_t layer) const;
  /// Around a column of a layer.
  NearSteps around(std::size_t layer, const Region& column) const;
  /// Whether that is the same for all columns of two layers.
  bool are_alike(std::size_t layer, std::size_t other) const;
  /// Where columns of a layer are denser than on another.
  Regions begun(std::size_t layer, std::size_t other) const;

 private:
  struct Cell {
    Um row = 0, column = 0;
    auto operator<=>(const Cell&) const = default;
  };
  using Cells = std::vector<Cell>;  ///< in order
  /// Cells of a step: lines below it run along x and are `apart`, those above it along y.
  struct Grid {
    double angle_rad = 0;
    Um apart = 0, wide = 0, first = 0;  ///< height and width of cells, and where one begins along x
    Point origin{};
    Um margin = 0, half_band = 0;

    Cells met_by(const Regions& area) const;
    Regions area_of(const Cells& cells) const;
    Um row_of(Um y) const;
    Um column_of(Um x) const;
  };
  void find(const Grid& grid, const std::vector<support::SupportLayer>& layers, Um depth);

  struct Step {
    std::vector<std::size_t> of_layer;  ///< which of the areas
    std::vector<Regions> areas;
  };
  std::vector<Step> steps_;
};

}  // namespace weft::pipeline
