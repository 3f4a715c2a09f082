// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/ring_chains.h"

#include "core/stop.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace weft::geometry {
namespace {

constexpr std::size_t many = 256;  // rings: they are not all looked at for each of them

/// Whether two edges that join lie on each other.
bool fold(const Segment& s, const Segment& t) {
  return orient(s.a, s.b, t.b) == 0 && dot(s.b - s.a, t.b - s.b) < 0;
}

}  // namespace

RingChains::RingChains(std::span<const Ring> rings) : rings_(rings) {
  std::size_t edges = 0;
  for (const Ring& ring : rings) edges += ring.size();
  points_.reserve(edges + rings.size());
  chains_.reserve(edges / 4 + 8);
  first_of_ring_.reserve(rings.size() + 1);
  first_of_ring_.push_back(0);
  for (const Ring& ring : rings) {
    points_.insert(points_.end(), ring.begin(), ring.end());
    if (!ring.empty()) points_.push_back(ring.front());
    first_of_ring_.push_back(first_of_ring_.back() + static_cast<std::uint32_t>(ring.size()));
  }
  around_.reserve(rings.size()), chains_of_ring_.reserve(rings.size() + 1);
  for (std::uint32_t r = 0; r < rings.size(); ++r) cut(r);
  chains_of_ring_.push_back(static_cast<std::uint32_t>(chains_.size()));
}

Box RingChains::Piece::box() const {
  return Segment{at[0], at[edges]}.box();
}

/// Cuts a ring where it turns back along an axis.
void RingChains::cut(std::uint32_t ring) {
  const std::uint32_t first = first_of_ring_[ring], edges = first_of_ring_[ring + 1] - first;
  const Point* const at = points_.data() + first + ring;
  const std::size_t first_chain = chains_.size();
  for (std::uint32_t i = 0, from = 0; from < edges; from = i) {
    Point way;  // the last along each axis
    for (; i < edges; ++i) {
      const Point step = at[i + 1] - at[i];
      if (std::int64_t{step.x} * way.x < 0 || std::int64_t{step.y} * way.y < 0) break;
      if (step.x != 0) way.x = step.x;
      if (step.y != 0) way.y = step.y;
      has_points_ |= (step.x | step.y) == 0;
    }
    chains_.push_back({Segment{at[from], at[i]}.box(), way, first + from, i - from, ring});
  }
  Box around;
  for (std::size_t c = first_chain; c < chains_.size(); ++c) {
    chains_[c].next = chains_[c + 1 < chains_.size() ? c + 1 : first_chain].first;
    around.add(chains_[c].box);
  }
  std::sort(chains_.begin() + static_cast<std::ptrdiff_t>(first_chain), chains_.end(),
            [](const Chain& l, const Chain& r) {
              return l.box.min.x != r.box.min.x ? l.box.min.x < r.box.min.x : l.first < r.first;
            });
  around_.push_back(around), chains_of_ring_.push_back(static_cast<std::uint32_t>(first_chain));
}

std::uint32_t RingChains::ring_of(std::uint32_t edge) const {
  if (first_of_ring_.size() == 2) return 0;
  return static_cast<std::uint32_t>(std::upper_bound(first_of_ring_.begin(), first_of_ring_.end(), edge) -
                                    first_of_ring_.begin()) -
         1;
}

const SegmentIndex& RingChains::grid() const {
  if (!grid_) grid_ = std::make_unique<SegmentIndex>(rings_);
  return *grid_;
}

const BoxColumns& RingChains::columns() const {
  if (!columns_) columns_ = std::make_unique<BoxColumns>(around_);
  return *columns_;
}

bool RingChains::scattered() const {
  if (rings_.size() <= many) return false;
  constexpr std::size_t few = 8;
  std::size_t pairs = 0;
  for (const Ring& ring : rings_) columns().each_around(ring.front(), [&](std::uint32_t) { ++pairs; });
  return pairs <= few * rings_.size();
}

bool RingChains::neighbours(std::uint32_t i, std::uint32_t j) const {
  const std::uint32_t r = ring_of(i), first = first_of(r), last = first_of(r + 1) - 1;
  return i + 1 == j || j + 1 == i ? j >= first && j <= last : std::minmax(i, j) == std::minmax(first, last);
}

/// Whether two edges that touch are neighbours that share the end only.
bool RingChains::join(std::uint32_t i, std::uint32_t j) const {
  if (!neighbours(i, j)) return false;
  Segment s = edge(i), t = edge(j);
  if (s.b != t.a) std::swap(s, t);
  return !fold(s, t);
}

