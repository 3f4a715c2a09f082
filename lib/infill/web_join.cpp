// SPDX-License-Identifier: GPL-3.0-or-later
// How lines are joined beside the region's edge.
#include "core/stop.h"
#include "infill/web.h"

#include <algorithm>

namespace weft::infill {
namespace {

constexpr double least_inset = 0.7;  // of what a joint keeps from the edge
// In bands. An extruder that lags by 40 ms is at 60 mm/s not there before its end: between two walls that are some
// lines apart a pattern is nothing but dashes and ways between them, if it is not joined.
constexpr double longest_dash = 5.5;

}  // namespace

/// Ends by where they are on the edge, ring by ring.
void Web::order_ends() {
  for (std::uint32_t e = 0; e < ends_.size(); ++e)
    if (on_edge(e)) order_.push_back(e);
  std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (ends_[a].edge != ends_[b].edge) return ends_[a].edge < ends_[b].edge;
    return ends_[a].along != ends_[b].along ? ends_[a].along < ends_[b].along : a < b;
  });
  for (std::size_t i = 0; i < order_.size();) {
    std::size_t last = i;  // one past the ring
    const std::uint32_t ring = outline_.ring_of(ends_[order_[i]].edge);
    while (last < order_.size() && outline_.ring_of(ends_[order_[last]].edge) == ring) ++last;
    rings_.emplace_back(i, last);
    i = last;
  }
  at_ring_.assign(ends_.size(), nobody), in_order_.assign(ends_.size(), nobody);
  for (std::size_t r = 0; r < rings_.size(); ++r)
    for (std::size_t k = rings_[r].first; k < rings_[r].second; ++k)
      at_ring_[order_[k]] = static_cast<std::uint32_t>(r), in_order_[order_[k]] = static_cast<std::uint32_t>(k);
}

/// Whether two neighbours turn into each other on that side wherever both are there: by their numbers, since it would
/// change from layer to layer if it went by where the outline begins.
bool Web::turn_above_others(std::uint32_t a, std::uint32_t b) const {
  const std::size_t i = a / 2, j = b / 2;
  if (std::max(i, j) >= row_.size() || family_[i] != family_[j] || a % 2 != b % 2) return false;
  return std::abs(row_[i] - row_[j]) == 1 && (std::min(row_[i], row_[j]) % 2 == 0) == (a % 2 == 0);
}

/// Joins ends that are neighbours along an edge, going around each ring once; of lines that stand alone those first
/// that turn above others. Paths never close.
void Web::join(double longest) {
  joint_.assign(ends_.size(), nobody);
  arc_.assign(ends_.size(), {});
  bent_.assign(ends_.size(), {});
  set_.resize(lines_.size());
  for (std::uint32_t i = 0; i < set_.size(); ++i) set_[i] = i;
  pull_.resize(ends_.size());
  for (std::uint32_t e = 0; e < ends_.size(); ++e) pull_[e] = free_pull(e);
  if (order_.empty()) order_ends();
  if (!style_.connect || most_ <= 0) return;
  StopNowAndThen stop(64);
  const auto join_those = [&](auto wanted) {
    for (const auto& [first, last] : rings_)
      for (std::size_t k = first; k < last; ++k) {
        stop.step();
        const std::uint32_t a = order_[k], b = order_[k + 1 < last ? k + 1 : first];
        if (joint_[a] == nobody && joint_[b] == nobody && wanted(a, b)) try_join(a, b, longest);
      }
  };
  if (style_.alone) join_those([&](std::uint32_t a, std::uint32_t b) { return turn_above_others(a, b); });
  join_those([](std::uint32_t, std::uint32_t) { return true; });
}

/// Between two ends that stayed alone all joints may be moved on by one end, which makes one more of them.
void Web::join_the_rest(double longest) {
  constexpr std::size_t most_moved = 400, most_tried = 400;
  std::size_t tried = 0;
  for (bool better = true; better;) {
    better = false;
    for (const auto& [first, last] : rings_) {
      const std::size_t count = last - first;
      for (std::size_t k = 0; k < count; ++k) {
        if (joint_[order_[first + k]] != nobody) continue;
        std::vector<std::uint32_t> ends{order_[first + k]};  // up to the next that is alone
        for (std::size_t n = 1; n < count && ends.size() <= most_moved; ++n) {
          ends.push_back(order_[first + (k + n) % count]);
          if (joint_[ends.back()] == nobody) break;
        }
        if (ends.size() < 2 || ends.size() % 2 != 0 || joint_[ends.back()] != nobody) continue;
        stop_if_asked();
        if (++tried > most_tried) return;
        better = shift_joints(ends, longest) || better;
      }
    }
  }
}

