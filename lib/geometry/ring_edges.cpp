// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/ring_edges.h"

#include "core/stop.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace weft::geometry {
namespace {

constexpr std::size_t many = 256;  // rings: they are not all looked at for each of them

/// Whether two edges that join lie on each other.
bool fold(Point a, Point joint, Point b) {
  return dot(joint - a, b - joint) < 0 && orient(a, joint, b) == 0;
}

constexpr unsigned to_right = 1, to_left = 2, up = 4, down = 8;

}  // namespace

/// Along an axis: edges that follow each other so have no point in common but where they join, unless two fold.
bool RingEdges::goes_one_way(unsigned ways) {
  return (ways & (to_right | to_left)) != (to_right | to_left) || (ways & (up | down)) != (up | down);
}
/// Along both: no two fold.
bool RingEdges::keeps_quadrant(unsigned ways) {
  return (ways & (to_right | to_left)) != (to_right | to_left) && (ways & (up | down)) != (up | down);
}

RingEdges::RingEdges(std::span<const Ring> rings) : rings_(rings) {
  std::size_t edges = 0, blocks = 0, groups = 0;
  for (const Ring& ring : rings) {
    const std::size_t own = (ring.size() + EightBoxes::count - 1) / EightBoxes::count;
    edges += ring.size(), blocks += own, groups += (own + EightBoxes::count - 1) / EightBoxes::count;
  }
  points_.reserve(edges + rings.size());
  blocks_.reserve(blocks), groups_.reserve(groups);
  first_of_ring_.reserve(rings.size() + 1);
  first_of_ring_.push_back(0);
  for (const Ring& ring : rings) {
    points_.insert(points_.end(), ring.begin(), ring.end());
    if (!ring.empty()) points_.push_back(ring.front());
    first_of_ring_.push_back(first_of_ring_.back() + static_cast<std::uint32_t>(ring.size()));
  }
  around_.reserve(rings.size()), groups_of_ring_.reserve(rings.size() + 1);
  for (std::uint32_t r = 0; r < rings.size(); ++r) add(r);
  groups_of_ring_.push_back(static_cast<std::uint32_t>(groups_.size()));
}

void RingEdges::add(std::uint32_t ring) {
  groups_of_ring_.push_back(static_cast<std::uint32_t>(groups_.size()));
  Box around;
  const std::uint32_t end = first_of_ring_[ring + 1];
  for (std::uint32_t first = first_of_ring_[ring]; first < end;) {
    Group& group = groups_.emplace_back();
    group.first = static_cast<std::uint32_t>(blocks_.size());
    for (; first < end && group.count < EightBoxes::count; first += EightBoxes::count) {
      const Box box =
          add_block(points_.data() + first + ring, first, std::min<std::uint32_t>(EightBoxes::count, end - first));
      group.blocks.set(group.count++, box);
      group.box.add(box);
    }
    around.add(group.box);
  }
  around_.push_back(around);
}

/// @return the box of all
Box RingEdges::add_block(const Point* at, std::uint32_t first, std::uint32_t count) {
  constexpr std::size_t n = EightBoxes::count;
  std::array<Um, n + 1> x, y;
  for (std::size_t k = 0; k < count; ++k) x[k] = at[k].x, y[k] = at[k].y;
  for (std::size_t k = count; k <= n; ++k) x[k] = at[count].x, y[k] = at[count].y;  // edges without length
  Block& block = blocks_.emplace_back(x, y);
  block.first = first, block.count = count;
  Um right = 0, left = 0, upwards = 0, downwards = 0, points = 0;  // where they go: by the signs of these
  for (std::size_t k = 0; k < n; ++k) {
    const Um step_x = x[k + 1] - x[k], step_y = y[k + 1] - y[k];
    right |= -step_x, left |= step_x, upwards |= -step_y, downwards |= step_y;
    points += (step_x | step_y) == 0 ? 1 : 0;
  }
  block.ways =
      (right < 0 ? to_right : 0) | (left < 0 ? to_left : 0) | (upwards < 0 ? up : 0) | (downwards < 0 ? down : 0);
  has_points_ |= points > static_cast<Um>(n - count);
  block.edges.keep(count);
  Box box{{x[n], y[n]}, {x[n], y[n]}};
  for (std::size_t k = 0; k < n; ++k) box.min.x = std::min(box.min.x, x[k]), box.max.x = std::max(box.max.x, x[k]);
  for (std::size_t k = 0; k < n; ++k) box.min.y = std::min(box.min.y, y[k]), box.max.y = std::max(box.max.y, y[k]);
  return box;
}

