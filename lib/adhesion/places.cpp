// SPDX-License-Identifier: GPL-3.0-or-later
#include "adhesion/places.h"

#include "adhesion/ears.h"
#include "geometry/boolean.h"
#include "geometry/offset.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace weft::adhesion {
namespace {

using namespace weft::literals;

constexpr Um arc_tolerance = 0.025_mm;
constexpr Um rounding = 2;  // of Booleans, along slanted edges

Region disc(Point centre, Um radius) {
  constexpr int corners = 48;
  Region out;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    out.outer.push_back({centre.x + rounded(radius * std::cos(angle)), centre.y + rounded(radius * std::sin(angle))});
  }
  return out;
}

/// What a disc of that width does not reach, but for the corners of what it does.
Regions narrower_than(Um width, const Regions& united) {
  const Regions wide = geometry::opening(united, width / 2, geometry::Corner::round);
  Regions out = geometry::opening(geometry::subtract(united, wide), rounding);
  // What a disc leaves of corners that are no sharper than right angles: (1 − π/4) of its radius squared.
  const double r_mm = to_mm(width) / 2, corner_mm2 = 0.25 * r_mm * r_mm;
  std::erase_if(out, [&](const Region& region) { return area_mm2(region) < corner_mm2; });
  return out;
}

}  // namespace

std::optional<Regions> brim_places(const AdhesionSettings& settings, const Regions& outlines) {
  if (!settings.brim_ears && settings.brim_narrow_width == 0) return std::nullopt;
  const Regions united = geometry::unite(outlines);
  const Um reach = settings.brim_gap + settings.brim_width;
  Regions out;
  if (settings.brim_ears)
    for (const Point tip : tips_of(united, settings.brim_ears_max_angle)) out.push_back(disc(tip, reach));
  if (settings.brim_narrow_width > 0) {
    auto narrow = geometry::offset(narrower_than(settings.brim_narrow_width, united),
                                   {.by = reach, .corner = geometry::Corner::round, .arc_tolerance = arc_tolerance});
    std::move(narrow.begin(), narrow.end(), std::back_inserter(out));
  }
  return geometry::unite(out);
}

}  // namespace weft::adhesion
