// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "support/room.h"

#include <cstdint>
#include <vector>

namespace weft::support {

/// Where branches can go, on a coarse grid: levels are taken together in slabs, and each cell of a slab tells how thick
/// a branch may be there that still finds its way down.
/// Source: distance transform as in Felzenszwalb & Huttenlocher 2012, "Distance transforms of sampled functions".
class Field {
 public:
  /// Lengths in cells of the field are tenths of a millimetre.
  static constexpr Um unit = 100;

  /// @param contacts  by level: what branches are for; the field reaches as far around it as they may go
  Field(const SupportSettings& settings, const Object& object, const Stack& stack,
        const std::vector<Regions>& contacts);

  std::size_t slabs() const { return first_.size() - 1; }
  std::size_t first_level(std::size_t slab) const { return first_[slab]; }
  std::size_t slab_of(std::size_t level) const;
  Um cell() const { return cell_; }
  /// A point that moves with the object.
  Point origin() const { return origin_; }
  /// How far a branch may go sideways on its way through a slab.
  Um reach(std::size_t slab) const { return reach_[slab]; }

  /// Greatest radius at p of a branch that enters the slab from above there and gets down to the plate.
  Um to_plate(std::size_t slab, Point p) const { return at(plate_, slab, p); }
  /// The same for who may stand on the part as well.
  Um to_anything(std::size_t slab, Point p) const { return at(any_.empty() ? plate_ : any_, slab, p); }
  /// Whether what is at p in this slab has the part right below it.
  bool stands_on_part(std::size_t slab, Point p) const;
  Point snapped(Point p) const;

 private:
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }
  Um at(const std::vector<std::vector<std::uint8_t>>& field, std::size_t slab, Point p) const;
  void size_up(const SupportSettings& settings, const Object& object, const Stack& stack,
               const std::vector<Regions>& contacts);
  std::vector<std::uint8_t> barred(const SupportSettings& settings, const Object& object, const Stack& stack,
                                   std::size_t slab) const;
  std::vector<std::uint8_t> clearance(const std::vector<std::uint8_t>& barred) const;
  std::vector<std::uint8_t> spread(const std::vector<std::uint8_t>& from, Um reach) const;

  Point origin_;
  Um cell_ = 400;
  int columns_ = 0, rows_ = 0;
  std::vector<std::size_t> first_;  // level of each slab, and one more
  std::vector<Um> reach_;
  Um beside_ = 0;
  int farthest_ = 0;                      // cells: how far from what is barred tells nothing more
  std::vector<std::uint8_t> clearances_;  // by the square of how far a cell is from what is barred
  std::vector<std::vector<std::uint8_t>> barred_, plate_, any_;
};

}  // namespace weft::support
