// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/branch_areas.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/spatial_index.h"
#include "geometry/touching.h"
#include "geometry/trimmed.h"
#include "support/lengths.h"
#include "support/resting.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace weft::support {
namespace {

/// A region of a level.
struct Piece {
  Region region;
  Box box;
  std::vector<Disc> discs;  ///< that it is; none: it is not all of them
};
using Pieces = std::vector<Piece>;

Box box_of(const Disc& disc) {
  return Box{disc.at, disc.at}.grown(rounded(disc.radius) + 1);
}

bool covers(const Piece& piece, Point p) {
  return piece.box.contains(p) && side_of(piece.region.outer, p) != Side::outside;
}

/// Tells which discs are free of the part and in the object's room, so that nothing is to be cut from them.
class Free {
 public:
  Free(const Room& room, const Stack::Level& level, const Box& near)
      : beside_(beside(room.settings(), room.object()) + 10), boundary_(room.object().room != nullptr) {
    const auto& s = room.settings();
    const auto& o = room.object();
    const Box wide = near.grown(beside_);
    part_ = geometry::SegmentIndex(room.part(level.bottom(), level.z, wide));
    Regions over = room.part(level.z, level.z + top_gap(s), near);
    if (level.bottom() > o.floor) {
      const Um step = std::max(s.support_bottom_stair_step_height, 0);  // a stair may begin so far below
      append(over, room.part(level.bottom() - bottom_gap(s) - step, level.bottom(), near));
    }
    if (s.support_blockers_avoided) append(over, blocked_between(o, level.bottom(), level.z));
    over_ = geometry::SegmentIndex(over);
    if (boundary_) bounds_ = geometry::SegmentIndex(geometry::trimmed(*o.room, near));
  }
  bool is(const Disc& disc) const {
    const double radius = disc.radius * 1.05 + 2;  // corners lie outside of the circle
    return clear(part_, disc.at, radius + beside_) && clear(over_, disc.at, radius) &&
           (!boundary_ || (bounds_.region_at(disc.at) && !bounds_.nearest(disc.at, radius)));
  }

 private:
  static bool clear(const geometry::SegmentIndex& index, Point at, double radius) {
    if (!index.box().grown(rounded(radius) + 1).contains(at)) return true;
    return !index.nearest(at, radius) && index.winding(at).value_or(1) == 0;
  }
  Um beside_;
  bool boundary_;
  geometry::SegmentIndex part_, over_, bounds_;
};

Pieces pieces_of(const Room& room, const Stack::Level& level, const Regions& contacts, const std::vector<Disc>& discs) {
  Pieces pieces;
  if (discs.empty()) return pieces;
  Box all;
  for (const Disc& disc : discs) all.add(box_of(disc));
  const Free free(room, level, all.grown(200));
  const Um thin = line_width(room.settings(), room.object().nozzle) * 4 / 10;
  std::vector<Box> boxes;
  for (const Disc& disc : discs) boxes.push_back(box_of(disc));
  for (const auto& cluster : geometry::touching(boxes)) {
    const bool whole = std::all_of(cluster.begin(), cluster.end(), [&](std::size_t i) { return free.is(discs[i]); });
    std::vector<Ring> rings;
    for (const std::size_t i : cluster) rings.push_back(circle_around(discs[i]));
    Regions regions = rings.size() == 1 ? Regions{{std::move(rings.front()), {}}} : geometry::regions_from_rings(rings);
    if (!whole) regions = opened(room.free_part(regions, level, contacts), thin);
    for (auto& region : regions) {
      Piece piece{std::move(region), {}, {}};
      piece.box = weft::box_of(piece.region.outer);
      if (whole)
        for (const std::size_t i : cluster)
          if (covers(piece, discs[i].at)) piece.discs.push_back(discs[i]);
      pieces.push_back(std::move(piece));
    }
  }
  return pieces;
}

/// Whether a disc reaches no further than that beyond one of a piece below.
bool lies_on(const Disc& disc, const Piece& below, Um reach) {
  return std::any_of(below.discs.begin(), below.discs.end(), [&](const Disc& under) {
    return distance(disc.at, under.at) + disc.radius <= under.radius + reach;
  });
}

/// What of a level rests on the one below, or on the part.
void let_rest(const Room& room, const Stack::Level& level, Pieces& here, const Pieces& below) {
  Pieces out;
  Regions doubtful;
  for (auto& piece : here) {
    const bool rests = std::all_of(piece.discs.begin(), piece.discs.end(), [&](const Disc& disc) {
      return std::any_of(below.begin(), below.end(),
                         [&](const Piece& b) { return b.box.contains(disc.at) && lies_on(disc, b, level.height); });
    });
    if (!piece.discs.empty() && rests)
      out.push_back(std::move(piece));
    else
      doubtful.push_back(std::move(piece.region));
  }
  if (!doubtful.empty()) {
    const Box near = weft::box_of(doubtful).grown(level.height);
    Regions base;
    for (const auto& b : below)
      if (b.box.overlaps(near)) base.push_back(b.region);
    rest_on(room, level, base, doubtful);
    for (auto& region : doubtful) {
      const Box box = weft::box_of(region.outer);
      out.push_back({std::move(region), box, {}});
    }
  }
  here = std::move(out);
}

}  // namespace

namespace {

struct Direction {
  double x, y;
};
constexpr int fewest_corners = 18, most_corners = 72;

/// The corners of rounds of radius 1, by how many they have.
std::vector<std::vector<Direction>> all_rounds() {
  std::vector<std::vector<Direction>> out;
  for (int corners = fewest_corners; corners <= most_corners; ++corners) {
    auto& round = out.emplace_back();
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * i / corners;
      round.push_back({std::cos(angle), std::sin(angle)});
    }
  }
  return out;
}

}  // namespace

Ring circle_around(const Disc& disc) {
  static const auto rounds = all_rounds();
  const int corners = std::clamp(static_cast<int>(10 * std::sqrt(disc.radius / 100)), fewest_corners, most_corners);
  const double outside = disc.radius / std::cos(std::numbers::pi / corners);
  Ring out;
  for (const Direction to : rounds[static_cast<std::size_t>(corners - fewest_corners)])
    out.push_back({disc.at.x + rounded(outside * to.x), disc.at.y + rounded(outside * to.y)});
  return out;
}

std::vector<Regions> branch_areas(const Room& room, const Stack& stack, const std::vector<Regions>& contacts,
                                  const std::vector<std::vector<Disc>>& discs) {
  auto levels = tasks::parallel_map(
      discs.size(), [&](std::size_t k) { return pieces_of(room, stack.levels[k], contacts[k], discs[k]); });
  std::vector<Regions> out(levels.size());
  for (std::size_t k = 0; k < levels.size(); ++k) {
    stop_if_asked();
    if (k > 0 && !levels[k].empty()) let_rest(room, stack.levels[k], levels[k], levels[k - 1]);
    if (k == 0) continue;
    for (const auto& piece : levels[k - 1]) out[k - 1].push_back(piece.region);
  }
  if (!levels.empty())
    for (auto& piece : levels.back()) out.back().push_back(std::move(piece.region));
  return out;
}

}  // namespace weft::support
