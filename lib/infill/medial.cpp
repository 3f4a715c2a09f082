// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/medial.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "geometry/spatial_index.h"
#include "infill/distance_transform.h"
#include "infill/fermat.h"
#include "infill/few_points.h"
#include "infill/gap_widths.h"
#include "infill/level_set.h"
#include "infill/web.h"

#include <algorithm>
#include <cmath>

namespace weft::infill {
namespace {

constexpr double cells_apart = 5;    // in the distance of lines
constexpr double most_nodes = 4e5;   // of the grid
constexpr double flat = 0.65;        // slope of the distance below which a place is on the axis; 0.71 at right angles
constexpr double smooth_rounds = 2;  // means over neighbours: the axis is known to half a cell
constexpr double narrowest = 0.5, widest = 1.7;

/// How far a place is on the way from the wall, 0, to the axis, 1; negative outside.
class Between {
 public:
  Between(const Region& region, double spacing)
      : from_(box_of(region.outer).min),
        grid_({{0, 0}, size_of(region)}, cell_of(region, spacing)),
        wall_(grid_.columns * grid_.rows, 0) {
    find_wall(region);
    find_axis();
  }
  bool any() const { return deepest_ > 0; }
  /// Distance from wall to axis, mean over the region, µm.
  double depth() const { return mean_; }
  double greatest_depth() const { return greatest_; }

  /// What lies farther in than a share.
  Regions beyond(double share) const {
    std::vector<double> over(u_.size());
    for (std::size_t n = 0; n < u_.size(); ++n) over[n] = u_[n] - share;
    std::vector<Ring> rings;
    for (const Curve& curve : zero_curves(grid_, over)) {
      if (!curve.closed) continue;
      Polyline ring;
      for (const Turned t : curve.points) ring.push_back(from_ + Point{rounded(t.x), rounded(t.y)});
      rings.push_back(few_points(ring, true, curve_tolerance));
    }
    std::erase_if(rings, [](const Ring& ring) { return ring.size() < 3; });
    return geometry::regions_from_rings(rings);
  }
  /// How steep u is there, a µm.
  double slope(Point p) const {
    const double x = (p.x - from_.x - grid_.min.x) / grid_.step, y = (p.y - from_.y - grid_.min.y) / grid_.step;
    const auto at = [&](double v, std::size_t count) {
      return static_cast<std::size_t>(std::clamp(std::round(v), 1.0, static_cast<double>(count) - 2));
    };
    const std::size_t i = at(x, grid_.columns), j = at(y, grid_.rows);
    const double gx = u_[j * grid_.columns + i + 1] - u_[j * grid_.columns + i - 1],
                 gy = u_[(j + 1) * grid_.columns + i] - u_[(j - 1) * grid_.columns + i];
    return std::hypot(gx, gy) / (2 * grid_.step);
  }

 private:
  static Turned size_of(const Region& region) {
    const Point size = box_of(region.outer).size();
    return {static_cast<double>(size.x), static_cast<double>(size.y)};
  }
  static double cell_of(const Region& region, double spacing) {
    const Turned size = size_of(region);
    return std::max(spacing / cells_apart, std::sqrt(size.x * size.y / most_nodes));
  }
  Point node(std::size_t i, std::size_t j) const { return from_ + Point{rounded(grid_.x(i)), rounded(grid_.y(j))}; }

  void find_wall(const Region& region) {
    const geometry::SegmentIndex edges(Regions{region});
    const double far =
        std::hypot(grid_.step * static_cast<double>(grid_.columns), grid_.step * static_cast<double>(grid_.rows));
    StopNowAndThen stop(4);
    for (std::size_t j = 0; j < grid_.rows; ++j) {
      stop.step();
      for (std::size_t i = 0; i < grid_.columns; ++i) {
        const Point p = node(i, j);
        const auto near = edges.nearest(p, far);
        if (!near) continue;
        const bool inside = edges.region_at(p).has_value();
        const double d = near->distance_um;
        wall_[j * grid_.columns + i] = inside ? d : -d;
        if (inside) deepest_ = std::max(deepest_, d);
      }
    }
  }

  bool on_axis(std::size_t i, std::size_t j) const {
    if (i == 0 || j == 0 || i + 1 >= grid_.columns || j + 1 >= grid_.rows) return false;
    const std::size_t n = j * grid_.columns + i;
    if (wall_[n] < 1.5 * grid_.step) return false;
    const double gx = wall_[n + 1] - wall_[n - 1], gy = wall_[n + grid_.columns] - wall_[n - grid_.columns];
    return std::hypot(gx, gy) / (2 * grid_.step) < flat;
  }

