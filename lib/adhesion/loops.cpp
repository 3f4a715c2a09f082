// SPDX-License-Identifier: GPL-3.0-or-later
#include "adhesion/loops.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/clip_lines.h"
#include "geometry/offset.h"

#include <algorithm>

namespace weft::adhesion {
namespace {

using namespace weft::literals;

constexpr Um arc_tolerance = 0.025_mm;  // loops need no finer corners
constexpr Um rounding = 0.01_mm;        // loops along the edge of what they keep clear of do not count as inside it

Regions grown(const Regions& regions, double by_um) {
  return geometry::offset(regions,
                          {.by = rounded(by_um), .corner = geometry::Corner::round, .arc_tolerance = arc_tolerance});
}

Regions shrunk(const Regions& regions, double by_um) {
  return grown(regions, -by_um);
}

/// Islands without their holes, by how many holes they lie in: an island in a hole has a brim of its own.
std::vector<Regions> filled_by_depth(const Regions& outlines) {
  std::vector<Regions> depths;
  std::vector<Box> boxes;
  for (const Region& r : outlines) boxes.push_back(box_of(r.outer));
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    stop_if_asked();
    std::size_t depth = 0;
    for (std::size_t j = 0; j < outlines.size(); ++j) {
      if (i == j || outlines[j].holes.empty() || !boxes[j].contains(boxes[i].min) || !boxes[j].contains(boxes[i].max))
        continue;
      depth += std::any_of(outlines[j].holes.begin(), outlines[j].holes.end(),
                           [&](const Ring& hole) { return side_of(hole, outlines[i].outer.front()) == Side::inside; });
    }
    if (depths.size() <= depth) depths.resize(depth + 1);
    depths[depth].push_back({outlines[i].outer, {}});
  }
  return depths;
}

/// Holes as regions of their own.
Regions holes_of(const Regions& outlines) {
  Regions holes;
  for (const Region& region : outlines)
    for (const Ring& hole : region.holes) holes.push_back({Ring(hole.rbegin(), hole.rend()), {}});
  return holes;
}

void add_rings(const Regions& regions, bool outers, bool holes, int loop, std::vector<BrimLoop>& loops) {
  for (const Region& region : regions) {
    if (outers) loops.push_back({region.outer, true, loop});
    if (holes)
      for (const Ring& hole : region.holes) loops.push_back({hole, true, loop});
  }
}

}  // namespace

std::vector<BrimLoop> brim_loops(const Regions& outlines, BrimLocation location, Um gap, double band_um, int count,
                                 const Regions& others) {
  std::vector<BrimLoop> loops;
  const Regions united = geometry::unite(outlines);
  if (location == BrimLocation::everywhere && others.empty()) {
    for (int k = count - 1; k >= 0; --k) add_rings(grown(united, gap + (k + 0.5) * band_um), true, true, k, loops);
    return loops;
  }
  std::vector<BrimLoop> whole;
  const std::vector<Regions> islands = filled_by_depth(united);
  const Regions holes = holes_of(united);
  for (int k = count - 1; k >= 0; --k) {
    const double away = gap + (k + 0.5) * band_um;
    if (location == BrimLocation::everywhere)
      add_rings(grown(united, away), true, true, k, whole);
    else if (location == BrimLocation::inside)
      add_rings(shrunk(holes, away), true, false, k, whole);
    else
      for (const Regions& depth : islands) add_rings(grown(depth, away), true, false, k, whole);
  }
  const double clear = std::max(0.0, gap + band_um / 2 - rounding);
  const Regions forbidden = grown(others.empty() ? united : geometry::unite(united, others), clear);
  for (const BrimLoop& loop : whole) {
    std::vector<BrimLoop> pieces = cut_loop(loop, forbidden, false);
    loops.insert(loops.end(), std::make_move_iterator(pieces.begin()), std::make_move_iterator(pieces.end()));
  }
  return loops;
}

std::vector<BrimLoop> cut_loop(const BrimLoop& loop, const Regions& regions, bool keep_inside) {
  Polyline line = loop.line;
  if (loop.closed) line.push_back(line.front());
  const auto keep = keep_inside ? geometry::Keep::inside : geometry::Keep::outside;
  std::vector<geometry::Piece> pieces = geometry::clip_lines(std::span(&line, 1), regions, keep);
  if (pieces.size() == 1 && pieces[0].line == line) return {loop};
  if (loop.closed && pieces.size() > 1 && pieces.front().line.front() == line.front() &&
      pieces.back().line.back() == line.front()) {
    Polyline& last = pieces.back().line;
    last.insert(last.end(), pieces.front().line.begin() + 1, pieces.front().line.end());
    pieces.erase(pieces.begin());
  }
  std::vector<BrimLoop> result;
  for (geometry::Piece& piece : pieces) result.push_back({std::move(piece.line), false, loop.loop});
  return result;
}

}  // namespace weft::adhesion
