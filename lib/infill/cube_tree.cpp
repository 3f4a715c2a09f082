// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/cube_tree.h"

#include "core/stop.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

namespace weft::infill {
namespace {

constexpr double third = 2 * std::numbers::pi / 3;
const double flat = std::sqrt(2.0 / 3);       // of an edge of the cube, seen from above
const double rise = 1 / std::numbers::sqrt3;  // of an edge of the cube, seen from the side
const std::array<Turned, 3> along{Turned{flat, 0}, Turned{flat * std::cos(third), flat* std::sin(third)},
                                  Turned{flat * std::cos(2 * third), flat* std::sin(2 * third)}};

}  // namespace

/// A stretch of a cube's middle plane at a height: on the line of its axis and place, from t to t.
struct CubeTree::Piece {
  std::size_t axis = 0;
  std::int64_t place = 0;  // of the plane, in quarters of the least edge
  double from = 0, to = 0;
};

CubeTree::CubeTree(double spacing, double radius) : edge_(2 * std::sqrt(6.0) * spacing) {
  constexpr int most = 16;  // levels: 2^16 least edges are wider than any bed
  half_ = edge_;
  while (half_ < radius && levels_ < most) half_ *= 2, ++levels_;
  split_.resize(static_cast<std::size_t>(levels_) + 1);
}

std::uint64_t CubeTree::key(Cell c) {
  constexpr int bits = 20;
  const auto part = [](int v) { return static_cast<std::uint64_t>(v + (1 << 18)); };
  return part(c.x) | part(c.y) << bits | part(c.z) << (2 * bits);
}

CubeTree::Cell CubeTree::cell_of(double u, double v, double w, int level) const {
  const double e = std::ldexp(edge_, level);
  const auto place = [&](double t) { return static_cast<int>(std::floor((t + half_) / e)); };
  return {place(u), place(v), place(w)};
}

void CubeTree::add(double x, double y, double z) {
  std::array<double, 3> at{};
  for (std::size_t i = 0; i < 3; ++i) at[i] = x * along[i].x + y * along[i].y + z * rise;
  for (int level = 1; level <= levels_; ++level)
    if (!split_[static_cast<std::size_t>(level)].insert(key(cell_of(at[0], at[1], at[2], level))).second) return;
}

/// The neighbours of a cube that is split are there: what holds them is split.
void CubeTree::balance() {
  for (int level = 1; level < levels_; ++level) {
    const std::unordered_set<std::uint64_t>& here = split_[static_cast<std::size_t>(level)];
    std::unordered_set<std::uint64_t>& above = split_[static_cast<std::size_t>(level) + 1];
    for (const std::uint64_t k : here) {  // in any order: what comes of it is a set
      const auto part = [&](int i) { return static_cast<int>(k >> (20 * i) & 0xfffffU) - (1 << 18); };
      for (int dz = -1; dz <= 1; ++dz)
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) {
            const auto up = [](int v) { return v >> 1; };
            above.insert(key({up(part(0) + dx), up(part(1) + dy), up(part(2) + dz)}));
          }
    }
  }
}

void CubeTree::walk(Cell cell, int level, double z, std::vector<Piece>& pieces) const {
  const double e = std::ldexp(edge_, level);
  const std::array<double, 3> c{(cell.x + 0.5) * e - half_, (cell.y + 0.5) * e - half_, (cell.z + 0.5) * e - half_};
  const double sum = z / rise;  // of the three coordinates of a place at that height
  if (std::abs(sum - c[0] - c[1] - c[2]) > 1.5 * e) return;
  for (std::size_t i = 0; i < 3; ++i) {
    // on the plane the other two add up to what is left; t is their difference
    const double left = sum - c[i], a = c[(i + 1) % 3], b = c[(i + 2) % 3];
    const double from = std::max(2 * a - e - left, left - 2 * b - e), to = std::min(2 * a + e - left, left - 2 * b + e);
    if (from < to) pieces.push_back({i, std::llround(4 * c[i] / edge_), from, to});
  }
  if (level == 0 || !split_[static_cast<std::size_t>(level)].contains(key(cell))) return;
  for (int k = 0; k < 8; ++k)
    walk({2 * cell.x + (k & 1), 2 * cell.y + (k >> 1 & 1), 2 * cell.z + (k >> 2)}, level - 1, z, pieces);
}

std::vector<Curve> CubeTree::cut(double z) const {
  std::vector<Piece> pieces;
  walk({0, 0, 0}, levels_, z, pieces);
  std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) {
    return std::tie(a.axis, a.place, a.from, a.to) < std::tie(b.axis, b.place, b.from, b.to);
  });
  std::vector<Curve> out;
  const double sum = z / rise, together = edge_ * 1e-6;
  for (std::size_t k = 0; k < pieces.size();) {
    const Piece& first = pieces[k];
    double end = first.to;
    std::size_t n = k + 1;
    for (; n < pieces.size() && pieces[n].axis == first.axis && pieces[n].place == first.place &&
           pieces[n].from <= end + together;
         ++n)
      end = std::max(end, pieces[n].to);
    const auto at = [&](double t) {
      const double own = static_cast<double>(first.place) * edge_ / 4, left = sum - own;
      const std::size_t i = first.axis;
      const Turned p = along[i], q = along[(i + 1) % 3], r = along[(i + 2) % 3];
      const double u = (left + t) / 2, v = (left - t) / 2;
      return Turned{own * p.x + u * q.x + v * r.x, own * p.y + u * q.y + v * r.y};
    };
    out.push_back({{at(first.from), at(end)}, false});
    k = n;
  }
  return out;
}

}  // namespace weft::infill
