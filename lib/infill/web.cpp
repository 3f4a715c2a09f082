// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/web.h"

#include "core/stop.h"

#include <algorithm>

namespace weft::infill {
namespace {

constexpr double least_inset = 0.7;  // of what a joint keeps from the edge
constexpr double shallowest = 0.3;   // sine of the angle between line and edge below which they are not joined

double length_of(const std::vector<Place>& places) {
  double way = 0;
  for (std::size_t i = 1; i < places.size(); ++i) way += norm(places[i] - places[i - 1]);
  return way;
}

/// Shortens a way at its end, or prolongs it when `by` is negative. Pre: by < its length.
void shorten(std::vector<Place>& places, double by) {
  while (places.size() > 2 && norm(places.back() - places[places.size() - 2]) <= by) {
    by -= norm(places.back() - places[places.size() - 2]);
    places.pop_back();
  }
  const Place before = places[places.size() - 2], end = places.back();
  places.back() = end + (by / std::max(norm(before - end), 1e-9)) * (before - end);
}

Place turn(double x, double y, double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  return {x * c - y * s, x * s + y * c};
}

}  // namespace

Web::Web(const Region& region, const SparseStyle& style) : style_(style), outline_(region, Frame(0, style.origin)) {
  const std::vector<Turned>& points = outline_.points();
  normals_.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Place d = place(outline_.next(i)) - place(i);
    const double l = std::max(norm(d), 1e-9);
    normals_.push_back({-d.y / l, d.x / l});  // to the left: inwards
  }
}

void Web::add_piece(std::vector<Place> piece, End from, End to) {
  const double way = infill::length_of(piece);
  lines_.push_back({std::move(piece), way});
  ends_.push_back(from), ends_.push_back(to);  // a line's ends are its pair
}

void Web::add_lines(const Region& region, double angle_rad, double spacing, double phase) {
  const Frame frame(angle_rad, style_.origin);
  const Outline turned(region, frame);
  const double first = std::ceil((turned.least_y() - phase) / spacing) * spacing + phase;
  const LineSet lines{first, spacing, static_cast<int>(std::floor((turned.greatest_y() - first) / spacing)) + 1};
  const std::vector<Interval> intervals = turned.cut(lines);
  const SideFit fit(turned, lines, intervals, style_.band);
  StopNowAndThen stop(64);
  for (std::uint32_t k = 0; k < intervals.size(); ++k) {
    stop.step();
    const Interval& i = intervals[k];
    const double y = lines.y(i.line);
    std::vector<Place> places{turn(i.from, y, angle_rad)};
    if (!fit.is_plain(k)) give_way(fit.of(k), i, y, angle_rad, places);
    places.push_back(turn(i.to, y, angle_rad));
    const auto end_at = [&](std::uint32_t edge) {
      const Turned p = turned.points()[edge], q = turned.points()[turned.next(edge)];
      return End{edge, (y - p.y) / (q.y - p.y), std::abs(q.y - p.y) / std::hypot(q.x - p.x, q.y - p.y)};
    };
    add_piece(std::move(places), end_at(i.from_edge), end_at(i.to_edge));
  }
}

/// Beside an edge along it a line bends aside, so as not to lie in a wall.
void Web::give_way(const std::vector<Sides>& sides, const Interval& i, double y, double angle_rad,
                   std::vector<Place>& places) const {
  const double half = style_.band / 2.0;
  for (const Sides& each : sides) {
    const double aside = std::min(each.above, half) - std::min(each.below, half);
    if (aside != 0 && each.x > i.from && each.x < i.to) places.push_back(turn(each.x, y + aside, angle_rad));
  }
}

void Web::add_curves(const Region& region, const std::vector<Curve>& curves) {
  const geometry::SegmentIndex edges(Regions{region});
  const auto end_of = [&](const geometry::SegmentIndex::Crossing& met, Point a, Point b) {
    const geometry::Segment& s = edges.segments()[met.segment];
    const double ex = s.b.x - s.a.x, ey = s.b.y - s.a.y, dx = b.x - a.x, dy = b.y - a.y;
    const double px = a.x + met.along * dx - s.a.x, py = a.y + met.along * dy - s.a.y, l2 = ex * ex + ey * ey;
    return End{static_cast<std::uint32_t>(met.segment), std::clamp((px * ex + py * ey) / l2, 0.0, 1.0),
               std::abs(ex * dy - ey * dx) / std::sqrt(l2 * (dx * dx + dy * dy))};
  };
  std::vector<geometry::SegmentIndex::Crossing> met;
  for (const Curve& curve : curves) {
    stop_if_asked();
    const Polyline& line = curve.line;
    if (line.size() < 2) continue;
    const std::size_t steps = curve.closed ? line.size() : line.size() - 1;
    std::vector<Place> piece, first_piece;
    End begin, first_end;
    bool cut = false;
    const bool starts_inside = edges.region_at(line.front()).has_value();
    if (starts_inside) piece.push_back(relative(line.front()));
    for (std::size_t i = 0; i < steps; ++i) {
      const Point a = line[i], b = line[(i + 1) % line.size()];
      met.clear();
      edges.crossings(a, b, met);
      for (const auto& m : met) {
        const Place p = relative(a) + m.along * (relative(b) - relative(a));
        if (m.enters) {  // a curve may seem to enter twice where it runs through a corner: the later place counts
          piece.assign(1, p), begin = end_of(m, a, b);
        } else if (!piece.empty()) {
          piece.push_back(p);
          if (curve.closed && starts_inside && !cut)  // goes on where the curve closes
            first_piece = std::move(piece), first_end = end_of(m, a, b);
          else
            add_piece(std::move(piece), begin, end_of(m, a, b));
          piece.clear();
          cut = true;
        }
      }
      if (!piece.empty()) piece.push_back(relative(b));
    }
    if (!cut && piece.size() > 2 && curve.closed) {
      piece.pop_back();
      loops_.push_back(std::move(piece));
    } else if (!first_piece.empty() && !piece.empty()) {
      piece.insert(piece.end(), first_piece.begin() + 1, first_piece.end());
      add_piece(std::move(piece), begin, first_end);
    } else if (!first_piece.empty()) {
      add_piece(std::move(first_piece), End{}, first_end);
    } else if (piece.size() >= 2) {
      add_piece(std::move(piece), begin, End{});
    }
  }
}