/// Whether b follows a and goes on along an axis, so that they have no point in common but where they join, unless the
/// edges there fold.
bool RingChains::only_join(const Chain& a, const Chain& b) {
  return a.next == b.first && (std::int64_t{a.way.x} * b.way.x >= 0 || std::int64_t{a.way.y} * b.way.y >= 0);
}

template <class F>
struct RingChains::Search {
  const RingChains& all;
  F& f;
  bool folds;         ///< stop at edges that fold
  std::size_t looks;  ///< at pairs of boxes, that are left
  Found found = Found::all;

  bool look() {
    if (looks-- == 0) found = Found::too_slow;
    return found == Found::all;
  }
  void edges(const Piece& a, const Piece& b) {
    const Segment s{a.at[0], a.at[1]}, t{b.at[0], b.at[1]};
    if (!(a.first < b.first ? f(a.first, s, b.first, t) : f(b.first, t, a.first, s))) found = Found::stopped;
  }
  /// Pre: b follows a
  void joint(const Piece& a, const Piece& b) {
    const Point* const end = a.at + a.edges;
    if (folds && fold({end[-1], end[0]}, {b.at[0], b.at[1]})) found = Found::stopped;
  }
  /// Pre: the boxes meet
  void in(const Piece& a, const Box& box_of_a, const Piece& b, const Box& box_of_b) {
    if (a.edges < b.edges) return in(b, box_of_b, a, box_of_a);
    if (a.edges == 1) return edges(a, b);
    const std::uint32_t half = a.edges / 2;
    for (const Piece& part : {Piece{a.at, a.first, half}, Piece{a.at + half, a.first + half, a.edges - half}}) {
      const Box box = part.box();
      if (look() && box.overlaps(box_of_b)) in(part, box, b, box_of_b);
    }
  }
  /// Pre: the chains overlap along x
  void chains(const Chain& a, const Chain& b) {
    if (b.box.min.y > a.box.max.y || b.box.max.y < a.box.min.y) return;
    if (only_join(a, b))
      joint(all.piece(a), all.piece(b));
    else if (only_join(b, a))
      joint(all.piece(b), all.piece(a));
    else
      in(all.piece(a), a.box, all.piece(b), b.box);
  }
  void within(std::uint32_t ring) {
    const auto own = all.of_ring(ring);
    for (std::size_t k = 0; k < own.size() && found == Found::all; ++k)
      for (std::size_t l = k + 1; l < own.size() && own[l].box.min.x <= own[k].box.max.x && look(); ++l)
        chains(own[k], own[l]);
  }
  /// Along x, from chain to chain of either ring.
  void between(std::uint32_t a, std::uint32_t b) {
    const auto of_a = all.of_ring(a), of_b = all.of_ring(b);
    for (std::size_t i = 0, j = 0; i < of_a.size() && j < of_b.size() && found == Found::all;) {
      const bool at_a = of_a[i].box.min.x <= of_b[j].box.min.x;
      const Chain& chain = at_a ? of_a[i++] : of_b[j++];
      const auto others = at_a ? of_b.subspan(j) : of_a.subspan(i);
      if (!chain.box.overlaps(all.around_[at_a ? b : a])) continue;
      for (std::size_t k = 0; k < others.size() && others[k].box.min.x <= chain.box.max.x && look(); ++k)
        chains(chain, others[k]);
    }
  }
};

