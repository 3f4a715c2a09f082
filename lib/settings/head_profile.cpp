// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/head_profile.h"

#include "settings/groups/machine.h"
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

}  // namespace weft
