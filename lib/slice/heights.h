// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "mesh/layer_profile.h"
#include "mesh/mesh.h"
#include "model/sequence.h"
#include "slice/slice.h"

#include <optional>
#include <span>
#include <vector>

/// Layers of the heights that the object's surface asks for.
namespace weft::slice {

/// A horizontal face, or several at one height.
struct Flat {
  Um z = 0;
  double mm2 = 0;
};

/// What a surface asks of layers, by height.
struct Relief {
  static constexpr Um step = 10;  ///< µm
  std::vector<Um> most{};         ///< of each step from 0 on, the most that a layer may be high there
  std::vector<Flat> flats{};      ///< of more than 5 mm² each, ascending
};

/// A layer may be so high that its steps stand off the surface by no more than `error`: h(0.184 + c/2) for a face whose
/// normal rises by c. Less than a square millimetre of surface within a layer asks for nothing.
/// Source: Wasserfall 2017, measured walls; the part of the cusp is half of it, because an outline is cut in its
/// middle. Cost: O(triangles + height).
Relief relief_of(std::span<const Mesh* const> meshes, Um top, Um error);

/// How high layers may be.
struct HeightRules {
  Um least = 70, most = 300;
  std::optional<Um> wanted{};  ///< all of them about so high, whatever the surface; nothing: as few as it allows
  bool flats = true;           ///< faces are met
};

/// The layers between two heights: those of least cost, which is one a layer (with `wanted`, what differs from it),
/// three for every 50 µm by which a horizontal face of the object is missed, and a little for layers that differ in
/// height from those before. The last one ends at `to` where layers allow it, and less than half of the least off where
/// not.
/// @param before height of the layer below; nothing: none is
/// Cost: O(height × heights); 0.1 s for half a metre. Source: dynamic programming over (z, height).
std::vector<Plane> fitted_planes(const Relief& relief, const HeightRules& rules, Um from, Um to,
                                 std::optional<Um> before);

/// The layers of a profile as PrusaSlicer reads it: linear between its points, each layer as high as it says half of
/// the least height above its bottom. Pre: not empty, z ascending, heights above 0. Source: what PrusaSlicer 2.9 makes
/// of Metadata/Slic3r_PE_layer_heights_profile.txt.
std::vector<Plane> profile_planes(std::span<const mesh::HeightAt> profile, Um first, Um least, Um top);

/// How well layers meet a surface.
struct Surface {
  double mm2 = 0;          ///< of all that is neither horizontal nor upright
  double cusp_um_mm2 = 0;  ///< the cusp h·c of its steps, times area
  std::size_t faces = 0;   ///< horizontal ones of more than 5 mm²
  double missed_um = 0;    ///< by which they lie off the end of a layer, all together
  void add(const Surface& other);
};
Surface surface_of(std::span<const Mesh* const> meshes, std::span<const LayerHeight> layers);

}  // namespace weft::slice
