// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/noise.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace weft::noise {
namespace {

/// A number by chance of a cell. Source: S. Vigna, SplitMix64's mixing.
std::uint64_t hash(std::uint64_t seed, std::int64_t x, std::int64_t y, std::int64_t z) {
  std::uint64_t h = seed;
  for (const std::int64_t v : {x, y, z}) {
    h += 0x9E3779B97F4A7C15U + static_cast<std::uint64_t>(v);
    h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9U;
    h = (h ^ (h >> 27)) * 0x94D049BB133111EBU;
    h ^= h >> 31;
  }
  return h;
}

/// 0 … 1, of 21 bits from `shift` on.
double part(std::uint64_t h, int shift) {
  constexpr std::uint64_t bits = (std::uint64_t{1} << 21) - 1;
  return static_cast<double>((h >> shift) & bits) / static_cast<double>(bits);
}

double fade(double t) {
  return t * t * t * (t * (t * 6 - 15) + 10);
}
double mix(double a, double b, double t) {
  return a + t * (b - a);
}

/// What a corner's gradient, one of twelve towards the edges of a cube, makes of the way from it.
double slope(std::uint64_t h, double x, double y, double z) {
  const auto edge = h % 12;
  const double u = edge < 8 ? x : y, v = edge < 4 ? y : z;
  return ((h >> 8 & 1U) != 0 ? u : -u) + ((h >> 9 & 1U) != 0 ? v : -v);
}

double waves(std::uint64_t seed, Place at) {
  const double fx = std::floor(at.x), fy = std::floor(at.y), fz = std::floor(at.z);
  const auto x = static_cast<std::int64_t>(fx), y = static_cast<std::int64_t>(fy), z = static_cast<std::int64_t>(fz);
  const double u = at.x - fx, v = at.y - fy, w = at.z - fz;
  const auto corner = [&](int i, int j, int k) { return slope(hash(seed, x + i, y + j, z + k), u - i, v - j, w - k); };
  const double a = fade(u), b = fade(v), c = fade(w);
  return mix(mix(mix(corner(0, 0, 0), corner(1, 0, 0), a), mix(corner(0, 1, 0), corner(1, 1, 0), a), b),
             mix(mix(corner(0, 0, 1), corner(1, 0, 1), a), mix(corner(0, 1, 1), corner(1, 1, 1), a), b), c);
}

/// Octaves of what `shape` makes of waves, −1 … 1.
template <class F>
double octaves_of(std::uint64_t seed, Place at, int octaves, F shape) {
  double sum = 0, all = 0, height = 1;
  for (int i = 0; i < octaves; ++i) {
    sum += height * shape(waves(seed + static_cast<std::uint64_t>(i), at)), all += height;
    at = {2 * at.x, 2 * at.y, 2 * at.z}, height /= 2;
  }
  return std::clamp(sum / all, -1.0, 1.0);
}

}  // namespace

double perlin(std::uint64_t seed, Place at, int octaves) {
  constexpr double to_one = 1.2;  // waves hardly pass 0.85
  return octaves_of(seed, at, octaves, [](double v) { return to_one * v; });
}

double billow(std::uint64_t seed, Place at, int octaves) {
  constexpr double to_one = 2.4;
  return octaves_of(seed, at, octaves, [](double v) { return std::min(to_one * std::abs(v), 2.0) - 1; });
}

double ridged(std::uint64_t seed, Place at, int octaves) {
  return octaves_of(seed, at, octaves, [](double v) {
    const double crest = std::max(1 - 1.2 * std::abs(v), 0.0);
    return 2 * crest * crest - 1;
  });
}

double voronoi(std::uint64_t seed, Place at) {
  const auto x = static_cast<std::int64_t>(std::floor(at.x)), y = static_cast<std::int64_t>(std::floor(at.y)),
             z = static_cast<std::int64_t>(std::floor(at.z));
  double least = std::numeric_limits<double>::infinity(), height = 0;
  for (std::int64_t i = x - 1; i <= x + 1; ++i)
    for (std::int64_t j = y - 1; j <= y + 1; ++j)
      for (std::int64_t k = z - 1; k <= z + 1; ++k) {
        const std::uint64_t h = hash(seed, i, j, k);
        const double dx = static_cast<double>(i) + part(h, 0) - at.x, dy = static_cast<double>(j) + part(h, 21) - at.y,
                     dz = static_cast<double>(k) + part(h, 42) - at.z;
        const double d2 = dx * dx + dy * dy + dz * dz;
        if (d2 < least) least = d2, height = 2 * part(hash(h, i, j, k), 0) - 1;
      }
  return height;
}

}  // namespace weft::noise
