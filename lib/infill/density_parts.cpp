// SPDX-License-Identifier: GPL-3.0-or-later
// How a region is parted by a density that varies.
#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "infill/density.h"
#include "infill/dither.h"
#include "infill/level_set.h"
#include "infill/mask.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace weft::infill {
namespace {

constexpr Um step = 1000;  // between places that a layer's density is looked at
constexpr double half = 0.5;
constexpr double nothing = -30;  // level of no density

/// What of a part is too narrow for lines so far apart: of them there would be stubs.
Regions too_narrow(const Regions& part, double apart_um) {
  Regions out = geometry::subtract(part, geometry::opening(part, rounded(apart_um / 2), geometry::Corner::miter));
  std::erase_if(out, [&](const Region& r) { return 1e6 * area_mm2(r) < apart_um * apart_um / 4; });
  return out;
}

}  // namespace

struct Density::Levels {
  Point from;
  LevelGrid grid;
  std::vector<double> level;
  double least = 1e9, most = -1e9;
};

Density::Levels Density::levels_of(const Box& box, double z_um) const {
  Levels out{
      box.min, LevelGrid({{0, 0}, {static_cast<double>(box.size().x), static_cast<double>(box.size().y)}}, step), {}};
  out.level.resize(out.grid.columns * out.grid.rows);
  for (std::size_t j = 0; j < out.grid.rows; ++j) {
    stop_if_asked();
    for (std::size_t i = 0; i < out.grid.columns; ++i) {
      const double rho = at(out.from + Point{rounded(out.grid.x(i)), rounded(out.grid.y(j))}, z_um);
      const double l = rho > 0 ? std::log2(rho / base()) : nothing;
      out.level[j * out.grid.columns + i] = l;
      out.least = std::min(out.least, l), out.most = std::max(out.most, l);
    }
  }
  return out;
}

InfillPattern Density::pattern_at(double density) const {
  InfillPattern out = infill_.infill_pattern;
  for (const PatternFrom& each : patterns_)
    if (density >= each.density) out = each.pattern;
  return out;
}

std::vector<Density::Part> Density::parts(const Region& region, double z_um, std::size_t layer) const {
  return infill_.infill_density_dither == DensityDither::none ? by_isolines(region, z_um)
                                                              : by_cells(region, z_um, layer);
}

Regions Density::above(const Levels& levels, double end) {
  const LevelGrid& grid = levels.grid;
  std::vector<double> over(levels.level.size(), -1);
  for (std::size_t j = 1; j + 1 < grid.rows; ++j)
    for (std::size_t i = 1; i + 1 < grid.columns; ++i)
      over[j * grid.columns + i] = std::clamp(levels.level[j * grid.columns + i] - end, -1.0, 1.0);
  std::vector<Ring> rings;
  for (const Curve& curve : zero_curves(grid, over)) {
    Ring& ring = rings.emplace_back();
    for (const Turned t : curve.points) ring.push_back(levels.from + Point{rounded(t.x), rounded(t.y)});
  }
  // what is narrower than the places that were looked at are apart is no part of its own
  return geometry::opening(geometry::regions_from_rings(rings), step / 2, geometry::Corner::miter);
}

