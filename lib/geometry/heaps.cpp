// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/heaps.h"

#include "core/stop.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>

namespace weft::geometry::clipper {
namespace {

constexpr std::int64_t gap = 2 * steps;           // more than a corner moves when it is rounded
constexpr std::int64_t frame_gap = 1000 * steps;  // on coarser grids as well

FineBox box_of(const FineRing& ring) {
  FineBox box{ring.front(), ring.front()};
  for (const auto p : ring) {
    box.min = {std::min(box.min.x, p.x), std::min(box.min.y, p.y)};
    box.max = {std::max(box.max.x, p.x), std::max(box.max.y, p.y)};
  }
  return box;
}
FineBox box_of(std::span<const Heap::Item> items) {
  FineBox box = items.front().box;
  for (const auto& item : items) {
    box.min = {std::min(box.min.x, item.box.min.x), std::min(box.min.y, item.box.min.y)};
    box.max = {std::max(box.max.x, item.box.max.x), std::max(box.max.y, item.box.max.y)};
  }
  return box;
}
FineBox grown(const FineBox& box, std::int64_t by) {
  return {{box.min.x - by, box.min.y - by}, {box.max.x + by, box.max.y + by}};
}
/// A rectangle, counter-clockwise.
FineRing outline(const FineBox& box) {
  return {box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}};
}

/// How often a ring goes round a box, if no box of an edge meets it.
struct Around {
  bool meets = false;
  int winding = 0;
};
Around around(const FineRing& ring, const FineBox& box) {
  Around out;
  FinePoint a = ring.back();
  for (const FinePoint b : ring) {
    const auto [left, right] = std::minmax(a.x, b.x);
    const auto [low, high] = std::minmax(a.y, b.y);
    if (left <= box.max.x && right >= box.min.x && low <= box.max.y && high >= box.min.y) return {true, 0};
    // Seen from the box's corner to the right: edges whose box reaches over its height are all beside it.
    if (left > box.max.x && (a.y <= box.min.y) != (b.y <= box.min.y)) out.winding += b.y > a.y ? 1 : -1;
    a = b;
  }
  return out;
}

class Cutter {
 public:
  explicit Cutter(std::vector<Heap::Item> items) : items_(std::move(items)) {}

  std::vector<Heap> heaps() && {
    cut({0, items_.size()}, true, 0, false);
    return std::move(out_);
  }

 private:
  static constexpr std::size_t small = 16;  // is swept as fast as it is cut
  static constexpr int deepest = 12;        // islands in rows and columns need two
  struct Range {
    std::size_t begin, end;
  };

  std::span<Heap::Item> of(Range range) { return std::span(items_).subspan(range.begin, range.end - range.begin); }

  /// @param stuck there was no gap the other way
  void cut(Range range, bool across, int depth, bool stuck) {
    const auto items = of(range);
    if (items.empty()) return;
    if (items.size() <= small || depth == deepest) return put(items);
    stop_if_asked();
    const auto low = [&](const Heap::Item& i) { return across ? i.box.min.x : i.box.min.y; };
    const auto high = [&](const Heap::Item& i) { return across ? i.box.max.x : i.box.max.y; };
    std::stable_sort(items.begin(), items.end(),
                     [&](const Heap::Item& a, const Heap::Item& b) { return low(a) < low(b); });
    std::vector<std::size_t> cuts;
    std::int64_t reach = high(items[0]);
    for (std::size_t i = 1; i < items.size(); ++i) {
      if (low(items[i]) > reach + gap) cuts.push_back(range.begin + i);
      reach = std::max(reach, high(items[i]));
    }
    if (cuts.empty() && stuck) return cut_within(range, depth);
    cuts.push_back(range.end);
    for (const auto next : cuts) cut({std::exchange(range.begin, next), next}, !across, depth + 1, cuts.size() == 1);
  }
  /// What is within few rings by itself, as far as these do not come near.
  void cut_within(Range range, int depth) {
    const auto items = of(range);
    const FineBox box = box_of(items);
    const auto goes_round = [&](const Heap::Item& item) {
      return 2 * (item.box.max.x - item.box.min.x) > box.max.x - box.min.x &&
             2 * (item.box.max.y - item.box.min.y) > box.max.y - box.min.y;
    };
    const auto within = std::stable_partition(items.begin(), items.end(), goes_round);
    const std::size_t few = static_cast<std::size_t>(within - items.begin());
    if (few == 0 || 4 * few > items.size()) return put(items);
    const std::size_t first = out_.size();
    std::vector<Heap::Item> outer(items.begin(), within);
    cut({range.begin + few, range.end}, true, depth + 1, false);
    std::size_t looks = 0, points = 0;
    for (const auto& item : outer) looks += item.ring->size() * (out_.size() - first);
    for (const auto& item : items) points += item.ring->size();
    constexpr std::size_t as_long_as_a_sweep = 64;  // looks a point
    const bool all_near = looks > as_long_as_a_sweep * points;
    std::vector<Heap> apart;
    std::vector<Heap::Item> together = outer;
    for (std::size_t h = first; h < out_.size(); ++h) {
      Heap& heap = out_[h];
      if (!all_near && frame(outer, heap))
        apart.push_back(std::move(heap));
      else
        together.insert(together.end(), heap.items.begin(), heap.items.end());
    }
    out_.resize(first);
    put(together);
    std::move(apart.begin(), apart.end(), std::back_inserter(out_));
  }
  /// Notes how often rings go round a heap. @return whether none comes near
  static bool frame(std::span<const Heap::Item> outer, Heap& heap) {
    const FineBox box = grown(heap.box, gap);
    int subject = 0, clip = 0;
    for (const auto& item : outer) {
      const Around one = around(*item.ring, box);
      if (one.meets) return false;
      (item.clip ? clip : subject) += one.winding;
    }
    heap.around_subject += subject, heap.around_clip += clip;
    return true;
  }
  void put(std::span<const Heap::Item> items) { out_.push_back({{items.begin(), items.end()}, box_of(items), 0, 0}); }

  std::vector<Heap::Item> items_;
  std::vector<Heap> out_;
};

}  // namespace

Heap::Input Heap::input() const {
  Input out;
  for (const auto& item : items) (item.clip ? out.clip : out.subject).push_back(*item.ring);
  std::int64_t by = frame_gap;
  for (const auto& [to, count] : {std::pair(&out.subject, around_subject), std::pair(&out.clip, around_clip)})
    for (int i = 0; i < std::abs(count); ++i, by += frame_gap) {
      to->push_back(outline(grown(box, by)));
      if (count < 0) std::reverse(to->back().begin(), to->back().end());
    }
  return out;
}

bool Heap::is_frame(const Ring& ring, Point origin) const {
  if (around_subject == 0 && around_clip == 0) return false;
  const FinePoint p{(std::int64_t{ring.front().x} - origin.x) * steps,
                    (std::int64_t{ring.front().y} - origin.y) * steps};
  const FineBox own = grown(box, steps);  // corners are rounded
  return p.x < own.min.x || p.x > own.max.x || p.y < own.min.y || p.y > own.max.y;
}

std::vector<Heap> heaps_of(const FineRings& subject, const FineRings& clip) {
  std::vector<Heap::Item> items;
  for (const auto* rings : {&subject, &clip})
    for (const auto& ring : *rings)
      if (!ring.empty()) items.push_back({box_of(ring), &ring, rings == &clip});
  return Cutter(std::move(items)).heaps();
}

}  // namespace weft::geometry::clipper
