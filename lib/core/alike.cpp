// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/alike.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

namespace weft {
namespace {

/// A number that regions alike have in common, and hardly others.
std::uint64_t shape_of(const Region& region) {
  const Point from = region.outer.front();
  std::uint64_t out = region.outer.size();
  const auto add = [&](const Ring& ring) {
    for (const Point p : ring) {
      const Point at = p - from;
      const std::uint64_t both =
          std::uint64_t{static_cast<std::uint32_t>(at.x)} << 32 | static_cast<std::uint32_t>(at.y);
      out = (out ^ both) * 0x9e3779b97f4a7c15;  // Fibonacci hashing: the odd number next to 2⁶⁴ / golden ratio
      out ^= out >> 29;
    }
  };
  add(region.outer);
  for (const Ring& hole : region.holes) add(hole);
  return out;
}

bool alike(const Region& a, const Region& b) {
  if (a.holes.size() != b.holes.size()) return false;
  const Point by = b.outer.front() - a.outer.front();
  const auto moved = [by](const Ring& ring, const Ring& to) {
    return std::equal(ring.begin(), ring.end(), to.begin(), to.end(), [by](Point p, Point q) { return p + by == q; });
  };
  return moved(a.outer, b.outer) && std::equal(a.holes.begin(), a.holes.end(), b.holes.begin(), moved);
}

}  // namespace

std::vector<std::size_t> first_alike(const Regions& regions) {
  std::vector<std::size_t> out(regions.size());
  std::iota(out.begin(), out.end(), std::size_t{0});
  if (regions.size() < 2) return out;
  std::vector<std::pair<std::uint64_t, std::size_t>> shapes;
  shapes.reserve(regions.size());
  for (std::size_t i = 0; i < regions.size(); ++i) shapes.emplace_back(shape_of(regions[i]), i);
  std::sort(shapes.begin(), shapes.end());
  for (std::size_t k = 1; k < shapes.size(); ++k)
    for (std::size_t before = k; before-- > 0 && shapes[before].first == shapes[k].first;) {
      const std::size_t first = out[shapes[before].second];
      if (!alike(regions[first], regions[shapes[k].second])) continue;  // another shape that has the same number
      out[shapes[k].second] = first;
      break;
    }
  return out;
}

}  // namespace weft
