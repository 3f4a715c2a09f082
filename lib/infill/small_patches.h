// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "infill/mask.h"

#include <optional>

namespace weft::infill {

/// Which patches of a layer's sparse infill are too small to be worth it: solid, too; not those that lie on infill that
/// is none: their lines would hang from line to line of that, an island in sparse infill. Beside a bridge over that
/// infill they are holes in it, that solid lines of the next layer would hang over: there they are of the bridge.
class SmallPatches {
 public:
  /// @param below the sparse infill of the layer below
  SmallPatches(double least_mm2, const std::optional<Mask>& below) : least_mm2_(least_mm2), below_(below) {}

  /// Closes those among cells that lie on no large patch. Pre: both have one grid.
  void close(Mask& sparse, Mask& solid) const;

  /// Those on sparse infill beside a bridge over it are of the bridge.
  void give_to(Mask& bridge, Mask& sparse) const;

  /// Whether a patch that bridges and belts left is closed: none that lies on sparse infill, as bridges know nothing of
  /// it any more.
  bool closes(const Region& patch) const;

 private:
  /// @param closes  asked of each small patch, without its holes
  template <class Closes>
  void close_where(Mask& sparse, Mask& solid, const Closes& closes) const;

  double least_mm2_;
  const std::optional<Mask>& below_;
};

}  // namespace weft::infill