  void find_axis() {
    const std::size_t columns = grid_.columns, rows = grid_.rows;
    constexpr double far = 1e12;
    std::vector<double> axis(wall_.size(), far);
    bool found = false;
    for (std::size_t j = 0; j < rows; ++j)
      for (std::size_t i = 0; i < columns; ++i)
        if (on_axis(i, j)) axis[j * columns + i] = 0, found = true;
    if (!found)  // as narrow as a cell: its deepest places
      for (std::size_t n = 0; n < wall_.size(); ++n)
        if (wall_[n] >= deepest_ * 0.999) axis[n] = 0;
    const auto sweep = [&](std::size_t count, std::size_t stride, std::size_t start) {
      std::vector<double> f(count), out(count);
      for (std::size_t n = 0; n < count; ++n) f[n] = axis[start + n * stride];
      lower_envelope(f, out);
      for (std::size_t n = 0; n < count; ++n) axis[start + n * stride] = out[n];
    };
    for (std::size_t j = 0; j < rows; ++j) sweep(columns, 1, j * columns);
    for (std::size_t i = 0; i < columns; ++i) sweep(rows, columns, i);
    double sum = 0;
    std::size_t inside = 0;
    u_.assign(wall_.size(), -1);
    for (std::size_t n = 0; n < wall_.size(); ++n) {
      const double to_axis = std::sqrt(axis[n]) * grid_.step;
      if (wall_[n] <= 0) {
        u_[n] = wall_[n] / std::max(deepest_, 1.0);
        continue;
      }
      u_[n] = wall_[n] / (wall_[n] + to_axis);
      sum += wall_[n] + to_axis, ++inside;
      greatest_ = std::max(greatest_, wall_[n] + to_axis);
    }
    mean_ = inside > 0 ? sum / static_cast<double>(inside) : 0;
    for (int round = 0; round < smooth_rounds; ++round) smooth();
  }
  void smooth() {
    std::vector<double> out = u_;
    for (std::size_t j = 1; j + 1 < grid_.rows; ++j)
      for (std::size_t i = 1; i + 1 < grid_.columns; ++i) {
        const std::size_t n = j * grid_.columns + i;
        if (wall_[n] <= 0) continue;
        out[n] = (4 * u_[n] + u_[n - 1] + u_[n + 1] + u_[n - grid_.columns] + u_[n + grid_.columns]) / 8;
      }
    u_ = std::move(out);
  }

  Point from_;
  LevelGrid grid_;
  std::vector<double> wall_, u_;
  double deepest_ = 0, mean_ = 0, greatest_ = 0;
};

}  // namespace

void fill_medial(const Region& region, const SparseStyle& style, Beads& beads) {
  const double spacing = style.band / style.density;
  const Between between(region, spacing);
  if (!between.any()) return;
  const double count = std::max(1.0, std::round(between.depth() / spacing));
  // in sharp corners walls and axis are nearer than a line is wide
  constexpr double nearest_wall = 0.35;  // bands
  const Regions room = geometry::offset({region}, {.by = -rounded(nearest_wall * style.band)});
  std::vector<Regions> levels;
  for (int k = 0; k < static_cast<int>(count); ++k) {
    Regions level = geometry::intersect(between.beyond((k + 0.5) / count), room);
    if (level.empty()) break;
    levels.push_back(std::move(level));
  }
  const std::vector<Ring> lines =
      spirals_through(std::move(levels), between.greatest_depth() / count, tolerance_of(style.density));
  double way = 0;
  for (const Ring& line : lines) way += perimeter_of(line);
  if (way <= 0) return;
  const double wanted = style.density * area_mm2(region) * 1e6 / style.band;
  const Um width = std::max(1, rounded(style.band * std::clamp(wanted / way, least_narrowing, 1 / least_narrowing)));
  const std::size_t from = beads.size();
  for (const Ring& line : lines) {
    if (line.size() < 3) continue;
    Bead& bead = beads.emplace_back();
    bead.role = Role::infill, bead.part = style.part, bead.closed = true;
    for (const Point p : line) bead.path.push_back({p, width, static_cast<float>(style.layers)});
  }
  follow_gaps(
      [&](Point p) { return std::clamp(1 / std::max(between.slope(p) * count, 1e-9) / spacing, narrowest, widest); },
      2 * spacing, from, beads);
}

}  // namespace weft::infill
