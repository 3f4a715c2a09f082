// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/fuzzy.h"

#include "core/noise.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace weft::walls {
namespace {

/// A corner of the outline turns by more, radians; what bends less is a curve.
constexpr double corner_turn = 0.6;
/// Points lie between so many and 2 − so many of their mean distance apart.
constexpr double nearest = 0.75;

/// Numbers by chance, 0 … 1, from whole numbers alone. Source: S. Vigna, SplitMix64.
class Chance {
 public:
  Chance(int seed, std::size_t index, std::size_t number)
      : state_(static_cast<std::uint64_t>(seed) * 0x9E3779B97F4A7C15U + index * 0xBF58476D1CE4E5B9U +
               number * 0x94D049BB133111EBU) {}
  double next() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15U;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1.0p-53;
  }

 private:
  std::uint64_t state_;
};

/// The angle between two edges, radians.
double turn_at(Point before, Point at, Point after) {
  const Point a = at - before, b = after - at;
  const double cross = static_cast<double>(std::int64_t{a.x} * b.y - std::int64_t{a.y} * b.x);
  return std::abs(std::atan2(cross, static_cast<double>(dot(a, b))));
}

/// A junction of the segment from a to b at t, moved by what stands off.
Junction moved(const WallSettings& settings, const Junction& a, const Junction& b, double t, double by) {
  Junction out{lerp(a.at, b.at, t), rounded(a.width + t * (static_cast<double>(b.width) - a.width)),
               static_cast<float>(a.flow + t * static_cast<double>(b.flow - a.flow))};
  if (settings.fuzzy_skin_mode == FuzzyMode::width) {
    const Um width = std::max(out.width + rounded(by), std::min(out.width, settings.min_output_width));
    by = (width - out.width) / 2.0;
    out.width = width;
  }
  const double length = distance(a.at, b.at), x = (b.at.x - a.at.x) / length, y = (b.at.y - a.at.y) / length;
  out.at = {out.at.x + rounded(by * y), out.at.y - rounded(by * x)};  // outwards is to the right
  return out;
}

/// What stands off there, −1 … 1.
double noise_at(const WallSettings& settings, const FuzzyPlace& place, Point at) {
  const double scale = settings.fuzzy_skin_scale;
  const noise::Place in_scale{(at.x - place.origin.x) / scale, (at.y - place.origin.y) / scale, place.z / scale};
  const auto seed = static_cast<std::uint64_t>(settings.fuzzy_skin_seed);
  switch (settings.fuzzy_skin_noise) {
    case FuzzyNoise::perlin:
      return noise::perlin(seed, in_scale, settings.fuzzy_skin_octaves);
    case FuzzyNoise::billow:
      return noise::billow(seed, in_scale, settings.fuzzy_skin_octaves);
    case FuzzyNoise::ridged:
      return noise::ridged(seed, in_scale, settings.fuzzy_skin_octaves);
    case FuzzyNoise::voronoi:
      return noise::voronoi(seed, in_scale);
    case FuzzyNoise::classic:
      break;
  }
  return 0;
}

}  // namespace

bool runs_outside(const Bead& bead) {
  std::int64_t area = 0;
  for (std::size_t i = 0, j = bead.path.size() - 1; i < bead.path.size(); j = i++)
    area += std::int64_t{bead.path[j].at.x} * bead.path[i].at.y - std::int64_t{bead.path[j].at.y} * bead.path[i].at.x;
  return area > 0;
}

void roughen(const WallSettings& settings, const FuzzyPlace& place, const std::function<bool(Point)>& keeps,
             Bead& bead) {
  const double apart = settings.magic_fuzzy_skin_point_dist, most = settings.magic_fuzzy_skin_thickness;
  if (1000 * length_mm(bead) < 3 * apart || bead.path.size() < 3) return;
  Chance chance(settings.fuzzy_skin_seed, place.index, place.number);
  const auto& path = bead.path;
  const std::size_t n = path.size();
  std::vector<Junction> out;
  double next = apart * chance.next();  // from the beginning of the segment
  for (std::size_t i = 0; i < n; ++i) {
    const Junction &before = path[(i + n - 1) % n], &a = path[i], &b = path[(i + 1) % n];
    if (turn_at(before.at, a.at, b.at) > corner_turn || keeps(a.at)) out.push_back(a);
    const double length = distance(a.at, b.at);
    for (; next < length; next += apart * (nearest + 2 * (1 - nearest) * chance.next())) {
      const Point at = lerp(a.at, b.at, next / length);
      const double by = most * (settings.fuzzy_skin_noise == FuzzyNoise::classic ? 2 * chance.next() - 1
                                                                                 : noise_at(settings, place, at));
      const bool stays = keeps(at);
      out.push_back(moved(settings, a, b, next / length, stays ? 0 : by));
    }
    next -= length;
  }
  if (out.size() >= 3) bead.path = std::move(out);
}

}  // namespace weft::walls
