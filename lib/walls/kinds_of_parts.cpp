// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/kinds_of_parts.h"

#include <algorithm>
#include <utility>

namespace weft::walls {
namespace {

constexpr std::size_t most_kinds = 8;
constexpr std::size_t most_corners = 200;  // a copy of what is larger would take memory

bool alike(const Region& a, const Region& b) {
  if (a.outer.size() != b.outer.size() || !b.holes.empty()) return false;
  const Point by = b.outer.front() - a.outer.front();
  return std::equal(a.outer.begin(), a.outer.end(), b.outer.begin(), [&](Point p, Point q) { return p + by == q; });
}

}  // namespace

std::optional<Part> KindsOfParts::again(const Region& region, std::uint32_t part) const {
  for (const Kind& kind : kinds_) {
    if (!alike(*kind.region, region)) continue;
    const Point by = region.outer.front() - kind.region->outer.front();
    Part out = kind.made;
    for (Bead& bead : out.beads) {
      bead.part = part;
      for (Junction& j : bead.path) j.at = j.at + by;
    }
    out.inside = moved(std::move(out.inside), by);
    out.left_out.at = out.left_out.at + by;
    return out;
  }
  return {};
}

void KindsOfParts::add(const Region& region, const Part& made) {
  if (region.outer.size() > most_corners || !region.holes.empty()) return;
  if (kinds_.size() < most_kinds) kinds_.emplace_back();
  kinds_[next_++ % most_kinds] = {&region, made};
}

}  // namespace weft::walls
