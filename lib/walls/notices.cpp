// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/flow.h"
#include "walls/walls.h"

#include <algorithm>

#include <fmt/format.h>

namespace weft::walls {

Notices check(const WallSettings& settings, Um nozzle_diameter, Um height) {
  constexpr double least_share = 0.2;  // of a line: a strand so thin breaks off
  const Um line =
      std::min(length_or(settings.wall_line_width_0, nozzle_diameter, flow::automatic_outer_width(nozzle_diameter)),
               length_or(settings.wall_line_width_x, nozzle_diameter, flow::automatic_width(nozzle_diameter, height)));
  Notices notices;
  const auto judge = [&](const char* key, const LengthOrShare& value) {
    const Um width = value.of(nozzle_diameter);
    if (width < least_share * line)
      notices.push_back(
          {"wall_width_too_small",
           fmt::format("{}: {:.3f} mm is less than a fifth of the line width, {:.3f} mm: walls are not made "
                       "narrower than min_output_width, {:.3f} mm",
                       key, to_mm(width), to_mm(line), to_mm(settings.min_output_width))});
  };
  judge("min_wall_line_width", settings.min_wall_line_width);
  if (settings.min_even_wall_line_width) judge("min_even_wall_line_width", *settings.min_even_wall_line_width);
  if (settings.min_odd_wall_line_width) judge("min_odd_wall_line_width", *settings.min_odd_wall_line_width);
  return notices;
}

}  // namespace weft::walls
