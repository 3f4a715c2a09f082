// SPDX-License-Identifier: GPL-3.0-or-later
#include "preview/colours.h"

#include "core/table.h"
#include "model/role.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace weft::preview {
namespace {

constexpr Rgb custom{90, 190, 200};
constexpr Rgb unknown{150, 150, 150};

constexpr std::array<Rgb, 6> viridis{
    {{68, 1, 84}, {65, 68, 135}, {42, 120, 142}, {34, 168, 132}, {122, 209, 81}, {253, 231, 37}}};

std::uint8_t mixed(std::uint8_t a, std::uint8_t b, double t) {
  return static_cast<std::uint8_t>(std::lround(a + (b - a) * t));
}

}  // namespace

Rgb colour_of(std::string_view feature) {
  for (const auto& row : roles)
    if (row.key == feature) return row.colour;
  return feature == "custom" ? custom : unknown;
}

Rgb colour_of(const Toolpaths& paths, const Stroke& stroke, Colour colour) {
  return colour == Colour::tool ? tool_colours[stroke.tool % tool_colours.size()]
                                : colour_of(paths.features[stroke.feature]);
}

Rgb ramp(double share) {
  const double at = std::clamp(share, 0.0, 1.0) * (viridis.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(at), viridis.size() - 2);
  const double t = at - static_cast<double>(i);
  const Rgb a = viridis[i], b = viridis[i + 1];
  return {mixed(a.r, b.r, t), mixed(a.g, b.g, t), mixed(a.b, b.b, t)};
}

Rgb darker(Rgb c) {
  auto tone = [](std::uint8_t v) { return static_cast<std::uint8_t>(v * 11 / 20); };
  return {tone(c.r), tone(c.g), tone(c.b)};
}

std::string css(Rgb c) {
  return fmt::format("#{:02x}{:02x}{:02x}", c.r, c.g, c.b);
}

namespace {

struct ColourRow {
  Colour colour;
  std::string_view name, unit;
};
constexpr std::array colour_rows{ColourRow{Colour::feature, "feature", ""}, ColourRow{Colour::tool, "tool", ""},
                                 ColourRow{Colour::width, "width", "mm"}, ColourRow{Colour::speed, "speed", "mm/s"},
                                 ColourRow{Colour::flow, "flow", "mm3/s"}};
static_assert(in_order(colour_rows, &ColourRow::colour), "row i of colour_rows is colour i");

}  // namespace

double measure(const Stroke& stroke, Colour colour) {
  switch (colour) {
    case Colour::feature:
    case Colour::tool:
      return 0;
    case Colour::width:
      return to_mm(stroke.width);
    case Colour::speed:
      return static_cast<double>(stroke.speed_mm_s);
    case Colour::flow:
      return static_cast<double>(stroke.flow_mm3_s);
  }
  return 0;
}

std::string_view name_of(Colour colour) {
  return row_of(colour_rows, colour).name;
}

std::optional<Colour> colour_named(std::string_view name) {
  for (const auto& row : colour_rows)
    if (row.name == name) return row.colour;
  return std::nullopt;
}

std::string_view unit_of(Colour colour) {
  return row_of(colour_rows, colour).unit;
}

Range range_of(const Toolpaths& paths, std::size_t first_layer, std::size_t last_layer, Colour colour) {
  double least = 1e300, most = -1e300;
  for (std::size_t i = first_layer; i <= last_layer && i < paths.layers.size(); ++i)
    for (const Stroke& stroke : paths.layers[i].strokes) {
      if (!stroke.extrudes() || paths.features[stroke.feature] == "custom") continue;
      least = std::min(least, measure(stroke, colour));
      most = std::max(most, measure(stroke, colour));
    }
  return least > most ? Range{} : Range{least, most};
}

}  // namespace weft::preview
