// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/field.h"

#include "core/stop.h"
#include "support/lengths.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace weft::support {
namespace {

constexpr double most_cells = 8e6;  // of all slabs together: each is a byte, three times
constexpr Um finest_cell = 0.3_mm;
constexpr double far_away = 1e12;

/// Lower envelope of parabolas: squared distances of one row, in place.
void transform(std::vector<double>& f, std::vector<double>& out, std::vector<int>& v, std::vector<double>& z, int n) {
  const auto at = [](auto& list, int i) -> auto& {
    return list[static_cast<std::size_t>(i)];
  };
  int k = 0;
  at(v, 0) = 0, at(z, 0) = -far_away * 10, at(z, 1) = far_away * 10;
  for (int q = 1; q < n; ++q) {
    const auto meeting = [&](int p) { return (at(f, q) + double(q) * q - at(f, p) - double(p) * p) / (2.0 * (q - p)); };
    double s = meeting(at(v, k));
    while (k > 0 && s <= at(z, k)) s = meeting(at(v, --k));
    if (s <= at(z, k)) {
      at(v, k) = q;
      continue;
    }
    at(v, ++k) = q, at(z, k) = s, at(z, k + 1) = far_away * 10;
  }
  k = 0;
  for (int q = 0; q < n; ++q) {
    while (at(z, k + 1) < q) ++k;
    at(out, q) = double(q - at(v, k)) * (q - at(v, k)) + at(f, at(v, k));
  }
}

/// Sets the cells whose centre is inside of the regions.
template <class Set>
void rasterize(const Regions& regions, Point origin, Um cell, int columns, int rows, Set set) {
  std::vector<std::vector<double>> crossings(static_cast<std::size_t>(rows));
  const auto add = [&](const Ring& ring) {
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const Point a = ring[j], b = ring[i];
      if (a.y == b.y) continue;
      const double low = std::min(a.y, b.y), high = std::max(a.y, b.y);
      const int from = std::max(0, static_cast<int>(std::ceil((low - origin.y) / cell - 0.5)));
      const int to = std::min(rows - 1, static_cast<int>(std::ceil((high - origin.y) / cell - 0.5)) - 1);
      for (int r = from; r <= to; ++r) {
        const double y = origin.y + (r + 0.5) * cell;
        crossings[static_cast<std::size_t>(r)].push_back(a.x + (y - a.y) * (double(b.x) - a.x) / (double(b.y) - a.y));
      }
    }
  };
  for (const Region& region : regions) {
    add(region.outer);
    for (const Ring& hole : region.holes) add(hole);
  }
  for (int r = 0; r < rows; ++r) {
    auto& row = crossings[static_cast<std::size_t>(r)];
    std::sort(row.begin(), row.end());
    for (std::size_t i = 0; i + 1 < row.size(); i += 2) {
      const int from = std::max(0, static_cast<int>(std::ceil((row[i] - origin.x) / cell - 0.5)));
      const int to = std::min(columns - 1, static_cast<int>(std::ceil((row[i + 1] - origin.x) / cell - 0.5)) - 1);
      for (int c = from; c <= to; ++c) set(c, r);
    }
  }
}

}  // namespace

void Field::size_up(const SupportSettings& settings, const Object& object, const Stack& stack) {
  Box box;
  for (const auto* layer : object.layers) box.add(box_of(layer->regions));
  box = box.grown(8_mm);  // branches go round the part
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
  const auto columns = static_cast<std::size_t>(columns_), rows = static_cast<std::size_t>(rows_);
  std::vector<double> squared(barred.size());
  for (std::size_t i = 0; i < barred.size(); ++i) squared[i] = barred[i] != 0 ? 0 : far_away;
  const std::size_t longest = std::max(columns, rows);
  std::vector<double> line(longest), result(longest), z(longest + 1);
  std::vector<int> v(longest);
  for (std::size_t c = 0; c < columns; ++c) {
    for (std::size_t r = 0; r < rows; ++r) line[r] = squared[r * columns + c];
    transform(line, result, v, z, rows_);
    for (std::size_t r = 0; r < rows; ++r) squared[r * columns + c] = result[r];
  }
  for (std::size_t r = 0; r < rows; ++r) {
    std::copy_n(squared.begin() + static_cast<std::ptrdiff_t>(r * columns), columns, line.begin());
    transform(line, result, v, z, columns_);
    std::copy_n(result.begin(), columns, squared.begin() + static_cast<std::ptrdiff_t>(r * columns));
  }
  std::vector<std::uint8_t> out(barred.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double um = std::sqrt(squared[i]) * cell_ - beside_ - 0.75 * cell_;
    out[i] = static_cast<std::uint8_t>(std::clamp(um / unit, 0.0, 255.0));
  }
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

Field::Field(const SupportSettings& settings, const Object& object, const Stack& stack, const std::vector<KeepOut>&) {
  beside_ = beside(settings, object);
  size_up(settings, object, stack);
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
    auto down = spread(plate_.back(), reach_[slab]);
    for (std::size_t i = 0; i < down.size(); ++i) down[i] = std::min(down[i], clear[slab][i]);
    plate_.push_back(std::move(down));
    if (!everywhere) continue;
    down = spread(any_.back(), reach_[slab]);
    for (std::size_t i = 0; i < down.size(); ++i)
      down[i] = std::min(barred_[slab - 1][i] == 2 ? std::uint8_t{255} : down[i], clear[slab][i]);
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
