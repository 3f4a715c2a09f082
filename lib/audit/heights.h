// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "audit/path.h"
#include "settings/head_profile.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

/// What is printed, as a map of heights, and the head that must not meet it.
namespace weft::audit {

/// How high plastic stands, cell by cell. Constant memory: 4 bytes a cell of 0.25 mm, more coarsely over an area that
/// would have more than sixteen million of them. A cell is as high as what covers its middle, so that a wall may
/// seem to stand half a cell's diagonal (0.18 mm) further out than it does, or further in: less than half a bead, by
/// which the nozzle keeps within the outlines that objects are placed by.
class Heights {
 public:
  /// Of what lies outside of the area nothing is known.
  explicit Heights(const Bounds& area_mm);

  /// A bead. Pre: straight
  void lay(Vec from, Vec to, double half_width_mm, double top_mm);

  double highest_mm() const { return highest_mm_; }

  struct Found {
    double height_mm = 0;
    Vec at;
  };
  /// The highest cell above a height that a convex shape touches, wherever on the way from `from` to `to` it is.
  /// @param shape corners around the place that moves, counter-clockwise
  std::optional<Found> above(std::span<const Vec> shape, Vec from, Vec to, double height_mm) const;

 private:
  struct Level {
    double cell_mm = 0;
    int columns = 0, rows = 0;
    std::vector<float> top_mm;  ///< of each cell: the highest of those it is made of
    std::size_t index(int x, int y) const {
      return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x);
    }
  };
  class Sweep;
  void raise(int x, int y, float top_mm);
  void search(const Sweep& sweep, std::size_t level, int x, int y, double& above_mm, std::optional<Found>& out) const;

  Vec origin_;
  std::vector<Level> levels_;  ///< the finest first
  double highest_mm_ = 0;
};

/// The head of a printer over what it has printed.
class HeadWatch {
 public:
  /// @param slabs of settings/head_profile.h: where nothing is said of the tip, it is as wide as the nozzle's opening
  HeadWatch(const std::vector<HeadSlab>& slabs, const Bounds& area_mm, double nozzle_mm);

  void lay(const Path& path, Vec offset, double half_width_mm, double top_mm);

  struct Meeting {
    double depth_mm = 0;      ///< of what stands there, in the head
    double head_from_mm = 0;  ///< of the part of the head that meets it: above the nozzle's tip
    Vec nozzle, at;           ///< about where the nozzle is then, and what it meets
  };
  /// The deepest that the head comes to be in what is printed, by more than `passes_mm`: a bead of the layer at hand.
  /// Cost: little where nothing stands higher than the head's underside; else some boxes of the map a part of the head.
  std::optional<Meeting> meets(const Path& path, double z_from_mm, double z_to_mm, double passes_mm) const;

 private:
  struct Slab {
    double from_mm = 0;
    std::vector<Vec> shape;  ///< convex
  };
  void look(const Slab& slab, Vec from, Vec to, double z_mm, double passes_mm, std::optional<Meeting>& out) const;

  std::vector<Slab> slabs_;
  Heights heights_;
};

}  // namespace weft::audit