template <class F>
RingChains::Found RingChains::for_each_near_pair(bool folds, F&& f) const {
  constexpr std::size_t as_long_as_a_grid = 32;  // looks an edge
  Search<F> search{*this, f, folds, as_long_as_a_grid * points_.size()};
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

RingChains::Pairs RingChains::crossing_pairs() const {
  Pairs out;
  const Found found =
      for_each_near_pair(false, [&](std::uint32_t i, const Segment& s, std::uint32_t j, const Segment& t) {
        if (segments_cross(s.a, s.b, t.a, t.b)) out.emplace_back(i, j);
        return true;
      });
  if (found == Found::too_slow) return grid().crossing_pairs();
  std::sort(out.begin(), out.end());
  return out;
}

std::optional<RingChains::Pairs> RingChains::clean_crossings() const {
  if (has_points_) return std::nullopt;
  Pairs out;
  const Found found =
      for_each_near_pair(true, [&](std::uint32_t i, const Segment& s, std::uint32_t j, const Segment& t) {
        if (!segments_touch(s.a, s.b, t.a, t.b) || join(i, j)) return true;
        if (!segments_cross(s.a, s.b, t.a, t.b)) return false;
        out.emplace_back(i, j);
        return true;
      });
  if (found == Found::too_slow) return grid().clean_crossings();
  if (found == Found::stopped) return std::nullopt;
  std::sort(out.begin(), out.end());
  return out;
}

bool RingChains::simple() const {
  if (has_points_) return false;
  const Found found =
      for_each_near_pair(true, [&](std::uint32_t i, const Segment& s, std::uint32_t j, const Segment& t) {
        return !segments_touch(s.a, s.b, t.a, t.b) || join(i, j);
      });
  return found == Found::too_slow ? grid().simple() : found == Found::all;
}

template <class F>
void RingChains::for_each_at(const Chain& chain, Um y, F&& f) const {
  const Piece all = piece(chain);
  const Point *const begin = all.at, *const end = all.at + all.edges + 1;
  const bool up = end[-1].y >= begin->y;
  const Point* at =
      std::partition_point(begin, end, [&](Point p) { return up ? p.y < y : p.y > y; });  // the first that is there
  if (at > begin) --at;
  for (; at + 1 < end && (up ? at->y <= y : at->y >= y); ++at)
    f(all.first + static_cast<std::uint32_t>(at - begin), at[0], at[1]);
}

/// What `windings` tells of one ring. Pre: its box holds p
std::optional<SegmentIndex::RingWinding> RingChains::winding(std::uint32_t ring, Point p) const {
  SegmentIndex::RingWinding own{ring, 0, false};
  bool any = false;
  const auto add = [&](int step) { own.winding += step, own.on |= step == 0, any = true; };
  for (const Chain& chain : of_ring(ring)) {
    if (chain.box.min.x > p.x) break;
    if (chain.box.min.y > p.y || chain.box.max.y < p.y) continue;
    if (chain.box.max.x < p.x) {  // all of it is further left
      const Piece all = piece(chain);
      const bool up = all.at[all.edges].y > p.y;
      if ((all.at[0].y > p.y) != up) add(up ? -1 : 1);
      continue;
    }
    for_each_at(chain, p.y, [&](std::uint32_t, Point a, Point b) {
      const std::int64_t side = orient(a, b, p);
      if (side == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x)) add(0);
      const bool up = b.y > p.y;
      if ((a.y > p.y) != up && side != 0 && (side > 0) != up) add(up ? -1 : 1);
    });
  }
  return any ? std::optional(own) : std::nullopt;
}

void RingChains::windings(Point p, std::vector<SegmentIndex::RingWinding>& found) const {
  found.clear();
  const auto look = [&](std::uint32_t ring) {
    if (const auto own = winding(ring, p)) found.push_back(*own);
  };
  if (rings_.size() <= many) {
    for (std::uint32_t r = 0; r < around_.size(); ++r)
      if (around_[r].contains(p)) look(r);
    return;
  }
  constexpr std::size_t few = 32;  // around a place: their chains are looked at, not a ray through the grid
  std::vector<std::uint32_t> around;
  columns().each_around(p, [&](std::uint32_t r) { around.push_back(r); });
  if (around.size() > few) return grid().windings(p, found);
  for (const std::uint32_t r : around) look(r);
}

std::uint32_t RingChains::first_left_of(Point p) const {
  if (rings_.size() > many) return grid().first_left_of(p);
  constexpr double equal_um = 0.001;  // above what a double rounds, below what two edges differ by nearly always
  std::uint32_t best = none;
  double best_x_um = 0;
  bool tie = false;
  const auto look = [&](const Chain& chain) {
    for_each_at(chain, p.y, [&](std::uint32_t i, Point a, Point b) {
      const std::int64_t side = orient(a, b, p);
      const bool up = b.y > p.y;
      if ((a.y > p.y) == up || (side > 0) == up || side == 0) return;  // as SegmentIndex
      const double x_um =
          a.x + (static_cast<double>(p.y) - a.y) / (static_cast<double>(b.y) - a.y) * (static_cast<double>(b.x) - a.x);
      if (best != none && x_um < best_x_um - equal_um) return;
      tie = best != none && x_um < best_x_um + equal_um;
      if (!tie || x_um > best_x_um) best = i, best_x_um = x_um;
    });
  };
  const auto may_be_first = [&](const Box& box) {
    return box.min.x <= p.x && box.min.y <= p.y && box.max.y >= p.y &&
           (best == none || box.max.x >= best_x_um - equal_um);
  };
  for (std::uint32_t r = 0; r < around_.size(); ++r)
    if (may_be_first(around_[r]))
      for (const Chain& chain : of_ring(r))
        if (may_be_first(chain.box)) look(chain);
  return tie ? unsure : best;
}

}  // namespace weft::geometry
