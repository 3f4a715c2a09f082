// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "model/layer.h"
#include "pipeline/handed_to.h"
#include "pipeline/object_scopes.h"
#include "pipeline/sample.h"
#include "slice/slice.h"

#include <cstddef>
#include <vector>

namespace weft::pipeline {

using WallHands = HandedTo<Stage::walls>;

/// The walls of an object, layer by layer. What they are does not hang on support, but for the width of beads over air:
/// they may be laid while it is planned.
class WallsOfObject {
 public:
  /// @param areas  of each layer
  WallsOfObject(const WallHands& handed, const Scopes& scopes, const std::vector<slice::Cut>& cuts,
                const std::vector<Areas>& areas, const Sample& sample);

  /// Does most of the work of a layer ahead, of different ones side by side. Pre: not while or after `build`.
  void lay_ahead(std::size_t layer);

  /// All of them. Once.
  /// @param known_over_air what of each layer has nothing below; empty: nobody has asked yet
  /// @param held of each layer, what rests on support; empty: nothing does
  std::vector<WallLayer> build(std::vector<Regions> known_over_air, const std::vector<Regions>& held);

 private:
  /// What is of the same settings: the walls of each are laid as if the others were not there.
  struct Piece {
    ScopeId scope = 0;
    std::vector<std::uint32_t> regions;  ///< of the layer; empty: all
    SlicedLayer own;                     ///< where these are not all
    WallLayer walls;
  };
  /// Calls what(settings, input, walls) of each piece.
  template <class Do>
  void of_each(std::size_t layer, const Regions* over_air, std::vector<Piece>& pieces, Do what) const;
  std::vector<Piece> laid(std::size_t layer) const;

  const WallHands& handed_;
  const Scopes& scopes_;
  const std::vector<slice::Cut>& cuts_;
  const std::vector<Areas>& areas_;
  const Sample& sample_;
  Point origin_;
  std::vector<std::vector<Piece>> ahead_;  ///< of each layer; none: not yet
};

/// About what walls leave of a layer, by their nominal widths alone: enough for the layers around it to know their
/// skin.
Regions nominal_inside(const WallHands& handed, const Areas& areas, const SlicedLayer& layer, std::size_t index);

}  // namespace weft::pipeline
