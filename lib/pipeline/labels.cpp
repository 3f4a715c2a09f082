// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/labels.h"

#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace weft::pipeline {

std::vector<ObjectLabel> labels_of(const Plate& plate) {
  struct Count {
    std::size_t all = 0, named = 0;
  };
  std::map<std::string, Count> counts;
  for (const auto& object : plate.objects) counts[object.name].all += object.copies.size();
  std::vector<ObjectLabel> out;
  for (const auto& object : plate.objects) {
    for (std::size_t copy = 0; copy < object.copies.size(); ++copy) {
      Ring outline = object.hull;
      for (auto& p : outline) p = p + object.copies[copy];
      const Point centre = box_of(outline).centre();
      auto& count = counts[object.name];
      out.push_back({count.all == 1 ? object.name : fmt::format("{}_{}", object.name, ++count.named), centre,
                     std::move(outline)});
    }
  }
  return out;
}

}  // namespace weft::pipeline
