// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/notice.h"
#include "mesh/mesh.h"
#include "model/layer.h"
#include "settings/groups/layers.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// Cuts a mesh into layers. Layers are independent of each other once a `Cutter` is made.
namespace weft::slice {

/// A layer to be: the material between z − height and z, as the model is at half its height.
struct Plane {
  Um z = 0;  ///< top of the layer
  Um height = 0;
  Um below = 0;  ///< the cut is half a micron above this: vertices lie on whole microns, so none lies on the cut
  friend bool operator==(const Plane&, const Plane&) = default;
};

/// From the layer on that has its bottom there, layers are so high.
struct HeightFrom {
  Um bottom = 0;
  Um layer_height = 0;
};

/// Layers upwards from 0, as long as the middle of a layer is inside the model or on its top: what remains at the top
/// is a layer when it is at least half of one, and nothing otherwise. Pre: heights ascend by bottom, the first is at 0.
std::vector<Plane> planes(std::span<const HeightFrom> heights, Um model_height);

/// The same of the first layer, then layers of layer_height.
std::vector<Plane> planes(const LayerSettings& settings, Um model_height);

/// Places where the mesh has a hole and an outline had to be closed without it.
struct Gaps {
  std::size_t count = 0;
  double widest_um = 0;
  Point at;  ///< the middle of the widest
};

/// A layer, and what was odd about its outlines.
struct Cut {
  SlicedLayer layer;
  Gaps closed;   ///< up to tolerances::stitch_gap
  Gaps bridged;  ///< wider: joined to the nearest end, in a straight line
};

/// A mesh made ready for cutting.
class Cutter {
 public:
  /// Sorts triangles by the planes that cut them. Keeps a reference: the mesh must outlive the cutter.
  /// Pre:  planes ascend; the mesh stands on z = 0 (what is below is not cut).
  /// Cost: O(triangles + cuts), about 20 ns each.
  Cutter(const Mesh& mesh, std::vector<Plane> planes);

  std::size_t size() const { return planes_.size(); }
  std::span<const Plane> planes() const { return planes_; }
  /// The triangles that plane i cuts, ascending.
  std::span<const std::uint32_t> triangles_of(std::size_t i) const {
    return {triangles_.data() + starts_[i], starts_[i + 1] - starts_[i]};
  }

  /// The outlines of layer i, in chords up to `resolution` off, united as `slicing_mode` says; bodies no further apart
  /// than twice `slice_closing_radius` are one. Post:   regions as for Booleans (geometry/boolean.h). Holes in the mesh
  /// are closed; no outline is left out. Cost:   O(n) for n triangles cut, about 80 ns each, unless outlines touch
  /// (then they are united by a sweep). Thread: any number at once.
  Cut cut(std::size_t i, const LayerSettings& settings) const;

 private:
  const Mesh* mesh_;
  std::vector<Plane> planes_;
  std::vector<std::uint32_t> starts_;     // of each plane in triangles_, and one more
  std::vector<std::uint32_t> triangles_;  // ascending for each plane
};

/// At most one notice a kind of gap, over all layers: "open_contour_closed", "open_contour_bridged"; the place is that
/// of the widest.
/// @param of the object, as the user should read it
std::vector<PlacedNotice> notices_of(std::span<const Cut> cuts, const std::string& of);

}  // namespace weft::slice
