// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "field/grid.h"

#include <optional>

namespace weft::infill {

/// The direction that lines are to follow at each place of an object.
class Direction {
 public:
  /// @param on_bed  what is added to the object's places to have those on the bed, where fields lie
  Direction(field::TensorGrid tensors, Point on_bed) : tensors_(std::move(tensors)), on_bed_(on_bed) {}

  /// Against X; nothing where no direction is better than another.
  std::optional<double> at(double x_um, double y_um, double z_um) const {
    return tensors_.direction_at((x_um + on_bed_.x) / 1000, (y_um + on_bed_.y) / 1000, z_um / 1000);
  }

 private:
  field::TensorGrid tensors_;
  Point on_bed_;
};

}  // namespace weft::infill
