// SPDX-License-Identifier: GPL-3.0-or-later
// Paths of a web made fewer: loops opened into what runs beside them, ends joined from farther away.
#include "core/stop.h"
#include "infill/web.h"

#include <algorithm>

namespace weft::infill {

/// The next end along the ring, or the one before.
std::uint32_t Web::beside(std::uint32_t end, bool after) const {
  const auto [first, last] = rings_[at_ring_[end]];
  const std::size_t k = in_order_[end];
  if (after) return order_[k + 1 < last ? k + 1 : first];
  return order_[k > first ? k - 1 : last - 1];
}

/// From an end without a joint through all lines of its path.
std::uint32_t Web::other_end_of_path(std::uint32_t end) const {
  std::uint32_t e = end ^ 1U;
  while (joint_[e] != nobody) e = joint_[e] ^ 1U;
  return e;
}

/// Of a path that only lacks the joint between its two ends to be a loop, the one of them behind which the other
/// follows along the edge.
std::uint32_t Web::gap_of_loop(std::uint32_t end) const {
  const std::uint32_t other = other_end_of_path(end);
  if (!on_edge(end) || !on_edge(other) || at_ring_[end] != at_ring_[other]) return nobody;
  if (beside(end, true) == other) return end;
  return beside(other, true) == end ? other : nobody;
}

/// Parts x and y from what they are joined to and joins them; paths that were loops but for a gap are closed there.
/// @param gap of x's loop, as gap_of_loop says
/// @returns whether there is one path less now; else everything is as before
bool Web::merge_at(std::uint32_t x, std::uint32_t y, std::uint32_t gap, double longest) {
  struct Kept {
    std::uint32_t end, joint;
    double pull;
    std::vector<Place> arc;
  };
  const std::uint32_t x2 = joint_[x], y2 = joint_[y];
  std::uint32_t other_gap = nobody;
  if (y2 != nobody) {
    std::uint32_t e = y;  // to an end of y's path
    while (joint_[e] != nobody) e = joint_[e] ^ 1U;
    other_gap = gap_of_loop(e);
    if (other_gap == nobody) return false;
  }
  const bool after = beside(x, true) == y;
  std::vector<Kept> kept;
  const auto keep = [&](std::uint32_t e) {
    if (e != nobody) kept.push_back({e, joint_[e], pull_[e], arc_[e]});
  };
  const auto closed = [&](std::uint32_t end) { return end == nobody ? nobody : beside(end, true); };
  for (const std::uint32_t e : {x, x2, y, y2, gap, closed(gap), other_gap, closed(other_gap)}) keep(e);
  part(x), part(y);
  find_sets();
  bool done = after ? try_join(x, y, longest) : try_join(y, x, longest);
  // x at its own gap: there is nothing to close
  if (done && x2 != nobody) done = try_join(gap, closed(gap), longest);
  if (done && y2 != nobody) done = try_join(other_gap, closed(other_gap), longest);
  if (done && !crosses_a_line(way_of(after ? x : y), x / 2, y / 2)) return true;
  for (Kept& k : kept) joint_[k.end] = nobody;
  for (Kept& k : kept) joint_[k.end] = k.joint, pull_[k.end] = k.pull, arc_[k.end] = std::move(k.arc);
  find_sets();
  return false;
}

/// Tries all places where a loop lies beside another path along the edge.
bool Web::merge_loop(std::uint32_t start, double longest, std::size_t& tries) {
  const std::uint32_t gap = gap_of_loop(start);
  if (gap == nobody) return false;
  std::uint32_t e = start;
  for (;;) {
    for (const std::uint32_t x : {e, e ^ 1U}) {
      if (!on_edge(x)) continue;
      for (const bool after : {true, false}) {
        const std::uint32_t y = beside(x, after);
        if (y == x || y == joint_[x] || set_of(y / 2) == set_of(x / 2)) continue;
        if (joint_[x] == nobody && joint_[y] == nobody) continue;  // that was tried
        if (tries == 0) return false;
        --tries;
        if (merge_at(x, y, gap, longest)) return true;
      }
    }
    const std::uint32_t next = joint_[e ^ 1U];
    if (next == nobody) return false;
    e = next;
  }
}

/// Where all ends are joined, lines of a lattice often close to loops, each a path that lacks one joint. Two that lie
/// beside each other somewhere along the edge become one path there.
void Web::merge_loops(double longest) {
  std::size_t tries = 1000 + 200'000'000 / std::max<std::size_t>(lines_.size() * lines_.size(), 1);  // bounds the work
  tries = std::min<std::size_t>(tries, 20'000);
  find_sets();
  for (bool better = true; better && tries > 0;) {
    better = false;
    for (std::uint32_t e = 0; e < ends_.size(); ++e) {
      if (joint_[e] != nobody || !on_edge(e)) continue;
      stop_if_asked();
      better = merge_loop(e, longest, tries) || better;
    }
  }
}

/// Of the joint that was made from that end, with both its ends.
std::vector<Place> Web::way_of(std::uint32_t end) const {
  std::vector<Place> way{pulled(end)};
  way.insert(way.end(), arc_[end].begin(), arc_[end].end());
  way.push_back(pulled(joint_[end]));
  return way;
}

/// Whether a way along the edge meets a line that comes near the edge without ending there; that may be one of its own
/// two, which it begins and ends on. Where lines cross each other anyway it may.
bool Web::crosses_a_line(const std::vector<Place>& way, std::uint32_t a, std::uint32_t b) {
  if (families_ > 1 && !style_.bend) return false;
  if (line_of_.empty()) {
    std::vector<geometry::Segment> segments;
    for (std::uint32_t line = 0; line < lines_.size(); ++line) {
      const std::vector<Place>& places = lines_[line].places;
      for (std::size_t i = 1; i < places.size(); ++i) {
        segments.push_back({on_plane(places[i - 1]), on_plane(places[i])});
        line_of_.push_back(line);
      }
    }
    all_lines_ = geometry::SegmentIndex(std::move(segments));
  }
  const double beginning = band_ / 2.0;
  const auto near_end = [&](Place p) { return norm(p - way.front()) < beginning || norm(p - way.back()) < beginning; };
  std::vector<geometry::SegmentIndex::Crossing> met;
  for (std::size_t k = 1; k < way.size(); ++k) {
    met.clear();
    all_lines_.crossings(on_plane(way[k - 1]), on_plane(way[k]), met);
    for (const auto& each : met) {
      const std::uint32_t line = line_of_[each.segment];
      if ((line != a && line != b) || !near_end(way[k - 1] + each.along * (way[k] - way[k - 1]))) return true;
    }
  }
  return false;
}

/// Ends that stayed alone beside each other, the nearest first, as long as there is plastic for it.
/// @param most_more  how much longer all paths may become
void Web::join_far(double longest, double most_more) {
  struct Pair {
    double far;
    std::uint32_t a, b;
  };
  std::vector<Pair> pairs;
  for (const std::uint32_t a : order_) {
    if (joint_[a] != nobody) continue;
    const std::uint32_t b = beside(a, true);
    if (b == a || joint_[b] != nobody) continue;
    pairs.push_back({norm(pulled(a) - pulled(b)), a, b});
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& p, const Pair& q) { return p.far < q.far; });
  find_sets();
  for (const Pair& pair : pairs) {
    if (joint_[pair.a] != nobody || joint_[pair.b] != nobody) continue;
    stop_if_asked();
    if (!try_join(pair.a, pair.b, std::min(longest, most_more))) continue;
    const std::vector<Place> way = way_of(pair.a);
    if (crosses_a_line(way, pair.a / 2, pair.b / 2)) {
      part(pair.a);
      find_sets();
    } else {
      most_more -= length_of(way);
    }
  }
}

}  // namespace weft::infill
