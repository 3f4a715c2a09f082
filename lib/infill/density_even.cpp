// SPDX-License-Identifier: GPL-3.0-or-later
// How widths of lines follow a density that varies: at each place, and so that joints and what lies close is made up
// for around them.
#include "core/stop.h"
#include "geometry/spatial_index.h"
#include "infill/density.h"
#include "infill/scan.h"
#include "infill/web.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace weft::infill {
namespace {

constexpr double longest_even = 1000;  // µm of a line along which its width stays
constexpr double least_change = 0.02;  // of a width: less is not worth a point
constexpr double finest = 1000;        // µm, of cells that plastic is counted in
constexpr double few = 12;             // cells over what is small
constexpr Um any_width = std::numeric_limits<Um>::max();

Point between(Point a, Point b, double t) {
  return {rounded(std::lerp(a.x, b.x, t)), rounded(std::lerp(a.y, b.y, t))};
}

/// Of shares along a line, those that others between cannot be told from: the farthest off is kept, and so on.
void keep_needed(const std::vector<double>& shares, std::size_t first, std::size_t last, std::vector<char>& kept) {
  double worst = least_change;
  std::size_t at = first;
  for (std::size_t k = first + 1; k < last; ++k) {
    const double t = static_cast<double>(k - first) / static_cast<double>(last - first);
    const double off = std::abs(shares[k] - std::lerp(shares[first], shares[last], t));
    if (off > worst) worst = off, at = k;
  }
  if (at == first) return;
  kept[at] = 1;
  keep_needed(shares, first, at, kept), keep_needed(shares, at, last, kept);
}

/// Widths are multiplied by what that says of each place; none becomes wider than `most`, or than it was.
template <class Share>
void widen(const Share& share, Um most, std::size_t from, Beads& beads) {
  for (std::size_t b = from; b < beads.size(); ++b) {
    stop_if_asked();
    Bead& bead = beads[b];
    std::vector<Junction> path;
    const std::size_t count = bead.path.size();
    const auto add = [&](Junction j, double by) {
      j.width = std::max(1, std::min(rounded(j.width * by), std::max(most, j.width)));
      path.push_back(j);
    };
    for (std::size_t i = 0; i < count; ++i) {
      const Junction& a = bead.path[i];
      add(a, share(a.at));
      if (i + 1 == count && !bead.closed) break;
      const Junction& c = bead.path[(i + 1) % count];
      const auto pieces = static_cast<std::size_t>(std::ceil(distance(a.at, c.at) / longest_even));
      if (pieces < 2) continue;
      std::vector<double> shares;
      const auto place = [&](std::size_t k) {
        return between(a.at, c.at, static_cast<double>(k) / static_cast<double>(pieces));
      };
      for (std::size_t k = 0; k <= pieces; ++k) shares.push_back(share(place(k)));
      std::vector<char> kept(shares.size(), 0);
      keep_needed(shares, 0, pieces, kept);
      for (std::size_t k = 1; k < pieces; ++k)
        if (kept[k] != 0) {
          const double t = static_cast<double>(k) / static_cast<double>(pieces);
          add({place(k), rounded(std::lerp(a.width, c.width, t)), a.flow}, shares[k]);
        }
    }
    bead.path = std::move(path);
  }
}

/// Numbers of square cells over a box.
struct Cells {
  Point from;
  double size = 1;  ///< µm, of a cell
  std::size_t columns = 0, rows = 0;
  std::vector<double> values{};

