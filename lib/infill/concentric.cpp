// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/concentric.h"

#include "core/stop.h"
#include "geometry/offset.h"
#include "geometry/spatial_index.h"
#include "infill/eikonal.h"
#include "infill/few_points.h"
#include "infill/level_set.h"
#include "infill/scan.h"
#include "infill/web.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace weft::infill {
namespace {

void add_loops(const std::vector<Ring>& loops, Um width, const SparseStyle& style, Beads& beads) {
  for (const Ring& loop : loops) {
    Bead& bead = beads.emplace_back();
    bead.role = Role::infill, bead.part = style.part, bead.closed = true;
    bead.path.reserve(loop.size());
    for (const Point p : loop) bead.path.push_back({p, width, static_cast<float>(style.layers)});
  }
}

/// A region on a grid, and the density there.
class DenseGround {
 public:
  DenseGround(const Region& region, const SparseStyle& style, const Density& density)
      : region_(region), from_(box_of(region.outer).min), size_(box_of(region.outer).size()) {
    look_at(style, density);
    find_ground(style);
  }

  /// How many loops lie between the edge and each node; negative outside.
  const std::vector<double>& loops_before() const { return u_; }
  const LevelGrid& grid() const { return grid_; }
  Point on_plane(Turned t) const { return from_ + Point{rounded(t.x), rounded(t.y)}; }

 private:
  static constexpr double look_step = 1000;  // µm, between places that the density is asked at
  static constexpr double least = 0.005;     // what is less is nothing

  Span2 span() const { return {{0, 0}, {static_cast<double>(size_.x), static_cast<double>(size_.y)}}; }

  void look_at(const SparseStyle& style, const Density& density) {
    rho_.reserve(coarse_.columns * coarse_.rows);
    for (std::size_t j = 0; j < coarse_.rows; ++j) {
      stop_if_asked();
      for (std::size_t i = 0; i < coarse_.columns; ++i)
        rho_.push_back(std::max(least, density.at(on_plane({coarse_.x(i), coarse_.y(j)}), style.z)));
    }
    // four nodes from loop to loop where they are nearest
    constexpr double nodes_apart = 4, most_nodes = 4e5;
    const double nearest = style.band / *std::max_element(rho_.begin(), rho_.end());
    grid_ = LevelGrid(span(), std::max(nearest / nodes_apart, std::sqrt(double(size_.x) * size_.y / most_nodes)));
  }

  double density_at(double x, double y) const {
    const double u = (x - coarse_.min.x) / coarse_.step, v = (y - coarse_.min.y) / coarse_.step;
    const auto i = static_cast<std::size_t>(std::clamp(u, 0.0, static_cast<double>(coarse_.columns) - 2)),
               j = static_cast<std::size_t>(std::clamp(v, 0.0, static_cast<double>(coarse_.rows) - 2));
    const double a = u - static_cast<double>(i), b = v - static_cast<double>(j);
    const double* row = &rho_[j * coarse_.columns + i];
    return std::lerp(std::lerp(row[0], row[1], a), std::lerp(row[coarse_.columns], row[coarse_.columns + 1], a), b);
  }

  void find_ground(const SparseStyle& style) {
    constexpr double outside = -0.25;  // of a loop: less than the half that one would lie at
    u_.assign(grid_.columns * grid_.rows, outside);
    const Outline outline(region_, Frame(0, from_));
    for (const Interval& i : outline.cut({grid_.y(0), grid_.step, static_cast<int>(grid_.rows)})) {
      const auto first = static_cast<std::size_t>(std::ceil((i.from - grid_.min.x) / grid_.step)),
                 last = static_cast<std::size_t>(std::floor((i.to - grid_.min.x) / grid_.step));
      double* row = &u_[static_cast<std::size_t>(i.line) * grid_.columns];
      for (std::size_t k = first; k <= last; ++k) row[k] = unreached;
    }
    std::vector<double> slowness(u_.size());
    for (std::size_t j = 0; j < grid_.rows; ++j)
      for (std::size_t i = 0; i < grid_.columns; ++i)
        slowness[j * grid_.columns + i] = density_at(grid_.x(i), grid_.y(j)) / style.band;
    start_at_edge(slowness);
    sweep_front(grid_, slowness, u_);
    for (double& each : u_)
      if (each >= unreached) each = outside;
  }

  /// Beside the edge the way to it is straight.
  void start_at_edge(const std::vector<double>& slowness) {
    const geometry::SegmentIndex edges(Regions{region_});
    const std::size_t columns = grid_.columns;
    std::vector<std::size_t> beside;
    for (std::size_t n = columns + 1; n + columns + 1 < u_.size(); ++n) {
      if (u_[n] < 0) continue;
      for (const std::size_t row : {n - columns, n, n + columns})
        if (u_[row - 1] < 0 || u_[row] < 0 || u_[row + 1] < 0) {
          beside.push_back(n);
          break;
        }
    }
    for (const std::size_t n : beside)
      if (const auto near = edges.nearest(on_plane({grid_.x(n % columns), grid_.y(n / columns)})))
        u_[n] = near->distance_um * slowness[n];
  }

  const Region& region_;
  Point from_, size_;
  LevelGrid coarse_{span(), look_step}, grid_{span(), look_step};
  std::vector<double> rho_, u_;
};

}  // namespace

void fill_concentric(const Region& region, const SparseStyle& style, Beads& beads) {
  // rings side by side, and the middles of two such groups
  const double among = style.multiplier - 1.0, spacing = style.multiplier * style.band / style.density;
  std::vector<Ring> loops;
  double way = 0;
  Regions rest{region};
  for (int i = 0; !rest.empty(); ++i) {
    const double step = i % style.multiplier != 0
                            ? style.band
                            : (i == 0 ? spacing / 2 - among / 2 * style.band : spacing - among * style.band);
    rest = geometry::offset(rest, {.by = -std::max(1, rounded(step))});
    for (Region& r : rest) {
      loops.push_back(r.outer);
      loops.insert(loops.end(), r.holes.begin(), r.holes.end());
    }
  }
  std::erase_if(loops, [&](const Ring& loop) { return perimeter_of(loop) < style.band; });
  for (Ring& loop : loops) loop = few_points(loop, true, tolerance_of(style.density));
  for (const Ring& loop : loops) way += perimeter_of(loop);
  if (way <= 0) return;
  const double wanted = style.density * area_mm2(region) * 1e6 / style.band;  // length of beads
  const Um width = std::max(1, rounded(style.band * std::clamp(wanted / way, least_narrowing, 1 / least_narrowing)));
  add_loops(loops, width, style, beads);
}

void fill_concentric(const Region& region, const SparseStyle& style, const Density& density, Beads& beads) {
  const DenseGround ground(region, style, density);
  // all lines k + ½ at once
  std::vector<double> wave;
  wave.reserve(ground.loops_before().size());
  for (const double u : ground.loops_before()) wave.push_back(std::cos(std::numbers::pi * u));
  std::vector<Ring> loops;
  for (const Curve& curve : zero_curves(ground.grid(), wave)) {
    Ring ring;
    for (const Turned t : curve.points) ring.push_back(ground.on_plane(t));
    ring = few_points(ring, true, tolerance_of(style.density));
    if (curve.closed && ring.size() > 2 && perimeter_of(ring) >= style.band) loops.push_back(std::move(ring));
  }
  add_loops(loops, style.band, style, beads);
}

}  // namespace weft::infill