void Web::emit(double most, Um band, double wanted, Beads& beads) {
  band_ = band;
  double raw = 0, around = 0;
  for (const Line& line : lines_) raw += line.length;
  for (const std::vector<Place>& loop : loops_) around += infill::length_of(loop) + norm(loop.back() - loop.front());
  const double widest = wanted > 0 ? 1 / least_narrowing : 1;
  if (wanted <= 0) wanted = raw + around;
  // joints that make up much of a small area's plastic are not worth it: shorter ones, or none
  for (const double longest : {most, most / 2, 0.4 / 1.5 * most, 0.0}) {
    join(style_.connect ? longest : 0.0);
    if (style_.connect && longest > 0) join_the_rest(longest);
    if (style_.anchor_um > 0) anchor(style_.anchor_um);
    const std::vector<std::vector<Place>> paths = joined_paths();
    double laid = around;
    for (const std::vector<Place>& path : paths) laid += infill::length_of(path);
    if (laid <= 0) return;
    if (style_.connect && longest > 0 && wanted < least_narrowing * laid) continue;
    return write(paths, std::max(1, rounded(band * std::clamp(wanted / laid, least_narrowing, widest))), beads);
  }
}

double Web::free_pull(std::uint32_t end) const {
  return on_edge(end) ? -style_.overlap_um / std::max(ends_[end].sine, shallowest) : 0;
}

/// The line, walked from that end, as it is after both ends were shortened or prolonged.
std::vector<Place> Web::walked_from(std::uint32_t end) const {
  std::vector<Place> places = lines_[end / 2].places;
  shorten(places, pull_[end | 1U]);
  std::reverse(places.begin(), places.end());
  shorten(places, pull_[end & ~1U]);
  if (end % 2 == 0) std::reverse(places.begin(), places.end());
  return places;
}

/// Where the line ends after it was shortened.
Place Web::pulled(std::uint32_t end) const {
  std::vector<Place> places = lines_[end / 2].places;
  if (end % 2 == 0) std::reverse(places.begin(), places.end());
  shorten(places, pull_[end]);
  return places.back();
}

/// Joins ends that are neighbours along an edge, going around each ring once. Paths never close.
void Web::join(double longest) {
  joint_.assign(ends_.size(), nobody);
  arc_.assign(ends_.size(), {});
  bent_.assign(ends_.size(), {});
  set_.resize(lines_.size());
  for (std::uint32_t i = 0; i < set_.size(); ++i) set_[i] = i;
  pull_.resize(ends_.size());
  for (std::uint32_t e = 0; e < ends_.size(); ++e) pull_[e] = free_pull(e);
  if (order_.empty()) {
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
  }
  if (longest <= 0) return;
  StopNowAndThen stop(64);
  for (const auto& [i, last] : rings_)
    for (std::size_t k = i; k < last; ++k) {
      stop.step();
      const std::uint32_t a = order_[k], b = order_[k + 1 < last ? k + 1 : i];
      if (joint_[a] == nobody && joint_[b] == nobody) try_join(a, b, longest);
    }
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
  for (std::uint32_t i = 0; i < set_.size(); ++i) set_[i] = i;
  for (std::uint32_t e = 0; e < joint_.size(); ++e)
    if (joint_[e] != nobody && e < joint_[e]) set_[set_of(e / 2)] = set_of(joint_[e] / 2);
  bool done = true;
  for (std::size_t i = 0; i + 1 < ends.size() && done; i += 2) done = try_join(ends[i], ends[i + 1], longest);
  if (done) return true;
  for (const std::uint32_t e : ends) part(e);
  for (std::size_t i = 0; i < ends.size(); ++i)
    joint_[ends[i]] = kept[i].joint, pull_[ends[i]] = kept[i].pull, arc_[ends[i]] = std::move(kept[i].arc);
  return false;
}

