// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/trapped.h"

#include "core/stop.h"
#include "support/kinds.h"
#include "support/raster.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace weft::support {
namespace {

constexpr Um ball = 1.5_mm;  // its radius: a finger, or pliers
constexpr double most_cells = 150'000;
constexpr Um finest_cell = 0.75_mm;
static_assert(2 * ball <= 7 * finest_cell, "distances that tell are of five cells at most");

/// The air around an object, in cubes.
class Air {
 public:
  explicit Air(const Room& room) : room_(room) {
    const Object& object = room.object();
    for (const auto* layer : object.layers) box_.add(box_of(layer->regions));
    const Um height = object.layers.back()->z - object.floor;
    for (cell_ = finest_cell;; cell_ = cell_ * 9 / 8) {
      const Um margin = ball + 2 * cell_;
      columns_ = (box_.size().x + 2 * margin) / cell_ + 1, rows_ = (box_.size().y + 2 * margin) / cell_ + 1;
      slabs_ = (height + 2 * margin) / cell_ + 1;
      origin_ = {box_.min.x - margin, box_.min.y - margin}, bottom_ = object.floor - margin;
      if (double(columns_) * rows_ * slabs_ <= most_cells) break;
    }
    find_reached();
  }

  double trapped_share(const SupportLayer& layer) const {
    const int slab = std::clamp((layer.z - layer.height / 2 - bottom_) / cell_, 0, slabs_ - 1);
    std::size_t all = 0, trapped = 0;
    const auto count = [&](int c, int r) { ++all, trapped += from_reached_[index(c, r, slab)] > near_enough(); };
    const Regions areas = all_areas(layer);
    rasterize(areas, origin_, cell_, columns_, rows_, count);
    if (all == 0)  // all of it is smaller than a cell
      for (const Region& region : areas) {
        const Point at = region.outer.front() - origin_;
        count(std::clamp(at.x / cell_, 0, columns_ - 1), std::clamp(at.y / cell_, 0, rows_ - 1));
      }
    return all == 0 ? 0 : static_cast<double>(trapped) / static_cast<double>(all);
  }

 private:
  std::size_t index(int c, int r, int slab) const {
    return (static_cast<std::size_t>(slab) * static_cast<std::size_t>(rows_) + static_cast<std::size_t>(r)) *
               static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(c);
  }
  double squared(double um) const { return um / cell_ * (um / cell_); }
  double near_enough() const { return squared(ball + 1.5 * cell_); }  // with the cells' corners

  /// From zeros, as far as `least` tells whether one is as near.
  void find_distances(std::vector<std::uint8_t>& squares, double least) const {
    const auto columns = static_cast<std::size_t>(columns_), rows = static_cast<std::size_t>(rows_);
    const auto reach = static_cast<std::size_t>(std::sqrt(least));
    spread_squares(squares, columns, 1, reach);
    spread_squares(squares, rows, columns, reach);
    spread_squares(squares, static_cast<std::size_t>(slabs_), rows * columns, reach);
  }

  void find_reached() {
    std::vector<std::uint8_t> from_part(
        static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) * static_cast<std::size_t>(slabs_),
        far_away);
    for (int s = 0; s < slabs_; ++s) {
      stop_if_asked();
      const Um middle = bottom_ + s * cell_ + cell_ / 2;
      rasterize(room_.part(middle - 1, middle + 1, box_), origin_, cell_, columns_, rows_,
                [&](int c, int r) { from_part[index(c, r, s)] = 0; });
    }
    // What the ball's middle gets to from a corner, which lies outside; half a cell is left to the grid.
    const double keeps = squared(ball - cell_ / 2.0);
    find_distances(from_part, keeps);
    from_reached_.assign(from_part.size(), far_away);
    std::vector<std::size_t> open{0};
    from_reached_[0] = 0;
    const auto columns = static_cast<std::size_t>(columns_), plane = columns * static_cast<std::size_t>(rows_);
    while (!open.empty()) {
      const std::size_t i = open.back();
      open.pop_back();
      const auto look = [&](bool there, std::size_t j) {
        if (!there || from_reached_[j] == 0 || from_part[j] <= keeps) return;
        from_reached_[j] = 0;
        open.push_back(j);
      };
      const std::size_t c = i % columns, r = i % plane / columns, s = i / plane;
      look(c > 0, i - 1), look(c + 1 < columns, i + 1);
      look(r > 0, i - columns), look((r + 1) * columns < plane, i + columns);
      look(s > 0, i - plane), look(i + plane < from_part.size(), i + plane);
    }
    find_distances(from_reached_, near_enough());
  }

  const Room& room_;
  Box box_;
  Point origin_;
  Um cell_ = 0, bottom_ = 0;
  int columns_ = 0, rows_ = 0, slabs_ = 0;
  std::vector<std::uint8_t> from_reached_;  ///< squared distance to what the ball's middle gets to
};

}  // namespace

std::vector<double> trapped_shares(const Room& room, const std::vector<SupportLayer>& layers, double on_part_mm2) {
  if (on_part_mm2 <= 0) return {};
  const Air air(room);
  std::vector<double> out;
  for (const SupportLayer& layer : layers) out.push_back(air.trapped_share(layer));
  if (std::all_of(out.begin(), out.end(), [](double share) { return share == 0; })) out.clear();
  return out;
}

}  // namespace weft::support
