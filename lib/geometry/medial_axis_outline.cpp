// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/medial_axis_outline.h"

#include "core/stop.h"
#include "geometry/sweep.h"

#include <algorithm>

namespace weft::geometry::detail {
namespace {

using GridRing = std::vector<GridPoint>;
using GridRings = std::vector<GridRing>;

struct Segment {
  std::uint32_t a, b;
};

/// Sign of twice the area of abc; exact.
int turn(GridPoint a, GridPoint b, GridPoint c) {
  const auto cross = static_cast<__int128>(b.x - a.x) * (c.y - a.y) - static_cast<__int128>(b.y - a.y) * (c.x - a.x);
  return cross > 0 ? 1 : cross < 0 ? -1 : 0;
}

bool between(GridPoint a, GridPoint b, GridPoint p) {  // p on the line ab and inside the segment, ends excluded
  return p != a && p != b && p.x >= std::min(a.x, b.x) && p.x <= std::max(a.x, b.x) && p.y >= std::min(a.y, b.y) &&
         p.y <= std::max(a.y, b.y);
}

enum class Meeting { none, at_end, crossing };

/// How two segments meet besides in common end points. at_end: an end of one lies inside the other.
Meeting meeting(const std::vector<GridPoint>& points, Segment s, Segment t) {
  const GridPoint a = points[s.a], b = points[s.b], c = points[t.a], d = points[t.b];
  const int abc = turn(a, b, c), abd = turn(a, b, d);
  if (abc * abd > 0) return Meeting::none;
  const int cda = turn(c, d, a), cdb = turn(c, d, b);
  if (cda * cdb > 0) return Meeting::none;
  if (abc * abd < 0 && cda * cdb < 0) return Meeting::crossing;
  const bool touches = (abc == 0 && between(a, b, c)) || (abd == 0 && between(a, b, d)) ||
                       (cda == 0 && between(c, d, a)) || (cdb == 0 && between(c, d, b));
  return touches ? Meeting::at_end : Meeting::none;
}

GridRings rings_of(const Region& region, Point origin) {
  GridRings out;
  auto add = [&](const Ring& ring) {
    GridRing line;
    line.reserve(ring.size());
    for (const Point p : ring)
      line.push_back({grid_steps * (std::int64_t{p.x} - origin.x), grid_steps * (std::int64_t{p.y} - origin.y)});
    out.push_back(std::move(line));
  };
  add(region.outer);
  for (const Ring& hole : region.holes) add(hole);
  return out;
}

/// A number that looks random, and is the same for the same point. Source: Steele, Lea & Flood 2014, "Fast splittable
/// pseudorandom number generators" (the mixing function of SplitMix64).
std::uint64_t mixed(GridPoint p) {
  std::uint64_t z =
      static_cast<std::uint64_t>(p.x) * 0x9E3779B97F4A7C15u + static_cast<std::uint64_t>(p.y) * 0xD1B54A32D192ED03u;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

constexpr std::int64_t finer = shaken_steps / grid_steps;

/// The point on the finer grid.
GridPoint magnified(GridPoint p) {
  return {p.x * finer, p.y * finer};
}

GridPoint shaken(GridPoint p) {
  constexpr std::int64_t reach = finer / 4;  // neighbours on the grid stay apart
  const std::uint64_t random = mixed(p);
  const auto shift = [](std::uint64_t bits) { return static_cast<std::int64_t>(bits % (2 * reach + 1)) - reach; };
  return {p.x * finer + shift(random & 0xFFFFFFFF), p.y * finer + shift(random >> 32)};
}

/// Distinct points and the segments between them; segments that occur twice, or to and fro, cancel.
Outline indexed(const GridRings& rings) {
  Outline out;
  for (const GridRing& ring : rings) out.points.insert(out.points.end(), ring.begin(), ring.end());
  std::sort(out.points.begin(), out.points.end());
  out.points.erase(std::unique(out.points.begin(), out.points.end()), out.points.end());
  auto index = [&](GridPoint p) {
    return static_cast<std::uint32_t>(std::lower_bound(out.points.begin(), out.points.end(), p) - out.points.begin());
  };
  for (const GridRing& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const auto a = index(ring[i]), b = index(ring[(i + 1) % ring.size()]);
      if (a != b) out.segments.emplace_back(a, b);
    }
  return out;
}

bool has_double_segments(const Outline& outline) {
  auto keys = outline.segments;
  for (auto& [a, b] : keys)
    if (a > b) std::swap(a, b);
  std::sort(keys.begin(), keys.end());
  return std::adjacent_find(keys.begin(), keys.end()) != keys.end();
}

/// True when no two segments meet but in common end points: a sweep along x over the segments' boxes.
bool proven_simple(const Outline& outline) {
  if (outline.segments.empty() || has_double_segments(outline)) return false;
  struct Entry {
    std::int64_t x0, x1, y0, y1;
    Segment segment;
  };
  std::vector<Entry> entries;
  entries.reserve(outline.segments.size());
  for (const auto& [a, b] : outline.segments) {
    const GridPoint p = outline.points[a], q = outline.points[b];
    entries.push_back({std::min(p.x, q.x), std::max(p.x, q.x), std::min(p.y, q.y), std::max(p.y, q.y), {a, b}});
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& l, const Entry& r) { return l.x0 < r.x0; });
  std::vector<const Entry*> active;
  StopNowAndThen stop(64);
  for (const Entry& entry : entries) {
    stop.step();
    std::size_t kept = 0;
    for (const Entry* other : active) {
      if (other->x1 < entry.x0) continue;
      active[kept++] = other;
      if (other->y0 <= entry.y1 && entry.y0 <= other->y1 &&
          meeting(outline.points, entry.segment, other->segment) != Meeting::none)
        return false;
    }
    active.resize(kept);
    active.push_back(&entry);
  }
  return true;
}

GridRings united(const GridRings& rings) {
  clipper::Sweep sweep;
  ClipperLib::Paths subject, solution;
  for (const GridRing& ring : rings) {
    ClipperLib::Path path;
    for (const GridPoint p : ring) path.emplace_back(p.x, p.y);
    subject.push_back(std::move(path));
  }
  GridRings out;
  stop_if_asked();
  sweep.StrictlySimple(true);
  sweep.AddPaths(subject, ClipperLib::ptSubject, true);
  if (!sweep.Execute(ClipperLib::ctUnion, solution, ClipperLib::pftNonZero, ClipperLib::pftNonZero)) {
    stop_if_asked();
    return out;
  }
  for (const auto& path : solution) {
    GridRing ring;
    for (const auto& p : path) ring.push_back({p.X, p.Y});
    out.push_back(std::move(ring));
  }
  return out;
}

}  // namespace

Outline simple_outline(const Region& region, Point origin) {
  constexpr int attempts = 5;  // each union moves points by less than 1/64 µm; crossings left by rounding die out
  GridRings rings = rings_of(region, origin);
  for (int i = 0; i < attempts; ++i) {
    const Outline outline = indexed(rings);
    for (const auto move : {shaken, magnified}) {  // what touches may cross when shaken
      Outline moved = outline;
      std::transform(outline.points.begin(), outline.points.end(), moved.points.begin(), move);
      moved.simple = proven_simple(moved);
      if (moved.simple) return moved;
    }
    try {
      rings = united(rings);
    } catch (const ClipperLib::clipperException&) {
      break;
    }
  }
  return {};
}

}  // namespace weft::geometry::detail
