// SPDX-License-Identifier: GPL-3.0-or-later
#include "prusaslicer/bed.h"

#include "core/polygon.h"
#include "settings/value.h"

#include <cstdlib>
#include <stdexcept>

namespace weft::prusaslicer {

std::optional<std::vector<std::pair<std::string_view, std::string>>> bed_of(std::string_view points) {
  using namespace weft::literals;
  Ring bed;
  try {
    value::parse(points, Unit::mm, bed);
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
  const Box box = box_of(bed);
  const Point size = bed.empty() ? Point{} : box.max - box.min;
  const bool four = bed.size() == 4 && std::abs(double_area(bed)) == 2 * std::int64_t{size.x} * size.y;
  const bool centred = four && box.min.x == -box.max.x && box.min.y == -box.max.y;
  const bool rectangle = four && (box.min == Point{} || centred);
  std::vector<std::pair<std::string_view, std::string>> out{
      {"bed_shape", rectangle ? "rectangle" : "polygon"},
      {"bed_polygon", rectangle ? "" : value::print(bed, Unit::mm)},
      {"machine_center_is_zero", centred ? "true" : "false"}};
  if (size.x >= 1_mm && size.y >= 1_mm) {  // of another shape, what surrounds it; less is nobody's bed and refused as a
                                           // polygon
    out.emplace_back("machine_width", value::print(size.x, Unit::mm));
    out.emplace_back("machine_depth", value::print(size.y, Unit::mm));
  }
  return out;
}

}  // namespace weft::prusaslicer