/// Joins each pair of the ends, of which the inner ones were joined to their other neighbours; as before when it cannot
/// be done.
bool Web::shift_joints(const std::vector<std::uint32_t>& ends, double longest) {
  struct Kept {
    std::uint32_t joint;
    double pull;
    std::vector<Place> arc;
  };
  for (std::size_t i = 1; i + 1 < ends.size(); i += 2)
    if (joint_[ends[i]] != ends[i + 1]) return false;  // they are joined across the ring's beginning
  std::vector<Kept> kept;
  for (const std::uint32_t e : ends) kept.push_back({joint_[e], pull_[e], arc_[e]});
  for (const std::uint32_t e : ends) part(e);
  find_sets();
  bool done = true;
  for (std::size_t i = 0; i + 1 < ends.size() && done; i += 2) done = try_join(ends[i], ends[i + 1], longest);
  if (done) return true;
  for (const std::uint32_t e : ends) part(e);
  for (std::size_t i = 0; i < ends.size(); ++i)
    joint_[ends[i]] = kept[i].joint, pull_[ends[i]] = kept[i].pull, arc_[ends[i]] = std::move(kept[i].arc);
  return false;
}

/// Lines that are joined with each other, after some were parted.
void Web::find_sets() {
  for (std::uint32_t i = 0; i < set_.size(); ++i) set_[i] = i;
  for (std::uint32_t e = 0; e < joint_.size(); ++e)
    if (joint_[e] != nobody && e < joint_[e]) set_[set_of(e / 2)] = set_of(joint_[e] / 2);
}

void Web::part(std::uint32_t a) {
  const std::uint32_t b = joint_[a];
  if (b == nobody) return;
  joint_[a] = joint_[b] = nobody;
  arc_[a].clear(), arc_[b].clear();
  pull_[a] = free_pull(a), pull_[b] = free_pull(b);
}

bool Web::try_join(std::uint32_t a, std::uint32_t b, double longest) {
  if (std::min(length(a / 2), length(b / 2)) < longest_dash * band_) longest = std::max(longest, most_);
  if (a == b || longest <= 0 || set_of(a / 2) == set_of(b / 2)) return false;
  const double inset = band_ / 2.0 - style_.overlap.um;
  const double before_a = pull_[a], before_b = pull_[b];
  std::optional<std::vector<Place>> arc = arc_between(a, b, inset, longest);
  const auto room = [&](std::uint32_t e) { return pull_[e] + std::max(pull_[e ^ 1U], 0.0) < length(e / 2); };
  const auto crosses = [&] {
    std::vector<Place> way{pulled(a)};
    way.insert(way.end(), arc->begin(), arc->end());
    way.push_back(pulled(b));
    return infill::length_of(way) > neighbours_ && crosses_a_line(way, a / 2, b / 2);
  };
  if (!arc || !room(a) || !room(b) || crosses()) {
    pull_[a] = before_a, pull_[b] = before_b;
    return false;
  }
  joint_[a] = b, joint_[b] = a;
  set_[set_of(a / 2)] = set_of(b / 2);
  arc_[a] = std::move(*arc);
  return true;
}

/// Where the line from that end inwards comes as far from the edge as joints are.
std::optional<Beside::Foot> Web::foot_of(std::uint32_t end) const {
  const std::vector<Place>& places = lines_[end / 2].places;
  Polyline line;
  for (const Place& p : places) line.push_back(on_plane(p));
  if (end % 2 == 1) std::reverse(line.begin(), line.end());
  return beside_->met_by(line);
}

/// The same as arc_between, along the line that keeps the distance from all of the edge: slower.
std::optional<std::vector<Place>> Web::arc_beside(std::uint32_t a, std::uint32_t b, double inset, double longest) {
  if (inset < 1) return std::nullopt;
  if (!beside_) beside_.emplace(region_, rounded(inset));
  const auto from = foot_of(a), to = foot_of(b);
  if (!from || !to) return std::nullopt;
  const auto way = beside_->way(*from, *to, longest);
  if (!way) return std::nullopt;
  pull_[a] = from->way_um, pull_[b] = to->way_um;
  std::vector<Place> arc;
  for (std::size_t i = 1; i + 1 < way->size(); ++i) arc.push_back(relative((*way)[i]));
  return arc;
}