  Cells(const Box& box, double size_um) : from(box.min), size(size_um) {
    columns = static_cast<std::size_t>(std::ceil(box.size().x / size)), columns = std::max<std::size_t>(columns, 1);
    rows = static_cast<std::size_t>(std::ceil(box.size().y / size)), rows = std::max<std::size_t>(rows, 1);
    values.assign(columns * rows, 0);
  }
  static std::size_t index(double v, std::size_t count) {
    return static_cast<std::size_t>(std::clamp(v, 0.0, static_cast<double>(count) - 1));
  }
  double& of(Point p) {
    return values[index((p.y - from.y) / size, rows) * columns + index((p.x - from.x) / size, columns)];
  }
  /// Linear between middles of cells.
  double at(Point p) const {
    const double u = std::clamp((p.x - from.x) / size - 0.5, 0.0, static_cast<double>(columns) - 1),
                 v = std::clamp((p.y - from.y) / size - 0.5, 0.0, static_cast<double>(rows) - 1);
    const auto i = static_cast<std::size_t>(u), j = static_cast<std::size_t>(v);
    const std::size_t right = i + 1 < columns ? 1 : 0, up = j + 1 < rows ? columns : 0;
    const double* here = &values[j * columns + i];
    const double a = u - static_cast<double>(i), b = v - static_cast<double>(j);
    return std::lerp(std::lerp(here[0], here[right], a), std::lerp(here[up], here[up + right], a), b);
  }
};

/// The mean around each cell, of as many as `reach` says of it on each side. Cost: O(cells).
/// Source: Crow 1984, "Summed-area tables for texture mapping".
std::vector<double> means_around(const Cells& of, const std::vector<std::size_t>& reach) {
  const std::size_t columns = of.columns, rows = of.rows, wide = columns + 1;
  std::vector<double> sums(wide * (rows + 1), 0), out(of.values.size());
  for (std::size_t j = 0; j < rows; ++j)
    for (std::size_t i = 0; i < columns; ++i)
      sums[(j + 1) * wide + i + 1] =
          of.values[j * columns + i] + sums[j * wide + i + 1] + sums[(j + 1) * wide + i] - sums[j * wide + i];
  for (std::size_t j = 0; j < rows; ++j)
    for (std::size_t i = 0; i < columns; ++i) {
      const std::size_t r = reach[j * columns + i];
      const std::size_t x0 = i - std::min(i, r), x1 = std::min(i + r + 1, columns), y0 = j - std::min(j, r),
                        y1 = std::min(j + r + 1, rows);
      const double side = 2.0 * static_cast<double>(r) + 1;
      out[j * columns + i] =
          (sums[y1 * wide + x1] - sums[y0 * wide + x1] - sums[y1 * wide + x0] + sums[y0 * wide + x0]) / (side * side);
    }
  return out;
}

/// Twice, so that what is farther off counts less.
std::vector<double> smooth(Cells cells, const std::vector<std::size_t>& reach) {
  cells.values = means_around(cells, reach);
  return means_around(cells, reach);
}

/// What beads lay in each cell, µm².
/// @param share of their widths at a place
template <class Share>
Cells laid_by(const Beads& beads, std::size_t from, Cells cells, const Share& share) {
  std::fill(cells.values.begin(), cells.values.end(), 0);
  for (std::size_t b = from; b < beads.size(); ++b) {
    const std::vector<Junction>& path = beads[b].path;
    for (std::size_t i = 0; i + (beads[b].closed ? 0 : 1) < path.size(); ++i) {
      const Junction &a = path[i], &c = path[(i + 1) % path.size()];
      const double way = distance(a.at, c.at);
      const int pieces = std::max(1, static_cast<int>(std::ceil(2 * way / cells.size)));
      for (int k = 0; k < pieces; ++k) {
        const double t = (k + 0.5) / pieces;
        const Point p = between(a.at, c.at, t);
        cells.of(p) += way / pieces * std::lerp(a.width, c.width, t) * share(p);
      }
    }
  }
  return cells;
}

double sum_of(const Cells& cells) {
  double out = 0;
  for (const double v : cells.values) out += v;
  return out;
}

/// What a region is to hold, by cells, and how far around each of them lines are looked at.
struct Wanted {
  Cells plastic, share;
  std::vector<std::size_t> reach{};
  double least = 1, most = 0;  ///< density
  bool varies() const { return most > least * (1 + least_change); }
};

/// Both are summed in the same cells, so that a cell that the edge cuts asks for what it has room for.
template <class DensityAt>
Wanted wanted_in(const Region& region, Um band, const DensityAt& density) {
  constexpr double lines = 1.5;           // on each side of a place, twice (see smooth)
  constexpr std::size_t least_reach = 3;  // cells: widths are not to change from line to line
  const Box box = weft::box_of(region.outer);
  const double narrow = std::max(1, std::min(box.size().x, box.size().y));
  Wanted out{Cells(box, std::min(finest, narrow / few)), Cells(box, std::min(finest, narrow / few))};
  Cells &plastic = out.plastic, area = plastic;
  const Frame frame(0, box.min);
  const double apart = static_cast<double>(box.size().y) / static_cast<double>(plastic.rows);
  for (const Interval& i : Outline(region, frame).cut({apart / 2, apart, static_cast<int>(plastic.rows)})) {
    const double pieces = std::ceil((i.to - i.from) / plastic.size), wide = (i.to - i.from) / pieces,
                 y = apart * (i.line + 0.5);
    for (double k = 0.5; k < pieces; ++k) {
      const Point p = frame.back({i.from + k * wide, y});
      const double here = density(p);
      out.least = std::min(out.least, here), out.most = std::max(out.most, here);
      plastic.of(p) += here * wide * apart, area.of(p) += wide * apart;
    }
  }
  out.reach.assign(plastic.values.size(), 0);
  for (std::size_t n = 0; n < out.reach.size(); ++n)
    if (plastic.values[n] > 0)
      out.reach[n] = std::max(
          least_reach, static_cast<std::size_t>(lines * band * area.values[n] / plastic.values[n] / plastic.size));
  std::fill(out.share.values.begin(), out.share.values.end(), 1);
  return out;
}

constexpr double narrowest = 0.7, widest = 1.42;  // of a line between two levels

double share_of_width(double density, double level) {
  return std::clamp(density / level, narrowest, widest);
}

}  // namespace

