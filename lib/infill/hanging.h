// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "infill/exact_areas.h"
#include "infill/sparse.h"
#include "settings/groups/shells.h"

#include <optional>

/// Private to shells.cpp: what of a layer's solid is laid as free strands.
namespace weft::infill {

/// The layer that what hangs was found in.
struct HangingLayer {
  double line = 0;  ///< width of an ordinary one, µm
  Um nozzle = 0;    ///< diameter
};

/// Bottoms over air that hang between supports become bridges, wide ones that are held at one side ledges. Their ends
/// rest on what is below, also where there would be sparse infill beside the bottom. Gaps whose anchors meet are one
/// bridge, as long as no strand of it hangs further than one would anyway, or than any strand may.
/// @param below  what strands can rest on
void find_bridges(const ShellSettings& settings, const HangingLayer& layer, const Mask& air, const Mask& below,
                  Kinds& kinds);

/// Solid over sparse infill hangs from line to line of it: strands run along a straight area whose spans are easy, else
/// across the shortest free spans, and each lies on two things. What is narrow is a bridge only along, with strands
/// that both ends hold: shreds across it, or along a bend, would hang no better than the lines beside them.
/// @param below, sparse  the infill of the layer below, and where it is
void find_internal_bridges(const ShellSettings& settings, const HangingLayer& layer, const SparseStyle& below,
                           const std::optional<Mask>& sparse, Kinds& kinds);

}  // namespace weft::infill