/// Draws both ends back from the edge. @returns the inner points of the way from end a to end b beside it; nothing when
/// it is too long
std::optional<std::vector<Place>> Web::arc_between(std::uint32_t a, std::uint32_t b, double inset, double longest) {
  if (ends_[a].sine < shallowest || ends_[b].sine < shallowest) return arc_beside(a, b, inset, longest);
  for (const std::uint32_t e : {a, b}) pull_[e] = std::max(inset / ends_[e].sine, -style_.overlap.most_um);
  if (pull_[a] >= length(a / 2) || pull_[b] >= length(b / 2)) return std::nullopt;
  std::vector<Place> arc;
  double way = 0;
  Place last = pulled(a);
  std::uint32_t edge = ends_[a].edge;
  const std::uint32_t last_edge = ends_[b].edge;
  const bool wraps = edge == last_edge && ends_[b].along < ends_[a].along;
  for (int steps = 0; edge != last_edge || (wraps && steps == 0); ++steps) {
    constexpr int most_steps = 500;
    const std::uint32_t vertex = outline_.next(edge);
    const Place n = normals_[edge], m = normals_[vertex];
    const double bend = 1 + n.x * m.x + n.y * m.y;
    if (bend < 0.2 || steps > most_steps) return arc_beside(a, b, inset, longest);  // a spike
    const Place p = place(vertex) + (inset / bend) * (n + m);
    const Place step = p - last, forward = {n.y, -n.x};
    if (step.x * forward.x + step.y * forward.y > 0) {  // else the edge is shorter than the inset eats up
      way += norm(step);
      // steps of the grid that areas were found on need not be followed
      if (arc.empty() || norm(p - arc.back()) > band_ / 2.0) arc.push_back(p);
      last = p;
    }
    if (way > longest) return std::nullopt;
    edge = vertex;
  }
  way += norm(pulled(b) - last);
  if (way > longest) return std::nullopt;
  std::erase_if(arc, [&](const Place& p) { return inside_of(p, ends_[a].edge, last_edge) < least_inset * inset; });
  return arc;
}

/// How far inside of the edges from the first to the last a place is; beside a notch a corner's inner point is outside.
double Web::inside_of(Place p, std::uint32_t first, std::uint32_t last) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::uint32_t edge = first;; edge = outline_.next(edge)) {
    const Place from = place(edge), way = place(outline_.next(edge)) - from, to = p - from, n = normals_[edge];
    const double t = (to.x * way.x + to.y * way.y) / std::max(way.x * way.x + way.y * way.y, 1e-9);
    const double off = norm(to - std::clamp(t, 0.0, 1.0) * way);
    if (off < std::abs(nearest)) nearest = to.x * n.x + to.y * n.y < 0 ? -off : off;
    if (edge == last) return nearest;
  }
}

/// Ends that are joined to none are bent along the edge, to where the next line ends.
void Web::anchor(double length) {
  const double inset = band_ / 2.0 - style_.overlap.um;
  for (const auto& [first, last] : rings_) {
    const std::size_t count = last - first;
    if (count < 2) continue;
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t e = order_[first + k];
      if (joint_[e] != nobody) continue;
      const std::uint32_t next = order_[first + (k + 1) % count], before = order_[first + (k + count - 1) % count];
      for (const bool forward : {true, false}) {
        const std::uint32_t other = forward ? next : before;
        if (joint_[other] != nobody && joint_[other] == e) continue;
        const double kept = pull_[e], kept_other = pull_[other];
        auto arc = forward ? arc_between(e, other, inset, 1e9) : arc_between(other, e, inset, 1e9);
        if (!arc || pull_[e] + std::max(pull_[e ^ 1U], 0.0) >= this->length(e / 2)) {
          pull_[e] = kept, pull_[other] = kept_other;
          continue;
        }
        const Place end = pulled(other), start = pulled(e);
        pull_[other] = kept_other;
        if (!forward) std::reverse(arc->begin(), arc->end());
        arc->insert(arc->begin(), start);
        arc->push_back(end);
        // half of the way where the other may come towards it
        const double whole = infill::length_of(*arc), room = joint_[other] == nobody ? whole / 2 : whole;
        const double way = std::min(length, room - band_);
        if (way < band_) {
          pull_[e] = kept;
          continue;
        }
        shorten(*arc, whole - way);
        bent_[e].assign(arc->begin() + 1, arc->end());
        break;
      }
    }
  }
}

}  // namespace weft::infill