std::uint32_t RingEdges::ring_of(std::uint32_t edge) const {
  if (first_of_ring_.size() == 2) return 0;
  return static_cast<std::uint32_t>(std::upper_bound(first_of_ring_.begin(), first_of_ring_.end(), edge) -
                                    first_of_ring_.begin()) -
         1;
}

std::span<const RingEdges::Block> RingEdges::blocks_of(std::uint32_t ring) const {
  const auto own = of_ring(ring);
  if (own.empty()) return {};
  return {blocks_.data() + own.front().first, own.back().first + own.back().count - own.front().first};
}

const SegmentIndex& RingEdges::grid() const {
  if (!grid_) grid_ = std::make_unique<SegmentIndex>(rings_);
  return *grid_;
}

const BoxColumns& RingEdges::columns() const {
  if (!columns_) columns_ = std::make_unique<BoxColumns>(around_);
  return *columns_;
}

bool RingEdges::scattered() const {
  if (rings_.size() <= many) return false;
  constexpr std::size_t few = 8;
  std::size_t pairs = 0;
  for (const Ring& ring : rings_) columns().each_around(ring.front(), [&](std::uint32_t) { ++pairs; });
  return pairs <= few * rings_.size();
}

/// Whether two edges that follow each other lie on each other.
bool RingEdges::any_folds() const {
  for (std::uint32_t r = 0; r < rings_.size(); ++r) {
    const auto blocks = blocks_of(r);
    const auto n = static_cast<std::uint32_t>(rings_[r].size());
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const Block& block = blocks[b];
      if (keeps_quadrant(block.ways | blocks[b + 1 < blocks.size() ? b + 1 : 0].ways)) continue;
      const Point* const at = points_.data() + first_of_ring_[r] + r;
      for (std::uint32_t i = block.first - first_of_ring_[r], end = i + block.count; i < end; ++i)
        if (fold(at[i], at[i + 1], at[i + 2 <= n ? i + 2 : 1])) return true;
    }
  }
  return false;
}

template <class F>
struct RingEdges::Search {
  const RingEdges& all;
  F& f;
  std::size_t looks;                     ///< at eight boxes, that are left
  std::uint32_t ring_a = 0, ring_b = 0;  ///< between which it looks: a's edges come before b's
  Found found = Found::all;

