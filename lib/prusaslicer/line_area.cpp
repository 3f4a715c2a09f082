// SPDX-License-Identifier: GPL-3.0-or-later
#include "prusaslicer/line_area.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace weft::prusaslicer {
namespace {

struct Row {
  std::string_view speed, width;
  double automatic;  ///< share of the nozzle
};
constexpr auto rows = std::to_array<Row>({
    {"speed_wall_0", "external_perimeter_extrusion_width", 1.125},
    {"speed_wall_x", "perimeter_extrusion_width", 1.125},
    {"speed_infill", "infill_extrusion_width", 1.125},
    {"speed_topbottom", "solid_infill_extrusion_width", 1.125},
    {"speed_top_skin", "top_infill_extrusion_width", 1.0},
});

}  // namespace

double line_area_mm2(Lines& lines, std::string_view speed, double nozzle, double height) {
  const double round = std::numbers::pi / 4;
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.speed == speed; });
  if (row == rows.end()) return round * nozzle * nozzle;
  double width = 0;
  for (const auto key : {row->width, std::string_view("extrusion_width")})
    if (const auto* e = lines.look(key); e && width == 0) width = lines.figure(*e).of(height);
  if (width == 0) width = row->automatic * nozzle;
  return std::max(1e-3, height * (width - height * (1 - round)));
}

}  // namespace weft::prusaslicer
