// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/field.h"

#include "core/stop.h"
#include "support/lengths.h"
#include "support/raster.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace weft::support {
namespace {

constexpr double most_cells = 4e6;  // of all slabs together: each is a byte, three times
constexpr Um finest_cell = 0.3_mm;

void lessen(std::vector<std::uint8_t>& to, const std::vector<std::uint8_t>& most) {
  std::transform(to.begin(), to.end(), most.begin(), to.begin(),
                 [](std::uint8_t a, std::uint8_t b) { return std::min(a, b); });
}

}  // namespace

void Field::size_up(const SupportSettings& settings, const Object& object, const Stack& stack,
                    const std::vector<Regions>& contacts) {
  constexpr Um around_part = 8_mm, aside = 40_mm;  // who must go further aside has a column
  Box part, box;
  for (const auto* layer : object.layers) part.add(box_of(layer->regions));
  for (const auto& regions : contacts) box.add(box_of(regions));
  part = part.grown(around_part), box = box.grown(aside);
  box = {{std::max(box.min.x, part.min.x), std::max(box.min.y, part.min.y)},
         {std::min(box.max.x, part.max.x), std::min(box.max.y, part.max.y)}};
  const double slope = std::tan(settings.support_tree_angle * std::numbers::pi / 180);
  const double height = stack.levels.back().z - object.floor;
  for (cell_ = finest_cell;; cell_ = cell_ * 5 / 4) {
    const double slab = 2.0 * cell_ / slope;
    const double cells = double(box.size().x) / cell_ * (double(box.size().y) / cell_) * (height / slab + 1);
    if (cells <= most_cells) break;
  }
  origin_ = box.min;
  columns_ = box.size().x / cell_ + 1, rows_ = box.size().y / cell_ + 1;
  first_ = {0};
  Um begun = object.floor;
  for (std::size_t k = 0; k < stack.levels.size(); ++k) {
    const Um way = rounded((stack.levels[k].z - begun) * slope);
    if (way < 2 * cell_ && k + 1 < stack.levels.size()) continue;
    first_.push_back(k + 1);
    reach_.push_back(way);
    begun = stack.levels[k].z;
  }
}

std::vector<std::uint8_t> Field::barred(const SupportSettings& settings, const Object& object, const Stack& stack,
                                        std::size_t slab) const {
  std::vector<std::uint8_t> out(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_),
                                object.room != nullptr ? 1 : 0);
  if (object.room != nullptr)
    rasterize(*object.room, origin_, cell_, columns_, rows_, [&](int c, int r) { out[index(c, r)] = 0; });
  const Um low = stack.levels[first_[slab]].bottom(), high = stack.levels[first_[slab + 1] - 1].z;
  if (settings.support_blockers_avoided)
    rasterize(blocked_between(object, low, high), origin_, cell_, columns_, rows_,
              [&](int c, int r) { out[index(c, r)] = 1; });
  const auto run = layers_between(object, low, high);
  for (std::size_t i = run.from; i < run.to; ++i)
    rasterize(object.layers[i]->regions, origin_, cell_, columns_, rows_, [&](int c, int r) { out[index(c, r)] = 2; });
  return out;
}

/// Distance of each cell to what is barred, less the distance that is kept and the doubt of the grid.
std::vector<std::uint8_t> Field::clearance(const std::vector<std::uint8_t>& barred) const {
  const auto squared = squared_distances(barred, static_cast<std::size_t>(columns_), farthest_);
  std::vector<std::uint8_t> out(barred.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = clearances_[static_cast<std::size_t>(squared[i])];
  return out;
}

/// Each cell gets the greatest value within reach.
std::vector<std::uint8_t> Field::spread(const std::vector<std::uint8_t>& from, Um reach) const {
  struct Span {
    int row, half;
  };
  std::vector<Span> disc;
  const int cells = reach / cell_;
  for (int r = -cells; r <= cells; ++r)
    disc.push_back({r, static_cast<int>(std::sqrt(double(cells) * cells - double(r) * r))});
  std::vector<std::uint8_t> out(from.size(), 0);
  for (int r = 0; r < rows_; ++r)
    for (const Span span : disc) {
      if (r + span.row < 0 || r + span.row >= rows_) continue;
      const std::uint8_t* source = from.data() + index(0, r + span.row);
      std::uint8_t* to = out.data() + index(0, r);
      for (int by = -span.half; by <= span.half; ++by) {
        const int begin = std::max(0, -by), end = std::min(columns_, columns_ - by);
        for (int c = begin; c < end; ++c) to[c] = std::max(to[c], source[c + by]);
      }
    }
  return out;
}

Field::Field(const SupportSettings& settings, const Object& object, const Stack& stack,
             const std::vector<Regions>& contacts) {
  beside_ = beside(settings, object);
  size_up(settings, object, stack, contacts);
  const double most_um = settings.support_tree_max_diameter / 2.0 + beside_ + cell_;  // no branch asks for more
  farthest_ = static_cast<int>(std::ceil(most_um / cell_)) + 1;
  for (int squared = 0; squared <= farthest_ * farthest_; ++squared) {
    const double um = std::sqrt(squared) * cell_ - beside_ - 0.75 * cell_;
    clearances_.push_back(static_cast<std::uint8_t>(std::clamp(um / unit, 0.0, 255.0)));
  }
  barred_ = tasks::parallel_map(slabs(), [&](std::size_t slab) { return barred(settings, object, stack, slab); });
  const auto clear = tasks::parallel_map(slabs(), [&](std::size_t slab) { return clearance(barred_[slab]); });
  const bool everywhere = settings.support_type == SupportType::everywhere;
  for (std::size_t slab = 0; slab < slabs(); ++slab) {
    stop_if_asked();
    if (slab == 0) {
      plate_.push_back(clear[0]);
      if (everywhere) any_.push_back(clear[0]);
      continue;
    }
    plate_.push_back(spread(plate_.back(), reach_[slab]));
    lessen(plate_.back(), clear[slab]);
    if (!everywhere) continue;
    auto down = spread(any_.back(), reach_[slab]);
    for (std::size_t i = 0; i < down.size(); ++i)
      if (barred_[slab - 1][i] == 2) down[i] = 255;
    lessen(down, clear[slab]);
    any_.push_back(std::move(down));
  }
}

std::size_t Field::slab_of(std::size_t level) const {
  return static_cast<std::size_t>(std::upper_bound(first_.begin(), first_.end(), level) - first_.begin()) - 1;
}

Um Field::at(const std::vector<std::vector<std::uint8_t>>& field, std::size_t slab, Point p) const {
  const int c = (p.x - origin_.x) / cell_, r = (p.y - origin_.y) / cell_;
  if (p.x < origin_.x || p.y < origin_.y || c >= columns_ || r >= rows_) return 0;
  return field[slab][index(c, r)] * unit;
}

bool Field::stands_on_part(std::size_t slab, Point p) const {
  const int c = (p.x - origin_.x) / cell_, r = (p.y - origin_.y) / cell_;
  if (slab == 0 || p.x < origin_.x || p.y < origin_.y || c >= columns_ || r >= rows_) return false;
  return barred_[slab - 1][index(c, r)] == 2;
}

Point Field::snapped(Point p) const {
  const auto middle = [&](Um v, Um o) { return o + (v - o) / cell_ * cell_ + cell_ / 2; };
  return {middle(p.x, origin_.x), middle(p.y, origin_.y)};
}

}  // namespace weft::support