  bool look() {
    if (looks-- == 0) found = Found::too_slow;
    return found == Found::all;
  }
  void edges(std::uint32_t i, std::uint32_t j) {
    if (found != Found::all) return;
    if (ring_a == ring_b) {
      if (i > j) std::swap(i, j);
      if (j == i + 1 || (i == all.first_of(ring_a) && j + 1 == all.first_of(ring_a + 1))) return;
    }
    if (!f(i, all.edge_of(ring_a, i), j, all.edge_of(ring_b, j))) found = Found::stopped;
  }
  void within(const Block& block) {
    if (goes_one_way(block.ways)) return;
    for (std::uint32_t k = 0; k + 2 < block.count && look(); ++k)
      for_each_bit(block.edges.meeting(block.edges[k]) >> (k + 2),
                   [&](std::uint32_t l) { edges(block.first + k, block.first + k + 2 + l); });
  }
  /// @param box_of_b  meets that of a
  void between(const Block& a, const Block& b, const Box& box_of_b) {
    if (ring_a == ring_b && goes_one_way(a.ways | b.ways) && follow(a, b)) return;
    for_each_bit(a.edges.meeting(box_of_b), [&](std::uint32_t k) {
      if (look()) for_each_bit(b.edges.meeting(a.edges[k]), [&](std::uint32_t l) { edges(a.first + k, b.first + l); });
    });
  }
  /// Whether one of two blocks of a ring follows the other.
  bool follow(const Block& a, const Block& b) const {
    const std::uint32_t first = all.first_of(ring_a), end = all.first_of(ring_a + 1);
    const auto next = [&](const Block& block) {
      return block.first + block.count < end ? block.first + block.count : first;
    };
    return next(a) == b.first || next(b) == a.first;
  }
  void within(const Group& group) {
    for (std::uint32_t k = 0; k < group.count && look(); ++k) {
      const Block& block = all.blocks_[group.first + k];
      within(block);
      for_each_bit(group.blocks.meeting(group.blocks[k]) >> (k + 1), [&](std::uint32_t l) {
        between(block, all.blocks_[group.first + k + 1 + l], group.blocks[k + 1 + l]);
      });
    }
  }
  void between(const Group& a, const Group& b) {
    if (!a.box.overlaps(b.box)) return;
    for_each_bit(a.blocks.meeting(b.box), [&](std::uint32_t k) {
      if (look())
        for_each_bit(b.blocks.meeting(a.blocks[k]), [&](std::uint32_t l) {
          between(all.blocks_[a.first + k], all.blocks_[b.first + l], b.blocks[l]);
        });
    });
  }
  void within(std::uint32_t ring) {
    ring_a = ring_b = ring;
    const auto own = all.of_ring(ring);
    for (std::size_t k = 0; k < own.size() && found == Found::all; ++k) {
      within(own[k]);
      for (std::size_t l = k + 1; l < own.size() && found == Found::all; ++l) between(own[k], own[l]);
    }
  }
  void between(std::uint32_t a, std::uint32_t b) {
    ring_a = std::min(a, b), ring_b = std::max(a, b);
    for (const Group& own : all.of_ring(ring_a)) {
      if (found != Found::all) return;
      if (!own.box.overlaps(all.around_[ring_b])) continue;
      for (const Group& other : all.of_ring(ring_b)) between(own, other);
    }
  }
};

template <class F>
RingEdges::Found RingEdges::for_each_near_pair(F&& f) const {
  constexpr std::size_t as_long_as_a_grid = 16;  // looks an edge
  Search<F> search{*this, f, as_long_as_a_grid * points_.size()};
  std::vector<std::uint32_t> order(rings_.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t l, std::uint32_t r) {
    return around_[l].min.x != around_[r].min.x ? around_[l].min.x < around_[r].min.x : l < r;
  });
  StopNowAndThen stop(64);
  for (std::size_t i = 0; i < order.size() && search.found == Found::all; ++i) {
    const Box& around = around_[order[i]];
    search.within(order[i]);
    for (std::size_t j = i + 1; j < order.size() && around_[order[j]].min.x <= around.max.x && search.look(); ++j) {
      stop.step();
      if (around.overlaps(around_[order[j]])) search.between(order[i], order[j]);
    }
  }
  return search.found;
}

RingEdges::Pairs RingEdges::crossing_pairs() const {
  Pairs out;
  const Found found = for_each_near_pair([&](std::uint32_t i, const Segment& s, std::uint32_t j, const Segment& t) {
    if (segments_cross(s.a, s.b, t.a, t.b)) out.emplace_back(i, j);
    return true;
  });
  if (found == Found::too_slow) return grid().crossing_pairs();
  std::sort(out.begin(), out.end());
  return out;
}

std::optional<RingEdges::Pairs> RingEdges::clean_crossings() const {
  if (has_points_ || any_folds()) return std::nullopt;
  Pairs out;
  const Found found = for_each_near_pair([&](std::uint32_t i, const Segment& s, std::uint32_t j, const Segment& t) {
    if (!segments_touch(s.a, s.b, t.a, t.b)) return true;
    if (!segments_cross(s.a, s.b, t.a, t.b)) return false;
    out.emplace_back(i, j);
    return true;
  });
  if (found == Found::too_slow) return grid().clean_crossings();
  if (found == Found::stopped) return std::nullopt;
  std::sort(out.begin(), out.end());
  return out;
}

