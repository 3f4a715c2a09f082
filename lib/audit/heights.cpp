// SPDX-License-Identifier: GPL-3.0-or-later
#include "audit/heights.h"

#include "core/convex_hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace weft::audit {
namespace {

constexpr double finest_mm = 0.25;
constexpr double most_cells = 1.6e7;
constexpr int factor = 4;  // cells along a side of one of the next level

/// Pieces of a curve, each as a chord.
template <class F>
void for_each_chord(const Path& path, double longest_mm, F&& f) {
  const int pieces =
      path.arc ? std::max(1, static_cast<int>(std::min(1e4, std::ceil(length_mm(path) / longest_mm)))) : 1;
  Vec from = path.from;
  for (int i = 1; i <= pieces; ++i) {
    const Vec to = i == pieces ? path.to : at(path, static_cast<double>(i) / pieces);
    f(from, to, static_cast<double>(i - 1) / pieces, static_cast<double>(i) / pieces);
    from = to;
  }
}

/// Takes the interval in which lines cross the strip |b·x + c| <= by; false when it is empty.
bool clip(double b, double c, double low, double high, double& least, double& most) {
  if (b == 0) return c >= low && c <= high;
  double from = (low - c) / b, to = (high - c) / b;
  if (from > to) std::swap(from, to);
  least = std::max(least, from), most = std::min(most, to);
  return least <= most;
}

}  // namespace

Heights::Heights(const Bounds& area_mm) : origin_(area_mm.min) {
  const Vec size = area_mm.max - area_mm.min;
  const double cell = std::max(finest_mm, std::sqrt(size.x * size.y / most_cells));
  Level level{cell, static_cast<int>(std::ceil(size.x / cell)) + 1, static_cast<int>(std::ceil(size.y / cell)) + 1, {}};
  for (;;) {
    level.top_mm.assign(static_cast<std::size_t>(level.columns) * static_cast<std::size_t>(level.rows), 0);
    levels_.push_back(level);
    if (level.columns <= factor && level.rows <= factor) return;
    level.cell_mm *= factor;
    level.columns = (level.columns + factor - 1) / factor, level.rows = (level.rows + factor - 1) / factor;
  }
}

void Heights::raise(int x, int y, float top_mm) {
  for (auto& level : levels_) {
    float& top = level.top_mm[level.index(x, y)];
    if (top >= top_mm) return;
    top = top_mm;
    x /= factor, y /= factor;
  }
}

void Heights::lay(Vec from, Vec to, double half_width_mm, double top_mm) {
  highest_mm_ = std::max(highest_mm_, top_mm);
  const Level& finest = levels_.front();
  // Cells whose middle the bead covers; of one that is narrower than a cell those that it leads through.
  const double cell = finest.cell_mm, r = std::max(half_width_mm, cell * std::numbers::sqrt2 / 2);
  const Vec a = from - origin_, b = to - origin_;
  const double length = norm(b - a);
  const Vec along = length > 0 ? (1 / length) * (b - a) : Vec{1, 0}, across{-along.y, along.x};
  const auto row = [&](double y) { return std::clamp(static_cast<int>(std::floor(y / cell)), 0, finest.rows - 1); };
  const int first = row(std::min(a.y, b.y) - r), last = row(std::max(a.y, b.y) + r);
  for (int y = first; y <= last; ++y) {
    const double middle = (y + 0.5) * cell;
    double low = 1e300, high = -1e300;
    for (const Vec p : {a, b})
      if (const double dy = middle - p.y; std::abs(dy) <= r) {
        const double dx = std::sqrt(r * r - dy * dy);
        low = std::min(low, p.x - dx), high = std::max(high, p.x + dx);
      }
    double least = -1e300, most = 1e300;
    if (clip(across.x, across.y * (middle - a.y) - across.x * a.x, -r, r, least, most) &&
        clip(along.x, along.y * (middle - a.y) - along.x * a.x, 0, length, least, most) && most < 1e299)
      low = std::min(low, least), high = std::max(high, most);
    if (low > high) continue;
    const int begin = std::max(0, static_cast<int>(std::ceil(low / cell - 0.5)));
    const int end = std::min(finest.columns - 1, static_cast<int>(std::floor(high / cell - 0.5)));
    for (int x = begin; x <= end; ++x) raise(x, y, static_cast<float>(top_mm));
  }
}

/// A convex shape on its way: what it covers lies within bounds along some directions, and boxes that do on all of them
/// are met. Source: Gottschalk, Lin and Manocha, "OBBTree" (separating axes).
class Heights::Sweep {
 public:
  Sweep(std::span<const Vec> shape, Vec from, Vec to) {
    const auto add = [&](Vec axis) {
      double low = 1e300, high = -1e300;
      for (const Vec corner : shape) low = std::min(low, dot(corner, axis)), high = std::max(high, dot(corner, axis));
      const double p = dot(from, axis), q = dot(to, axis);
      axes_[count_++] = {axis, low + std::min(p, q), high + std::max(p, q)};
    };
    add({1, 0}), add({0, 1});
    if (from.x != to.x || from.y != to.y) add({from.y - to.y, to.x - from.x});
    for (std::size_t i = 0; i < shape.size() && count_ < axes_.size(); ++i) {
      const Vec edge = shape[(i + 1) % shape.size()] - shape[i];
      if (edge.x != 0 && edge.y != 0) add({edge.y, -edge.x});
    }
  }
  bool meets(Vec low, double side) const {
    const double half = side / 2;
    const Vec middle{low.x + half, low.y + half};
    for (std::size_t i = 0; i < count_; ++i) {
      const auto& [axis, least, most] = axes_[i];
      const double at = dot(middle, axis), reach = half * (std::abs(axis.x) + std::abs(axis.y));
      if (at + reach < least || at - reach > most) return false;
    }
    return true;
  }
  /// Its box, to begin with.
  Vec low() const { return {axes_[0].least, axes_[1].least}; }
  Vec high() const { return {axes_[0].most, axes_[1].most}; }

