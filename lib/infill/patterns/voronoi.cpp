// SPDX-License-Identifier: GPL-3.0-or-later
// Borders between the cells of scattered points. Points repeat after a tile of so many cells, so that the same walls
// are drawn whatever the area. Three borders meet in a corner: of the shortest that there are, as many are drawn twice
// as let a line run through all of them, and lines go around in as few curves as that allows.
#include "core/stop.h"
#include "infill/patterns/cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace weft::infill {
namespace {

constexpr int across = 12;  // cells of a tile, of points in the plane
constexpr int around = 8;   // of points in space

/// 0 … 1, of a seed and a cell. Source: Steele, Lea & Flood 2014, "Fast splittable pseudorandom number generators".
double hashed(std::uint64_t v) {
  v += 0x9e3779b97f4a7c15ULL;
  v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9ULL;
  v = (v ^ (v >> 27)) * 0x94d049bb133111ebULL;
  return static_cast<double>((v ^ (v >> 31)) >> 11) * 0x1p-53;
}

constexpr int lloyd_steps = 3;

/// A point in each cell of the plane's tile, moved to the middle of what is nearest to it a few times.
std::vector<Site> scattered() {
  std::vector<Site> sites;
  for (int i = 0; i < across * across; ++i) {
    const auto cell = static_cast<std::uint64_t>(i);
    sites.push_back({i % across + hashed(2 * cell), i / across + hashed(2 * cell + 1), 0});
  }
  for (int step = 0; step < lloyd_steps; ++step) {
    std::vector<Site> moved = sites;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      const std::vector<Corner> cell = cell_of(sites, i, across);
      double area = 0, x = 0, y = 0;
      for (std::size_t k = 0; k < cell.size(); ++k) {
        const Turned a = cell[k].at, b = cell[(k + 1) % cell.size()].at;
        const double part = a.x * b.y - a.y * b.x;
        area += part, x += part * (a.x + b.x) / 3, y += part * (a.y + b.y) / 3;
      }
      if (area > 0) moved[i].x = x / area, moved[i].y = y / area;
    }
    sites = moved;
  }
  return sites;
}

struct SiteInSpace {
  std::array<double, 3> at{};
};

/// v shifted by whole tiles to be next to `to`.
double beside(double v, double to, double tile) {
  return v - tile * std::round((v - to) / tile);
}

/// The same in space; the middle of what is nearest is that of 4 × 4 × 4 places a cell.
std::vector<SiteInSpace> scattered_in_space() {
  constexpr int count = around * around * around, samples = 4;
  std::vector<SiteInSpace> sites(count);
  for (int i = 0; i < count; ++i)
    for (int k = 0; k < 3; ++k) {
      const int cell = k == 0 ? i % around : k == 1 ? i / around % around : i / (around * around);
      sites[static_cast<std::size_t>(i)].at[static_cast<std::size_t>(k)] =
          cell + hashed(1000 + 3 * static_cast<std::uint64_t>(i) + static_cast<std::uint64_t>(k));
    }
  constexpr int places = around * samples;
  for (int step = 0; step < lloyd_steps; ++step) {
    std::vector<std::array<double, 4>> sums(count, {0, 0, 0, 0});
    for (int n = 0; n < places * places * places; ++n) {
      const std::array<double, 3> p{(n % places + 0.5) / samples, (n / places % places + 0.5) / samples,
                                    (n / (places * places) + 0.5) / samples};
      std::size_t best = 0;
      double least = std::numeric_limits<double>::infinity();
      for (int dz = -1; dz <= 1; ++dz)
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) {
            const auto wrapped = [](double v, int d) { return (static_cast<int>(v) + d + around) % around; };
            const auto i =
                static_cast<std::size_t>(wrapped(p[0], dx) + around * (wrapped(p[1], dy) + around * wrapped(p[2], dz)));
            double d2 = 0;
            for (std::size_t k = 0; k < 3; ++k) {
              const double d = beside(sites[i].at[k], p[k], around) - p[k];
              d2 += d * d;
            }
            if (d2 < least) least = d2, best = i;
          }
      for (std::size_t k = 0; k < 3; ++k) sums[best][k] += beside(p[k], sites[best].at[k], around);
      ++sums[best][3];
    }
    for (std::size_t i = 0; i < sites.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        if (sums[i][3] > 0) sites[i].at[k] = sums[i][k] / sums[i][3];
  }
  return sites;
}

}  // namespace

Drawing draw_voronoi(const PatternPlace& p) {
  static const CellWalls walls(scattered(), across);
  const double cell = 2.5 * p.spacing();  // length of borders 1.9 for each cell's side, a third of them twice
  return walls.drawn(p, cell);
}

Drawing draw_voronoi_3d(const PatternPlace& p) {
  static const std::vector<SiteInSpace> sites = scattered_in_space();
  const double cell = 3 * p.spacing();
  constexpr double upright = 1.5;  // cells are as much higher than wide: walls flatter than 45° would fall
  const double z = p.z / (cell * upright);
  std::vector<Site> cut;
  constexpr double farthest = 2;  // cells above and below that still reach the height
  for (const SiteInSpace& site : sites) {
    const double off = beside(site.at[2], z, around) - z;
    if (std::abs(off) <= farthest) cut.push_back({site.at[0], site.at[1], -off * off});
  }
  return CellWalls(std::move(cut), around).drawn(p, cell);
}

}  // namespace weft::infill
