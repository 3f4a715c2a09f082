// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/purge.h"

#include "settings/tools.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace weft::tools {
namespace {

/// Where no colours are known: between filaments that are alike and a dark one before a light one.
constexpr double unknown_colours_mm3 = 140;

using Channels = std::array<double, 3>;

double linear(std::uint8_t v) {
  const double c = v / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

/// What a layer of plastic throws back: black one still 2 %, white one 92 %.
Channels reflectance(Rgb c) {
  return {0.02 + 0.90 * linear(c.r), 0.02 + 0.90 * linear(c.g), 0.02 + 0.90 * linear(c.b)};
}

Channels mixed(const Channels& into, const Channels& rest, double share) {
  Channels out{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto absorbed = [](double r) { return (1 - r) * (1 - r) / (2 * r); };  // K/S
    const double ks = (1 - share) * absorbed(into[i]) + share * absorbed(rest[i]);
    out[i] = 1 + ks - std::sqrt(ks * ks + 2 * ks);
  }
  return out;
}

/// CIE L*a*b*, D65, of linear sRGB.
Channels lab(const Channels& c) {
  const double x = (0.4124 * c[0] + 0.3576 * c[1] + 0.1805 * c[2]) / 0.9505,
               y = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2],
               z = (0.0193 * c[0] + 0.1192 * c[1] + 0.9505 * c[2]) / 1.089;
  const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
  return {116 * f(y) - 16, 500 * (f(x) - f(y)), 200 * (f(y) - f(z))};
}

double distance(const Channels& a, const Channels& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

}  // namespace

double difference(Rgb a, Rgb b) {
  return distance(lab({linear(a.r), linear(a.g), linear(a.b)}), lab({linear(b.r), linear(b.g), linear(b.b)}));
}

double purge_volume_mm3(Rgb from, Rgb to, double tolerance, double mix_mm3) {
  const auto into = reflectance(to), rest = reflectance(from);
  const auto wanted = lab(into);
  const auto seen = [&](double log_share) { return distance(lab(mixed(into, rest, std::exp(-log_share))), wanted); };
  if (seen(0) <= tolerance) return 0;
  double low = 0, high = 40;  // −ln of the share: more differs, less does not
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (seen(middle) > tolerance ? low : high) = middle;
  }
  return mix_mm3 * high;
}

Costs purge_volumes(const std::vector<Settings>& tools) {
  const std::size_t n = tools.size();
  Costs out(n, std::vector<double>(n, 0));
  const auto& plate = tools.front().tools;
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < n; ++b) {
      if (a == b) continue;
      const double least = tools[b].tools.prime_tower_min_volume;
      double volume = 0;
      if (nozzle_of(tools, a) == nozzle_of(tools, b)) {
        const auto &from = tools[a].tools.filament_colour, &to = tools[b].tools.filament_colour;
        if (plate.purge_volumes)
          volume = (*plate.purge_volumes)[a * n + b];
        else
          volume = from && to ? purge_volume_mm3(*from, *to, plate.purge_colour_tolerance, plate.purge_mix_volume)
                              : unknown_colours_mm3;
      }
      out[a][b] = std::max(volume, least);
    }
  return out;
}

std::vector<double> purge_matrix(const std::vector<Settings>& tools) {
  std::vector<double> out;
  if (tools.empty()) return out;
  for (const auto& row : purge_volumes(tools)) out.insert(out.end(), row.begin(), row.end());
  return out;
}

}  // namespace weft::tools
