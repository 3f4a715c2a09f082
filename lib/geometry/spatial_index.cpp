// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/spatial_index.h"

#include "core/stop.h"

#include <algorithm>
#include <cmath>

namespace weft::geometry {

Foot foot_of(Point p, const Segment& segment) {
  const double ux = static_cast<double>(segment.b.x) - segment.a.x, uy = static_cast<double>(segment.b.y) - segment.a.y;
  const double vx = static_cast<double>(p.x) - segment.a.x, vy = static_cast<double>(p.y) - segment.a.y;
  const double length2 = ux * ux + uy * uy;
  const double along = length2 > 0 ? std::clamp((ux * vx + uy * vy) / length2, 0.0, 1.0) : 0.0;
  const double x = vx - along * ux, y = vy - along * uy;
  return {along, std::sqrt(x * x + y * y)};
}

SegmentIndex::SegmentIndex(std::vector<Segment> segments) : segments_(std::move(segments)) {
  build();
}

SegmentIndex::SegmentIndex(std::span<const Ring> rings) {
  std::size_t count = 0;
  for (const auto& ring : rings) count += ring.size();
  reserve(count);
  for (std::uint32_t r = 0; r < rings.size(); ++r) add(rings[r], {r, 0, 0});
  build();
}

SegmentIndex::SegmentIndex(const Regions& regions) {
  std::size_t count = 0;
  for (const auto& region : regions) {
    count += region.outer.size();
    for (const auto& hole : region.holes) count += hole.size();
  }
  reserve(count);
  for (std::uint32_t r = 0; r < regions.size(); ++r) {
    add(regions[r].outer, {r, 0, 0});
    for (std::uint32_t k = 0; k < regions[r].holes.size(); ++k) add(regions[r].holes[k], {r, k + 1, 0});
  }
  build();
}

void SegmentIndex::reserve(std::size_t segments) {
  segments_.reserve(segments), origins_.reserve(segments), next_.reserve(segments);
}

/// @param first  where its first edge comes from
void SegmentIndex::add(const Ring& ring, EdgeOfRegion first) {
  const auto begin = static_cast<std::uint32_t>(segments_.size());
  for (std::uint32_t i = 0; i < ring.size(); ++i) {
    const bool last = i + 1 == ring.size();
    segments_.push_back({ring[i], ring[last ? 0 : i + 1]});
    origins_.push_back({first.region, first.ring, i});
    next_.push_back(last ? begin : begin + i + 1);
  }
}

/// How far along x for a step of y; 0 for what is level.
double SegmentIndex::lean_of(const Segment& s) {
  return s.a.y == s.b.y ? 0 : (static_cast<double>(s.b.x) - s.a.x) / (static_cast<double>(s.b.y) - s.a.y);
}

/// The columns that the part of s within a row of cells may touch, a micron more rather than less.
/// @param lean  that of s
SegmentIndex::Cells SegmentIndex::columns_in_row(const Segment& s, double lean, int row) const {
  const auto [low, high] = std::minmax(s.a.x, s.b.x);
  if (s.a.y == s.b.y) return {column(low), column(high)};
  const auto [bottom, top] = std::minmax(s.a.y, s.b.y);
  const Um from = std::max(bottom, box_.min.y + (row << shift_));
  const Um to = std::min<Um>(top, box_.min.y + ((row + 1) << shift_));
  const double x0 = s.a.x + lean * (static_cast<double>(from) - s.a.y),
               x1 = s.a.x + lean * (static_cast<double>(to) - s.a.y);
  const Um left = std::max(low, static_cast<Um>(std::floor(std::min(x0, x1))) - 1);
  const Um right = std::min(high, static_cast<Um>(std::ceil(std::max(x0, x1))) + 1);
  return {column(left), column(right)};
}

template <class F>
void SegmentIndex::for_each_cell(const Segment& s, F&& f) const {
  const int first = row(std::min(s.a.y, s.b.y)), last = row(std::max(s.a.y, s.b.y));
  if (first == last) {
    const int base = first * columns_, from = column(std::min(s.a.x, s.b.x)), to = column(std::max(s.a.x, s.b.x));
    for (int c = from; c <= to; ++c) f(static_cast<std::size_t>(base + c));
    return;
  }
  const double lean = lean_of(s);
  for (int r = first; r <= last; ++r) {
    const Cells range = columns_in_row(s, lean, r);
    for (int c = range.first; c <= range.last; ++c) f(static_cast<std::size_t>(r * columns_ + c));
  }
}

void SegmentIndex::build() {
  for (const auto& s : segments_) box_.add(s.a), box_.add(s.b);
  if (box_.empty()) return;
  const auto cells_at = [&](int shift) {
    const auto size = box_.size();
    return ((std::int64_t{size.x} >> shift) + 1) * ((std::int64_t{size.y} >> shift) + 1);
  };
  const auto wanted = 4 * static_cast<std::int64_t>(segments_.size()) + 1;  // an outline runs through few of them
  while (cells_at(shift_) > wanted) ++shift_;
  columns_ = column(box_.max.x) + 1;
  rows_ = row(box_.max.y) + 1;
  starts_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
  StopNowAndThen stop(256);
  for (const auto& s : segments_) {
    stop.step();
    for_each_cell(s, [&](std::size_t cell) { ++starts_[cell]; });
  }
  std::uint32_t sum = 0;
  for (auto& start : starts_) start = sum += start;  // ends, which filling from behind turns into starts
  entries_.resize(sum);
  for (std::size_t i = segments_.size(); i-- > 0;) {
    stop.step();
    for_each_cell(segments_[i], [&](std::size_t cell) { entries_[--starts_[cell]] = static_cast<std::uint32_t>(i); });
  }
}

std::optional<SegmentIndex::Nearest> SegmentIndex::nearest(Point p, double limit_um) const {
  if (segments_.empty()) return std::nullopt;
  const Point inside{std::clamp(p.x, box_.min.x, box_.max.x), std::clamp(p.y, box_.min.y, box_.max.y)};
  const int pc = column(inside.x), pr = row(inside.y);
  const double size = std::ldexp(1.0, shift_);
  // From here to the nearest border of the own cell: rings of cells around it are that much further away.
  const double cx = static_cast<double>(inside.x) - box_.min.x - pc * size,
               cy = static_cast<double>(inside.y) - box_.min.y - pr * size;
  const double border = std::min(std::min(cx, size - cx), std::min(cy, size - cy));
  std::optional<Nearest> best;
  double reach = limit_um;
  const auto look = [&](int c, int r) {
    if (c < 0 || c >= columns_) return;
    for (const std::uint32_t i : cell(static_cast<std::size_t>(r * columns_ + c))) {
      const Foot foot = foot_of(p, segments_[i]);
      if (foot.distance_um > reach || (best && foot.distance_um == reach && i >= best->segment)) continue;
      reach = foot.distance_um;
      best = Nearest{i, lerp(segments_[i].a, segments_[i].b, foot.along), foot.distance_um, foot.along};
    }
  };
  const int farthest = std::max(std::max(pc, columns_ - 1 - pc), std::max(pr, rows_ - 1 - pr));
  for (int k = 0; k <= farthest && (k == 0 || border + (k - 1) * size <= reach); ++k) {
    for (int r = std::max(0, pr - k); r <= std::min(rows_ - 1, pr + k); ++r) {
      if (r == pr - k || r == pr + k) {
        for (int c = std::max(0, pc - k); c <= std::min(columns_ - 1, pc + k); ++c) look(c, r);
      } else {
        look(pc - k, r);
        look(pc + k, r);
      }
    }
  }
  return best;
}

void SegmentIndex::near(const Box& box, std::vector<std::uint32_t>& found) const {
  found.clear();
  if (box.empty() || segments_.empty() || !box.overlaps(box_)) return;
  const int c0 = column(std::max(box.min.x, box_.min.x)), c1 = column(std::min(box.max.x, box_.max.x));
  const int r0 = row(std::max(box.min.y, box_.min.y)), r1 = row(std::min(box.max.y, box_.max.y));
  for (int r = r0; r <= r1; ++r)
    for (int c = c0; c <= c1; ++c) {
      const auto here = cell(static_cast<std::size_t>(r * columns_ + c));
      found.insert(found.end(), here.begin(), here.end());
    }
  if (c0 == c1 && r0 == r1) return;
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
}

bool SegmentIndex::any_near(const Box& box) const {
  if (box.empty() || segments_.empty() || !box.overlaps(box_)) return false;
  const int c0 = column(std::max(box.min.x, box_.min.x)), c1 = column(std::min(box.max.x, box_.max.x));
  const int r0 = row(std::max(box.min.y, box_.min.y)), r1 = row(std::min(box.max.y, box_.max.y));
  for (int r = r0; r <= r1; ++r) {
    const std::size_t first = static_cast<std::size_t>(r * columns_ + c0),
                      last = first + static_cast<std::size_t>(c1 - c0);
    if (starts_[first] != starts_[last + 1]) return true;  // cells of a row lie side by side
  }
  return false;
}

/// Calls f(i) for each segment near the line, often more than once, until it returns false.
template <class F>
void SegmentIndex::for_each_near_line(Point a, Point b, F&& f) const {
  if (segments_.empty()) return;
  const Um bottom = std::max(std::min(a.y, b.y), box_.min.y), top = std::min(std::max(a.y, b.y), box_.max.y);
  if (bottom > top || std::max(a.x, b.x) < box_.min.x || std::min(a.x, b.x) > box_.max.x) return;
  const int first = row(bottom), last = row(top);
  const double lean = first == last ? 0 : lean_of({a, b});
  for (int r = first; r <= last; ++r) {
    const Cells range =
        first == last ? Cells{column(std::min(a.x, b.x)), column(std::max(a.x, b.x))} : columns_in_row({a, b}, lean, r);
    for (int c = std::max(0, range.first); c <= std::min(columns_ - 1, range.last); ++c)
      for (const std::uint32_t i : cell(static_cast<std::size_t>(r * columns_ + c)))
        if (!f(i)) return;
  }
}

void SegmentIndex::crossings(Point a, Point b, std::vector<Crossing>& found) const {
  found.clear();
  const Box box = Segment{a, b}.box();
  for_each_near_line(a, b, [&](std::uint32_t i) {
    if (!box.overlaps(segments_[i].box())) return true;
    const auto& [c, d] = segments_[i];
    if ((orient(a, b, c) > 0) == (orient(a, b, d) > 0)) return true;
    const std::int64_t at_a = orient(c, d, a), at_b = orient(c, d, b);
    if ((at_a > 0) == (at_b > 0)) return true;
    found.push_back({i, static_cast<double>(at_a) / (static_cast<double>(at_a) - static_cast<double>(at_b)), at_b > 0});
    return true;
  });
  if (found.size() < 2) return;
  std::sort(found.begin(), found.end(), [](const Crossing& l, const Crossing& r) {
    return l.along != r.along ? l.along < r.along : l.segment < r.segment;
  });
  const auto same = [](const Crossing& l, const Crossing& r) { return l.segment == r.segment; };
  found.erase(std::unique(found.begin(), found.end(), same), found.end());  // it was met in several cells
}

bool SegmentIndex::touches(Point p) const {
  if (segments_.empty() || !box_.contains(p)) return false;
  for (const std::uint32_t i : cell(static_cast<std::size_t>(row(p.y) * columns_ + column(p.x))))
    if (segments_touch(segments_[i].a, segments_[i].b, p, p)) return true;
  return false;
}

bool SegmentIndex::crosses(Point a, Point b) const {
  bool found = false;
  for_each_near_line(a, b, [&](std::uint32_t i) {
    found = segments_cross(a, b, segments_[i].a, segments_[i].b);
    return !found;
  });
  return found;
}

/// Calls f(i, step) for each segment on whose line p may lie (step 0) or that a ray from p to the left crosses (step
/// ±1).
template <class F>
void SegmentIndex::for_each_left_of(Point p, F&& f) const {
  if (segments_.empty() || !box_.contains(p)) return;
  const int r = row(p.y), last = column(p.x);
  for (int c = 0; c <= last; ++c) {
    for (const std::uint32_t i : cell(static_cast<std::size_t>(r * columns_ + c))) {
      const auto& [a, b] = segments_[i];
      if (std::min(a.y, b.y) > p.y || std::max(a.y, b.y) < p.y || std::min(a.x, b.x) > p.x) continue;
      const std::int64_t side = orient(a, b, p);
      if (side == 0 && p.x <= std::max(a.x, b.x)) f(i, 0);
      const bool up = b.y > p.y;
      if ((a.y > p.y) == up || (side > 0) == up || side == 0) continue;
      if (c == std::max(0, columns_in_row(segments_[i], lean_of(segments_[i]), r).first))
        f(i, up ? -1 : 1);  // it is in several cells: count it once
    }
  }
}

std::optional<int> SegmentIndex::winding(Point p) const {
  bool on = false;
  int sum = 0;
  for_each_left_of(p, [&](std::uint32_t, int step) {
    on |= step == 0;
    sum += step;
  });
  if (on) return std::nullopt;
  return sum;
}

void SegmentIndex::windings(Point p, std::vector<RingWinding>& found) const {
  found.clear();
  for_each_left_of(p, [&](std::uint32_t i, int step) { found.push_back({origins_[i].region, step, step == 0}); });
  std::sort(found.begin(), found.end(), [](const RingWinding& l, const RingWinding& r) { return l.ring < r.ring; });
  std::size_t kept = 0;
  for (const RingWinding& w : found) {
    if (kept > 0 && found[kept - 1].ring == w.ring) {
      found[kept - 1].winding += w.winding;
      found[kept - 1].on |= w.on;
    } else {
      found[kept++] = w;
    }
  }
  found.resize(kept);
}

std::uint32_t SegmentIndex::first_left_of(Point p) const {
  if (segments_.empty() || !box_.contains(p)) return none;
  const int r = row(p.y);
  std::uint32_t best = none;
  double best_x_um = 0;
  bool tie = false;
  for (int c = column(p.x); c >= 0; --c) {
    for (const std::uint32_t i : cell(static_cast<std::size_t>(r * columns_ + c))) {
      const auto& [a, b] = segments_[i];
      if (std::min(a.y, b.y) > p.y || std::max(a.y, b.y) < p.y || std::min(a.x, b.x) > p.x || i == best) continue;
      const std::int64_t side = orient(a, b, p);
      const bool up = b.y > p.y;
      if ((a.y > p.y) == up || (side > 0) == up || side == 0) continue;  // as for_each_left_of
      const double x_um =
          a.x + (static_cast<double>(p.y) - a.y) / (static_cast<double>(b.y) - a.y) * (static_cast<double>(b.x) - a.x);
      constexpr double equal_um =
          0.001;  // above what a double rounds, below what two lattice segments differ by nearly always
      if (best != none && x_um < best_x_um - equal_um) continue;
      tie = best != none && x_um < best_x_um + equal_um;
      if (!tie || x_um > best_x_um) best = i, best_x_um = x_um;
    }
    if (best != none && best_x_um > static_cast<double>(box_.min.x) + std::ldexp(c, shift_) + 1) break;
  }
  return tie ? unsure : best;
}

std::optional<std::size_t> SegmentIndex::region_at(Point p) const {
  if (segments_.empty() || !box_.contains(p)) return std::nullopt;
  std::optional<std::size_t> on;
  for (const std::uint32_t i : cell(static_cast<std::size_t>(row(p.y) * columns_ + column(p.x))))
    if (segments_touch(segments_[i].a, segments_[i].b, p, p))
      on = on ? std::min<std::size_t>(*on, origins_[i].region) : origins_[i].region;
  if (on) return on;
  std::vector<RingWinding> found;
  windings(p, found);
  for (const auto& w : found)
    if (w.winding != 0) return w.ring;
  return std::nullopt;
}

bool SegmentIndex::neighbours(std::uint32_t i, std::uint32_t j) const {
  return next_[i] == j || next_[j] == i;
}

namespace {

/// Pairs that met in several cells, once.
std::vector<std::pair<std::uint32_t, std::uint32_t>> each_once(
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace

template <class F>
bool SegmentIndex::for_each_near_pair(F&& f) const {
  StopNowAndThen stop(256);
  for (std::size_t k = 0; k + 1 < starts_.size(); ++k) {
    const auto here = cell(k);
    for (std::size_t x = 0; x + 1 < here.size(); ++x) {
      stop.step();
      const Segment s = segments_[here[x]];
      const Box box = s.box();
      for (std::size_t y = x + 1; y < here.size(); ++y) {
        const Segment& t = segments_[here[y]];
        if (box.overlaps(t.box()) && !f(here[x], s, here[y], t)) return false;
      }
    }
  }
  return true;
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> SegmentIndex::crossing_pairs() const {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> out;
  for_each_near_pair([&](std::uint32_t i, const Segment& s, std::uint32_t j, const Segment& t) {
    if (segments_cross(s.a, s.b, t.a, t.b)) out.emplace_back(i, j);
    return true;
  });
  return each_once(std::move(out));
}

bool SegmentIndex::has_points() const {
  return std::any_of(segments_.begin(), segments_.end(), [](const Segment& s) { return s.a == s.b; });
}

bool SegmentIndex::join(std::uint32_t i, std::uint32_t j) const {
  if (!neighbours(i, j)) return false;
  const Segment &s = segments_[next_[i] == j ? i : j], &t = segments_[next_[i] == j ? j : i];
  return orient(s.a, s.b, t.b) != 0 || dot(s.b - s.a, t.b - s.b) >= 0;
}

std::optional<std::vector<std::pair<std::uint32_t, std::uint32_t>>> SegmentIndex::clean_crossings() const {
  if (has_points()) return std::nullopt;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> out;
  const bool clean = for_each_near_pair([&](std::uint32_t i, const Segment& s, std::uint32_t j, const Segment& t) {
    if (neighbours(i, j)) return join(i, j);
    if (!segments_cross(s.a, s.b, t.a, t.b)) return !segments_touch(s.a, s.b, t.a, t.b);
    out.emplace_back(i, j);
    return true;
  });
  if (!clean) return std::nullopt;
  return each_once(std::move(out));
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> SegmentIndex::rings_that_meet() const {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> out;
  for_each_near_pair([&](std::uint32_t i, const Segment& s, std::uint32_t j, const Segment& t) {
    const std::uint32_t a = origins_[i].region, b = origins_[j].region;
    if (a != b && segments_touch(s.a, s.b, t.a, t.b)) out.push_back(std::minmax(a, b));
    return true;
  });
  return each_once(std::move(out));
}

bool SegmentIndex::simple() const {
  return !has_points() && for_each_near_pair([&](std::uint32_t i, const Segment& s, std::uint32_t j, const Segment& t) {
    return neighbours(i, j) ? join(i, j) : !segments_touch(s.a, s.b, t.a, t.b);
  });
}

}  // namespace weft::geometry