 private:
  struct Axis {
    Vec axis;
    double least = 0, most = 0;
  };
  std::array<Axis, 24> axes_;  // with fewer than a shape has edges it is seen a little too large
  std::size_t count_ = 0;
};

void Heights::search(const Sweep& sweep, std::size_t level, int x, int y, double& above_mm,
                     std::optional<Found>& out) const {
  const Level& own = levels_[level];
  const double top = own.top_mm[own.index(x, y)];
  const Vec low = origin_ + Vec{x * own.cell_mm, y * own.cell_mm};
  if (top <= above_mm || !sweep.meets(low, own.cell_mm)) return;
  if (level == 0) {
    above_mm = top;
    out = Found{top, low + Vec{own.cell_mm / 2, own.cell_mm / 2}};
    return;
  }
  const Level& finer = levels_[level - 1];
  for (int v = y * factor; v < std::min((y + 1) * factor, finer.rows); ++v)
    for (int u = x * factor; u < std::min((x + 1) * factor, finer.columns); ++u)
      search(sweep, level - 1, u, v, above_mm, out);
}

std::optional<Heights::Found> Heights::above(std::span<const Vec> shape, Vec from, Vec to, double height_mm) const {
  if (highest_mm_ <= height_mm) return std::nullopt;
  const Sweep sweep(shape, from, to);
  const std::size_t level = levels_.size() - 1;
  const Level& coarsest = levels_.back();
  const auto cell = [&](double v, double origin, int count) {
    return std::clamp(static_cast<int>(std::floor((v - origin) / coarsest.cell_mm)), 0, count - 1);
  };
  std::optional<Found> out;
  const int x1 = cell(sweep.high().x, origin_.x, coarsest.columns), y1 = cell(sweep.high().y, origin_.y, coarsest.rows);
  for (int y = cell(sweep.low().y, origin_.y, coarsest.rows); y <= y1; ++y)
    for (int x = cell(sweep.low().x, origin_.x, coarsest.columns); x <= x1; ++x)
      search(sweep, level, x, y, height_mm, out);
  return out;
}

HeadWatch::HeadWatch(const std::vector<HeadSlab>& slabs, const Bounds& area_mm, double nozzle_mm) : heights_(area_mm) {
  if (slabs.empty() || slabs.front().from > 0) {
    const double r = nozzle_mm / 2;
    slabs_.push_back({0, {{-r, -r}, {r, -r}, {r, r}, {-r, r}}});
  }
  for (const auto& slab : slabs) {
    Slab own{to_mm(slab.from), {}};
    for (const Point p : convex_hull({slab.outline.begin(), slab.outline.end()}))
      own.shape.push_back({to_mm(p.x), to_mm(p.y)});
    slabs_.push_back(std::move(own));
  }
}

void HeadWatch::lay(const Path& path, Vec offset, double half_width_mm, double top_mm) {
  constexpr double chord_mm = 0.5;
  for_each_chord(path, chord_mm, [&](Vec from, Vec to, double, double) {
    heights_.lay(from + offset, to + offset, half_width_mm, top_mm);
  });
}

void HeadWatch::look(const Slab& slab, Vec from, Vec to, double z_mm, double passes_mm,
                     std::optional<Meeting>& out) const {
  const double underside = z_mm + slab.from_mm;
  const double deepest = out ? out->depth_mm : 0;
  const auto found = heights_.above(slab.shape, from, to, underside + std::max(passes_mm, deepest));
  if (found) out = Meeting{found->height_mm - underside, slab.from_mm, 0.5 * (from + to), found->at};
}

std::optional<HeadWatch::Meeting> HeadWatch::meets(const Path& path, double z_from_mm, double z_to_mm,
                                                   double passes_mm) const {
  std::optional<Meeting> out;
  if (heights_.highest_mm() <= std::min(z_from_mm, z_to_mm) + passes_mm) return out;
  constexpr double step_mm = 0.5, chord_mm = 1;  // upwards, and along a curve
  const double rise = z_to_mm - z_from_mm;
  for_each_chord(path, chord_mm, [&](Vec from, Vec to, double begin, double end) {
    const int steps = std::clamp(static_cast<int>(std::ceil(std::abs(rise) * (end - begin) / step_mm)), 1, 1000);
    for (int i = 0; i < steps; ++i) {
      const double t = static_cast<double>(i) / steps, u = static_cast<double>(i + 1) / steps;
      const double share = rise > 0 ? begin + t * (end - begin) : begin + u * (end - begin);
      const double z = z_from_mm + share * rise;  // the lower end of the piece
      for (const Slab& slab : slabs_) look(slab, from + t * (to - from), from + u * (to - from), z, passes_mm, out);
    }
  });
  return out;
}

}  // namespace weft::audit
