// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/branch_areas.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/spatial_index.h"
#include "support/columns.h"
#include "support/lengths.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace weft::support {
namespace {

/// A region of a level.
struct Piece {
  Region region;
  Box box;
  bool cut = false;  ///< it is not the discs as they are
};
using Pieces = std::vector<Piece>;

Box box_of(const Disc& disc) {
  return Box{disc.at, disc.at}.grown(rounded(disc.radius) + 1);
}

/// Discs whose boxes meet, directly or by others, together.
std::vector<std::vector<std::size_t>> clusters(const std::vector<Disc>& discs) {
  std::vector<std::size_t> order(discs.size()), root(discs.size());
  std::iota(order.begin(), order.end(), std::size_t{0}), std::iota(root.begin(), root.end(), std::size_t{0});
  const auto left = [&](std::size_t i) { return std::pair(discs[i].at.x - rounded(discs[i].radius), i); };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return left(a) < left(b); });
  const auto find = [&](std::size_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Box box = box_of(discs[order[i]]);
    for (std::size_t j = i + 1; j < order.size() && left(order[j]).first <= box.max.x; ++j)
      if (box.overlaps(box_of(discs[order[j]]))) {
        const auto a = find(order[i]), b = find(order[j]);
        root[std::max(a, b)] = std::min(a, b);
      }
  }
  std::vector<std::vector<std::size_t>> by_root(discs.size()), out;
  for (std::size_t i = 0; i < discs.size(); ++i) by_root[find(i)].push_back(i);
  for (auto& cluster : by_root)
    if (!cluster.empty()) out.push_back(std::move(cluster));
  return out;
}

/// Tells which discs are free of what is kept out, so that nothing is to be cut from them.
class Free {
 public:
  Free(const KeepOut& out, const Object& object)
      : barred_(barred(out)), room_(object.room ? *object.room : Regions{}), bounded_(object.room != nullptr) {}
  bool is(const Disc& disc) const {
    const double radius = disc.radius * 1.05 + 2;  // corners lie outside of the circle
    if (barred_.box().grown(rounded(radius)).overlaps(box_of(disc)) &&
        (barred_.nearest(disc.at, radius) || barred_.winding(disc.at).value_or(1) != 0))
      return false;
    return !bounded_ || (room_.region_at(disc.at) && !room_.nearest(disc.at, radius));
  }

 private:
  static Regions barred(const KeepOut& out) {
    Regions all = out.over;
    append(all, out.touch), append(all, out.near);
    return all;
  }
  geometry::SegmentIndex barred_, room_;
  bool bounded_;
};

Pieces pieces_of(const SupportSettings& s, const Object& object, const KeepOut& out, const Regions& contacts,
                 const std::vector<Disc>& discs) {
  Pieces pieces;
  if (discs.empty()) return pieces;
  const Free free(out, object);
  Regions to_cut;
  for (const auto& cluster : clusters(discs)) {
    const bool whole = std::all_of(cluster.begin(), cluster.end(), [&](std::size_t i) { return free.is(discs[i]); });
    std::vector<Ring> rings;
    for (const std::size_t i : cluster) rings.push_back(circle_around(discs[i]));
    Regions regions = rings.size() == 1 ? Regions{{std::move(rings.front()), {}}} : geometry::regions_from_rings(rings);
    if (!whole) {
      append(to_cut, regions);
      continue;
    }
    for (auto& region : regions) pieces.push_back({std::move(region), {}, false});
  }
  if (!to_cut.empty())
    for (auto& region :
         geometry::opening(free_part(to_cut, out, contacts, object), line_width(s, object.nozzle) * 4 / 10))
      pieces.push_back({std::move(region), {}, true});
  for (auto& piece : pieces) piece.box = weft::box_of(piece.region.outer);
  return pieces;
}

/// What of a level rests on the one below, or on the part. Whole discs lean so little that they do where those below
/// are whole.
void let_rest(const SupportSettings& s, const Object& object, const Stack& stack, std::size_t k, Pieces& here,
              const Pieces& below) {
  Pieces out;
  Regions doubtful;
  for (auto& piece : here) {
    const Box box = piece.box.grown(stack.levels[k].height);
    bool on_whole = false, on_cut = false;
    for (const auto& b : below)
      if (box.overlaps(b.box)) (b.cut ? on_cut : on_whole) = true;
    if (!piece.cut && on_whole && !on_cut)
      out.push_back(std::move(piece));
    else
      doubtful.push_back(std::move(piece.region));
  }
  if (!doubtful.empty()) {
    std::vector<Regions> two(2);
    for (const auto& b : below) two[0].push_back(b.region);
    two[1] = doubtful;
    rest_on(s, object, stack.levels[k], two[0], two[1]);
    for (auto& region : two[1]) {
      const Box box = weft::box_of(region.outer);
      out.push_back({std::move(region), box, true});
    }
  }
  here = std::move(out);
}

}  // namespace

Ring circle_around(const Disc& disc) {
  const int corners = std::clamp(static_cast<int>(10 * std::sqrt(disc.radius / 100)), 18, 72);
  const double outside = disc.radius / std::cos(std::numbers::pi / corners);
  Ring out;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    out.push_back({disc.at.x + rounded(outside * std::cos(angle)), disc.at.y + rounded(outside * std::sin(angle))});
  }
  return out;
}

std::vector<Regions> branch_areas(const SupportSettings& settings, const Object& object, const Stack& stack,
                                  const std::vector<KeepOut>& keep_out, const std::vector<Regions>& contacts,
                                  const std::vector<std::vector<Disc>>& discs) {
  auto levels = tasks::parallel_map(discs.size(), [&](std::size_t k) {
    stop_if_asked();
    return pieces_of(settings, object, keep_out[k], contacts[k], discs[k]);
  });
  std::vector<Regions> out(levels.size());
  for (std::size_t k = 0; k < levels.size(); ++k) {
    stop_if_asked();
    if (k > 0 && !levels[k].empty()) let_rest(settings, object, stack, k, levels[k], levels[k - 1]);
    if (k == 0) continue;
    for (const auto& piece : levels[k - 1]) out[k - 1].push_back(piece.region);
  }
  if (!levels.empty())
    for (auto& piece : levels.back()) out.back().push_back(std::move(piece.region));
  return out;
}

}  // namespace weft::support