/// From the densest on. What of a part is too narrow for its lines goes to both its neighbours.
std::vector<Density::Part> Density::by_isolines(const Region& region, double z_um) const {
  const Levels levels = levels_of(weft::box_of(region.outer), z_um);
  // where a level ends, or a pattern
  std::vector<double> ends;
  for (double k = std::floor(levels.most + half); k > std::floor(levels.least + half); --k) ends.push_back(k - half);
  for (const PatternFrom& each : patterns_)
    if (each.density > 0)
      if (const double l = std::log2(each.density / base()); l > levels.least && l <= levels.most) ends.push_back(l);
  std::sort(ends.begin(), ends.end(), std::greater<>());
  std::vector<Part> out;
  const auto level_at = [&](double middle) { return base() * std::exp2(std::floor(middle + half)); };
  const auto add = [&](Regions regions, double middle) {
    for (Region& r : regions)
      out.push_back({std::move(r), level_at(middle), pattern_at(base() * std::exp2(middle)), false});
  };
  const double line = length_or(infill_.infill_line_width, nozzle_, nozzle_);
  Regions rest{region}, denser;
  double upper = levels.most, middle_of_denser = 0;
  for (const double end : ends) {
    if (rest.empty()) break;
    const double middle = (end + upper) / 2;
    upper = end;
    Regions part = geometry::intersect(rest, above(levels, end));
    if (const Regions narrow = denser.empty() ? Regions{} : too_narrow(part, line / level_at(middle));
        !narrow.empty()) {
      part = geometry::subtract(part, narrow);
      const Regions up = geometry::intersect(narrow, above(levels, middle));
      denser = geometry::unite(denser, up), rest = geometry::subtract(rest, up);
    }
    if (part.empty()) continue;
    rest = geometry::subtract(rest, part);
    add(std::exchange(denser, std::move(part)), middle_of_denser);
    middle_of_denser = middle;
  }
  add(std::move(denser), middle_of_denser);
  add(std::move(rest), (std::min(levels.least, upper) + upper) / 2);
  return out;
}

/// Cells that a line of the coarsest level meets, on one lattice for the whole object.
std::vector<Density::Part> Density::by_cells(const Region& region, double z_um, std::size_t layer) const {
  constexpr double cell_lines = 1.2, least_cell = 3000;
  const Box box = weft::box_of(region.outer);
  const Levels levels = levels_of(box, z_um);
  const double line = length_or(infill_.infill_line_width, nozzle_, nozzle_);
  const double coarsest = base() * std::exp2(std::floor(std::clamp(levels.least, -2.0, 2.0)));
  const Um cell = rounded(std::max(least_cell, cell_lines * line / coarsest));
  const auto cells_before = [&](Um v) { return static_cast<long>(std::floor(static_cast<double>(v) / cell)); };
  const long x0 = cells_before(box.min.x), y0 = cells_before(box.min.y);
  const Grid grid{{static_cast<Um>(x0 * cell), static_cast<Um>(y0 * cell)},
                  cell,
                  static_cast<int>(cells_before(box.max.x) - x0) + 1,
                  static_cast<int>(cells_before(box.max.y) - y0) + 1};
  Dithered cells{static_cast<std::size_t>(grid.columns), static_cast<std::size_t>(grid.rows), {}, {}, {}};
  for (int j = 0; j < grid.rows; ++j)
    for (int i = 0; i < grid.columns; ++i) {
      const double rho =
          std::max(at(grid.origin + Point{rounded((i + half) * cell), rounded((j + half) * cell)}, z_um), 0.001);
      const double low = base() * std::exp2(std::floor(std::log2(rho / base()) + 1e-9));
      cells.wanted.push_back(std::max(rho, low)), cells.low.push_back(low), cells.high.push_back(2 * low);
    }
  const std::vector<bool> high = infill_.infill_density_dither == DensityDither::blue_noise
                                     ? blue_noise(cells, x0, y0, layer)
                                     : floyd_steinberg(cells);
  std::map<double, Mask> by_level;
  for (std::size_t n = 0; n < high.size(); ++n) {
    Mask& mask = by_level.try_emplace(high[n] ? cells.high[n] : cells.low[n], grid).first->second;
    mask.set(static_cast<int>(n % cells.columns), static_cast<int>(n / cells.columns));
  }
  std::vector<Part> out;
  for (const auto& [level, mask] : by_level)
    for (Region& r : geometry::intersect(geometry::regions_from_rings(mask.outlines()), {region}))
      out.push_back({std::move(r), level, pattern_at(level), true});
  return out;
}

}  // namespace weft::infill
