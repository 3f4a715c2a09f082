// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/head_profile.h"

#include "settings/groups/machine.h"
#include "settings/groups/plate.h"
#include "settings/value.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace weft {

std::vector<HeadSlab> parse_head_profile(std::string_view text) {
  std::vector<HeadSlab> out;
  while (!value::trimmed(text).empty()) {
    const auto end = std::min(text.find(';'), text.size());
    const auto part = value::trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (part.empty()) continue;
    const auto colon = part.find(':');
    if (colon == std::string_view::npos)
      throw std::invalid_argument("is not a list of heights with polygons such as 0: -10x-10, 10x-10, 10x10, -10x10");
    HeadSlab slab;
    double height_mm = 0;
    value::parse(part.substr(0, colon), Unit::none, height_mm);
    value::parse(part.substr(colon + 1), Unit::none, slab.outline);
    if (!(height_mm >= 0 && height_mm <= 1000)) throw std::invalid_argument("has a height that is not 0 … 1000 mm");
    slab.from = from_mm(height_mm);
    if (!out.empty() && slab.from <= out.back().from) throw std::invalid_argument("has heights that do not ascend");
    if (slab.outline.size() < 3 || double_area(slab.outline) == 0 || !is_simple(slab.outline))
      throw std::invalid_argument("has an outline that crosses itself or encloses nothing");
    if (double_area(slab.outline) < 0) std::reverse(slab.outline.begin(), slab.outline.end());
    out.push_back(std::move(slab));
  }
  return out;
}

std::vector<HeadSlab> head_of(const PlateSettings& plate, const MachineSettings& machine) {
  auto out = parse_head_profile(plate.machine_head_profile);
  if (!plate.gantry_height || out.empty()) return out;
  Box head;
  for (const auto& slab : out) head.add(weft::box_of(slab.outline));
  const Box bed = weft::box_of(print_surface(machine));
  const Um wide = 2 * std::max(bed.size().x, bed.size().y);
  Box bar = head;
  if (plate.gantry_axis == GantryAxis::x)
    bar.min.x = -wide, bar.max.x = wide;
  else
    bar.min.y = -wide, bar.max.y = wide;
  out.push_back({*plate.gantry_height, {bar.min, {bar.max.x, bar.min.y}, bar.max, {bar.min.x, bar.max.y}}});
  return out;
}

}  // namespace weft