bool RingEdges::simple() const {
  if (has_points_ || any_folds()) return false;
  const Found found = for_each_near_pair([&](std::uint32_t, const Segment& s, std::uint32_t, const Segment& t) {
    return !segments_touch(s.a, s.b, t.a, t.b);
  });
  return found == Found::too_slow ? grid().simple() : found == Found::all;
}

template <class F>
void RingEdges::for_each_in(std::uint32_t ring, const Box& box, F&& f) const {
  for (const Group& group : of_ring(ring)) {
    if (!group.box.overlaps(box)) continue;
    for_each_bit(group.blocks.meeting(box), [&](std::uint32_t k) {
      const Block& block = blocks_[group.first + k];
      for_each_bit(block.edges.meeting(box), [&](std::uint32_t l) {
        const Segment own = edge_of(ring, block.first + l);
        f(block.first + l, own.a, own.b);
      });
    });
  }
}

namespace {

/// All that lies left of a place, at its height.
Box left_of(Point p) {
  return {{-2 * max_coord, p.y}, p};
}

}  // namespace

/// What `windings` tells of one ring.
std::optional<SegmentIndex::RingWinding> RingEdges::winding(std::uint32_t ring, Point p) const {
  SegmentIndex::RingWinding own{ring, 0, false};
  bool any = false;
  const auto add = [&](int step) { own.winding += step, own.on |= step == 0, any = true; };
  for_each_in(ring, left_of(p), [&](std::uint32_t, Point a, Point b) {
    const std::int64_t side = orient(a, b, p);
    if (side == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x)) add(0);
    const bool upwards = b.y > p.y;
    if ((a.y > p.y) != upwards && side != 0 && (side > 0) != upwards) add(upwards ? -1 : 1);
  });
  return any ? std::optional(own) : std::nullopt;
}

void RingEdges::windings(Point p, std::vector<SegmentIndex::RingWinding>& found) const {
  found.clear();
  const auto look = [&](std::uint32_t ring) {
    if (const auto own = winding(ring, p)) found.push_back(*own);
  };
  if (rings_.size() <= many) {
    for (std::uint32_t r = 0; r < around_.size(); ++r)
      if (around_[r].contains(p)) look(r);
    return;
  }
  constexpr std::size_t few = 32;  // around a place: their edges are looked at, not a ray through the grid
  std::vector<std::uint32_t> around;
  columns().each_around(p, [&](std::uint32_t r) { around.push_back(r); });
  if (around.size() > few) return grid().windings(p, found);
  for (const std::uint32_t r : around) look(r);
}

std::uint32_t RingEdges::first_left_of(Point p) const {
  if (rings_.size() > many) return grid().first_left_of(p);
  constexpr double equal_um = 0.001;  // above what a double rounds, below what two edges differ by nearly always
  std::uint32_t best = none;
  double best_x_um = 0;
  bool tie = false;
  const auto look = [&](std::uint32_t i, Point a, Point b) {
    const std::int64_t side = orient(a, b, p);
    const bool upwards = b.y > p.y;
    if ((a.y > p.y) == upwards || (side > 0) == upwards || side == 0) return;  // as SegmentIndex
    const double x_um =
        a.x + (static_cast<double>(p.y) - a.y) / (static_cast<double>(b.y) - a.y) * (static_cast<double>(b.x) - a.x);
    if (best != none && x_um < best_x_um - equal_um) return;
    tie = best != none && x_um < best_x_um + equal_um;
    if (!tie || x_um > best_x_um) best = i, best_x_um = x_um;
  };
  const Box left = left_of(p);
  for (std::uint32_t r = 0; r < around_.size(); ++r)
    if (around_[r].overlaps(left) && (best == none || around_[r].max.x >= best_x_um - equal_um))
      for_each_in(r, left, look);
  return tie ? unsure : best;
}

}  // namespace weft::geometry