void Web::part(std::uint32_t a) {
  const std::uint32_t b = joint_[a];
  if (b == nobody) return;
  joint_[a] = joint_[b] = nobody;
  arc_[a].clear(), arc_[b].clear();
  pull_[a] = free_pull(a), pull_[b] = free_pull(b);
}

bool Web::try_join(std::uint32_t a, std::uint32_t b, double longest) {
  if (a == b || set_of(a / 2) == set_of(b / 2)) return false;
  if (ends_[a].sine < shallowest || ends_[b].sine < shallowest) return false;
  const double inset = band_ / 2.0 - style_.overlap_um;
  const auto room = [&](std::uint32_t e) {
    return inset / ends_[e].sine + std::max(pull_[e ^ 1U], 0.0) < length(e / 2);
  };
  if (!room(a) || !room(b)) return false;
  const double before_a = pull_[a], before_b = pull_[b];
  pull_[a] = inset / ends_[a].sine, pull_[b] = inset / ends_[b].sine;
  std::optional<std::vector<Place>> arc = arc_between(a, b, inset, longest);
  if (!arc) {
    pull_[a] = before_a, pull_[b] = before_b;
    return false;
  }
  joint_[a] = b, joint_[b] = a;
  set_[set_of(a / 2)] = set_of(b / 2);
  arc_[a] = std::move(*arc);
  return true;
}

/// The inner points of the way from end a to end b beside the edge; nothing when it is too long or folds.
std::optional<std::vector<Place>> Web::arc_between(std::uint32_t a, std::uint32_t b, double inset,
                                                   double longest) const {
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
    if (bend < 0.2 || steps > most_steps) return std::nullopt;  // a spike
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
  const double inset = band_ / 2.0 - style_.overlap_um;
  for (const auto& [first, last] : rings_) {
    const std::size_t count = last - first;
    if (count < 2) continue;
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t e = order_[first + k];
      if (joint_[e] != nobody || ends_[e].sine < shallowest) continue;
      if (inset / ends_[e].sine + std::max(pull_[e ^ 1U], 0.0) >= this->length(e / 2)) continue;
      const std::uint32_t next = order_[first + (k + 1) % count], before = order_[first + (k + count - 1) % count];
      for (const bool forward : {true, false}) {
        const std::uint32_t other = forward ? next : before;
        if (joint_[other] != nobody && joint_[other] == e) continue;
        const double kept = pull_[e];
        pull_[e] = inset / ends_[e].sine;
        const double before_other = pull_[other];
        pull_[other] = inset / std::max(ends_[other].sine, shallowest);
        if (pull_[other] >= this->length(other / 2)) pull_[other] = 0;
        auto arc = forward ? arc_between(e, other, inset, 1e9) : arc_between(other, e, inset, 1e9);
        const Place end = pulled(other), start = pulled(e);
        pull_[other] = before_other;
        if (!arc) {
          pull_[e] = kept;
          continue;
        }
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

std::vector<std::vector<Place>> Web::joined_paths() const {
  std::vector<std::vector<Place>> paths;
  std::vector<bool> done(lines_.size(), false);
  StopNowAndThen stop(64);
  for (std::uint32_t start = 0; start < ends_.size(); ++start) {
    stop.step();
    if (joint_[start] != nobody || done[start / 2]) continue;
    std::vector<Place> path(bent_[start].rbegin(), bent_[start].rend());
    for (std::uint32_t e = start;;) {
      done[e / 2] = true;
      const std::vector<Place> line = walked_from(e);
      path.insert(path.end(), line.begin(), line.end());
      const std::uint32_t a = e ^ 1U, b = joint_[a];
      if (b == nobody) {
        path.insert(path.end(), bent_[a].begin(), bent_[a].end());
        break;
      }
      path.insert(path.end(), arc_[a].begin(), arc_[a].end());
      path.insert(path.end(), arc_[b].rbegin(), arc_[b].rend());
      e = b;
    }
    if (infill::length_of(path) >= style_.band) paths.push_back(std::move(path));  // shorter is a blob
  }
  return paths;
}

void Web::write(const std::vector<std::vector<Place>>& paths, Um width, Beads& beads) const {
  const auto write_one = [&](const std::vector<Place>& path, bool closed) {
    Bead bead;
    bead.role = Role::infill, bead.part = style_.part, bead.closed = closed;
    bead.path.reserve(path.size());
    for (const Place& p : path) {
      const Junction j{
          {style_.origin.x + rounded(p.x), style_.origin.y + rounded(p.y)}, width, static_cast<float>(style_.layers)};
      if (bead.path.empty() || bead.path.back().at != j.at) bead.path.push_back(j);
    }
    if (closed && bead.path.size() > 1 && bead.path.back().at == bead.path.front().at) bead.path.pop_back();
    if (bead.path.size() >= (closed ? 3U : 2U)) beads.push_back(std::move(bead));
  };
  for (const std::vector<Place>& path : paths) write_one(path, false);
  for (const std::vector<Place>& loop : loops_) write_one(loop, true);
}

}  // namespace weft::infill