void Density::follow(double level, double z_um, std::size_t from, Beads& beads) const {
  widen([&](Point p) { return share_of_width(at(p, z_um), level); }, any_width, from, beads);
}

void Density::follow(const std::vector<DenseLevel>& levels, double z_um, std::size_t from, Beads& beads) const {
  std::vector<geometry::SegmentIndex> denser;
  for (std::size_t k = 1; k < levels.size(); ++k) denser.emplace_back(levels[k].within);
  const auto level_at = [&](Point p) {
    std::size_t k = denser.size();
    while (k > 0 && !denser[k - 1].region_at(p)) --k;
    return levels[k].density;
  };
  widen([&](Point p) { return share_of_width(at(p, z_um), level_at(p)); }, any_width, from, beads);
}

void Density::even(const Region& region, double z_um, Um band, bool alike, std::size_t from, Beads& beads) const {
  if (from >= beads.size()) return;
  Wanted wanted = wanted_in(region, band, [&](Point p) { return at(p, z_um); });
  const auto share = [&](Point p) { return wanted.share.at(p); };
  // what is made up for in one place is missing or too much beside it; where the density is alike, so are widths
  const int rounds = alike || !wanted.varies() ? 0 : 3;
  constexpr double most = 1 / least_narrowing;
  const std::vector<double> asked = smooth(wanted.plastic, wanted.reach);
  for (int k = 0; k < rounds; ++k) {
    const std::vector<double> laid = smooth(laid_by(beads, from, wanted.plastic, share), wanted.reach);
    for (std::size_t n = 0; n < laid.size(); ++n)
      if (laid[n] > 0 && asked[n] > 0)
        wanted.share.values[n] = std::clamp(wanted.share.values[n] * asked[n] / laid[n], least_narrowing, most);
  }
  const double all = sum_of(laid_by(beads, from, wanted.plastic, share));
  const double rest = all > 0 ? std::clamp(sum_of(wanted.plastic) / all, least_narrowing, most) : 1;
  widen([&](Point p) { return rest * share(p); }, rounded(widest * band), from, beads);
}

}  // namespace weft::infill
