// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "infill/mask.h"

#include <optional>

namespace weft::infill {

/// Which patches of a layer's sparse infill are too small to be worth it: solid, too; not those that lie on infill that
/// is none: their lines would hang from line to line of that, an island in sparse infill.
class SmallPatches {
 public:
  /// @param below the sparse infill of the layer below
  SmallPatches(double least_mm2, const std::optional<Mask>& below) : least_mm2_(least_mm2), below_(below) {}

  bool closes(const Region& patch);

  /// Closes those among cells.
  void close(Mask& sparse, Mask& solid);

 private:
  bool goes_on_below(const Region& patch);

  double least_mm2_;
  const std::optional<Mask>& below_;
  std::optional<Mask> large_;
};

}  // namespace weft::infill
