// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/trace.h"

#include "core/stop.h"
#include "walls/mitre.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace weft::walls {
namespace {

using Vertex = Line::Vertex;
constexpr double same_um = 0.5;      // places, and widths
constexpr double nothing_um = 0.01;  // what is less is rounding

double quad_area(Place a, Place b, Place c, Place d) {
  return 0.5 * std::abs(cross(a, b, c) + cross(a, c, d));
}

/// What the widths of a piece are multiplied with, so that its volume is the area it stands for: ribs of a tapering
/// part are not perpendicular to the bead.
double fit(double area, double mean_width, double length) {
  if (length < 1 || mean_width < 1) return 1;
  return std::clamp(area / (mean_width * length), 0.5, 1.6);
}

/// One bead over one half: its two ends, and where between them it bends at once.
struct Piece {
  Vertex start, end;
  std::optional<Vertex> bend{};
};

/// The beads of all halves, numbered.
struct Slots {
  std::vector<std::uint32_t> first;
  explicit Slots(const Laying& laying, std::size_t halves) : first(halves + 1, 0) {
    for (std::size_t h = 0; h < halves; ++h)
      first[h + 1] = first[h] + static_cast<std::uint32_t>(laying.spans[h / 2].pairs);
  }
  std::size_t of(std::uint32_t half, std::size_t bead) const { return first[half] + bead; }
};

Piece pair_piece(const Skeleton& s, const Laying& laying, std::uint32_t h, std::size_t i) {
  const double *a = laying.start(h), *b = laying.end(h);
  const auto start = s.start_rib(h), end = s.end_rib(h);
  const bool inner = i > 0;  // an outer wall keeps its distance
  const double out = inner ? laying.mitres[h].out : 1, out_end = inner ? laying.mitres[s.halves[h].next].out : 1;
  Piece p{{start.at(out * (a[i] + a[i + 1]) / 2), a[i + 1] - a[i]},
          {end.at(out_end * (b[i] + b[i + 1]) / 2), b[i + 1] - b[i]}};
  if (const auto bend = bend_of(s, laying, h, (a[i] + a[i + 1] + b[i] + b[i + 1]) / 4); bend && inner)
    p.bend = Vertex{*bend, (p.start.width + p.end.width) / 2};
  if (out > 1 || out_end > 1) return p;
  // Ribs stand across what is even: what a chord lacks of an arc around a corner is none of its width.
  if (std::abs(a[i] - b[i]) < nothing_um && std::abs(a[i + 1] - b[i + 1]) < nothing_um) return p;
  const Span& span = laying.spans[h / 2];
  if (span.core || span.mouth || span.narrows) {
    const double area = quad_area(start.at(a[i]), end.at(b[i]), end.at(b[i + 1]), start.at(a[i + 1]));
    const double length = distance(p.start.at, p.end.at), mean = (p.start.width + p.end.width) / 2;
    const double f = fit(area, mean, length);
    if (span.narrows && p.start.width != p.end.width) {  // its narrow end is where the corner begins
      double& wide = p.start.width < p.end.width ? p.end.width : p.start.width;
      wide -= 2 * (1 - f) * mean;
    } else {
      p.start.width *= f;
      p.end.width *= f;
    }
  }
  return p;
}

/// Where a rib thinner than a wall begins, the wall would go round the corner on either side of it and dip into the rib
/// between them: the nozzle all but stops there. It goes straight past, over none of the halves of both corners, if it
/// does not come nearer to the corners so.
/// @param last      the last half of the first corner: at its end the wall turns
/// @param i         the wall, counted from the outline
/// @param left_out  of each bead of each half: those between the corners are noted
void go_past(const Skeleton& s, const Laying& laying, std::uint32_t last, std::size_t i, const Slots& slots,
             std::vector<std::uint8_t>& left_out) {
  const auto in_corner = [&](std::uint32_t h) {
    return static_cast<std::size_t>(laying.spans[h / 2].pairs) > i && stands_in_a_corner(s, h);
  };
  std::uint32_t from = last, to = Skeleton::twin(last);
  if (!in_corner(from) || !in_corner(to)) return;
  const double rib = distance(s.halves[from].foot, s.halves[to].foot);
  if (rib > laying.start(from)[i + 1] - laying.start(from)[i]) return;
  while (in_corner(s.halves[from].previous)) from = s.halves[from].previous;
  while (in_corner(s.halves[to].next)) to = s.halves[to].next;
  const Place a = pair_piece(s, laying, from, i).start.at, b = pair_piece(s, laying, to, i).end.at;
  for (const std::uint32_t h : {from, to}) {
    const Place corner = s.halves[h].foot, end = h == from ? a : b;
    if (std::abs(cross(a, b, corner)) < (distance(end, corner) - same_um) * distance(a, b)) return;
  }
  for (std::uint32_t h = from; h != last; h = s.halves[h].next) left_out[slots.of(h, i)] = 1;
  for (std::uint32_t h = to; h != Skeleton::twin(last); h = s.halves[h].previous) left_out[slots.of(h, i)] = 1;
  left_out[slots.of(last, i)] = left_out[slots.of(Skeleton::twin(last), i)] = 1;
}

/// Of each bead of each half, whether it is left out: where walls go straight past ribs.
std::vector<std::uint8_t> left_out_of(const Skeleton& s, const Laying& laying, const Slots& slots) {
  std::vector<std::uint8_t> out(slots.first.back(), 0);
  for (std::uint32_t h = 0; h < s.halves.size(); ++h) {
    if (!laying.spans[h / 2].mouth) continue;
    // Walls that turn back at the end of a half, and at which all others do.
    for (int i = laying.spans[h / 2].pairs; i-- > 0;) {
      std::uint32_t g = s.halves[h].next;
      while (laying.spans[g / 2].pairs <= i) g = s.halves[Skeleton::twin(g)].next;
      if (g != Skeleton::twin(h)) break;
      go_past(s, laying, h, static_cast<std::size_t>(i), slots, out);
    }
  }
  return out;
}

bool same(const Vertex& a, const Vertex& b) {
  return distance(a.at, b.at) < same_um && std::abs(a.width - b.width) <= same_um;
}

/// Whether a bead from a to c is at b where and as wide as it would be without b, to ten nanometres. Half of all ribs
/// belong to what lies on the other side of the axis, and tell this side nothing.
bool says_nothing(const Vertex& a, const Vertex& b, const Vertex& c) {
  const double x = c.at.x - a.at.x, y = c.at.y - a.at.y, px = b.at.x - a.at.x, py = b.at.y - a.at.y;
  const double length2 = x * x + y * y, along = px * x + py * y;
  if (along <= 0 || along >= length2) return false;
  const double aside = px * y - py * x, wider = (a.width - b.width) * length2 + along * (c.width - a.width);
  return std::max(aside * aside, wider * wider / length2) <= nothing_um * nothing_um * length2;
}

void lead_on(std::vector<Vertex>& path, const Vertex& to) {
  const std::size_t n = path.size();
  if (n >= 2 && says_nothing(path[n - 2], path[n - 1], to))
    path.back() = to;
  else
    path.push_back(to);
}

/// Adds a piece to a path; where its width is not that of the path's end, the vertex there is two: a step.
void append(std::vector<Vertex>& path, const Vertex& start, const Vertex& end) {
  if (!path.empty() && same(path.back(), start))
    path.back() = lerp(path.back(), start, 0.5);  // the same from either side
  else
    lead_on(path, start);
  lead_on(path, end);
}

/// A stretch of a loop between turns.
struct Chain {
  std::vector<Vertex> path;
  double before = 0, after = 0;  ///< how far the turn at its start (end) lies beyond the node where the count changes
};

/// How much to take from the end of a path so that a turn there, half as wide again, ends `beyond` before the end.
double turning_room(const std::vector<Vertex>& path, double beyond) {
  double done = 0;
  for (std::size_t i = path.size(); i-- > 1;) {  // none of a path that is empty
    const Vertex &a = path[i], &b = path[i - 1];
    const double length = distance(a.at, b.at);
    const double missing = a.width / 2 + beyond - done;  // falls to 0 where there is room
    const double there = b.width / 2 + beyond - done - length;
    if (missing <= 0) return done;
    if (there <= 0) return done + length * missing / (missing - there);
    done += length;
  }
  return done;
}

/// Where a wall turns back in the middle of a part, its turn lies half its width inside its own stretch: the bead on
/// the axis begins behind it.
void set_back(Chain& chain) {
  auto& path = chain.path;
  const double tail = turning_room(path, chain.after);
  std::reverse(path.begin(), path.end());
  const double head = turning_room(path, chain.before);
  const double scale = std::min(1.0, 0.9 * length_of(path) / std::max(1.0, head + tail));
  cut_end(path, head * scale);
  std::reverse(path.begin(), path.end());
  cut_end(path, tail * scale);
}

/// Where a loop begins is chance: it is no vertex unless it says something.
void close(std::vector<Vertex>& path) {
  if (path.size() < 5) return;
  if (same(path.back(), path.front())) {
    path.front() = lerp(path.back(), path.front(), 0.5);
    path.pop_back();
  }
  if (says_nothing(path[path.size() - 2], path.back(), path[0])) path.pop_back();
  if (says_nothing(path.back(), path[0], path[1])) path.erase(path.begin());
}

struct Loop {
  std::vector<Chain> chains;  ///< a turn between each and the next
};

/// Ends a loop where it began.
/// @param turned_last  there it turns
void finish(Loop& loop, bool turned_last) {
  auto& chains = loop.chains;
  if (turned_last) {
    chains.front().before = chains.back().before;
    chains.pop_back();
    if (chains.size() == 1) {  // a single turn: cut in two halves' worth, both ends are set back
      set_back(chains.front());
    }
  } else if (chains.size() > 1) {  // the first chain goes on in the last
    auto &last = chains.back().path, &start = chains.front().path;
    if (start.size() >= 2) {  // else it goes straight past a rib all along
      append(last, start[0], start[1]);
      last.insert(last.end(), start.begin() + 2, start.end());
    }
    chains.back().after = chains.front().after;
    chains.erase(chains.begin());
    if (chains.size() == 1) set_back(chains.front());
  }
  std::erase_if(chains, [](const Chain& c) { return c.path.size() < 2; });
}

Line joined(Loop& loop, int inset) {
  Line line;
  line.closed = true;
  line.inset = inset;
  auto& chains = loop.chains;
  if (chains.size() > 1) {
    for (auto& chain : chains) set_back(chain);
  }
  for (auto& chain : chains) line.path.insert(line.path.end(), chain.path.begin(), chain.path.end());
  if (chains.size() == 1) close(line.path);
  return line;
}

}  // namespace

double length_of(const std::vector<Vertex>& path) {
  double sum = 0;
  for (std::size_t i = 1; i < path.size(); ++i) sum += distance(path[i - 1].at, path[i].at);
  return sum;
}

double area_of(const std::vector<Vertex>& path) {
  double sum = 0;
  for (std::size_t i = 1; i < path.size(); ++i) sum += area_between(path[i - 1], path[i]);
  return sum;
}

void cut_end(std::vector<Vertex>& path, double by) {
  constexpr double rounding = 1e-6;  // what it leaves must not take the first of two vertices in one place: a step
  while (path.size() > 1 && by > rounding) {
    Vertex &last = path.back(), &before = path[path.size() - 2];
    const double d = distance(last.at, before.at);
    if (d > by) {
      last = lerp(last, before, by / d);
      return;
    }
    by -= d;
    path.pop_back();
  }
}

std::vector<Line> trace_pairs(const Skeleton& s, const Laying& laying) {
  std::vector<Line> out;
  const auto halves = static_cast<std::uint32_t>(s.halves.size());
  const Slots slots(laying, halves);
  std::vector<std::uint8_t> seen(slots.first[halves], 0);
  const auto left_out = left_out_of(s, laying, slots);
  StopNowAndThen stop(64);
  for (std::uint32_t begin = 0; begin < halves; ++begin)
    for (int i = 0; i < laying.spans[begin / 2].pairs; ++i) {
      stop.step();
      const auto k = static_cast<std::uint32_t>(i);
      if (seen[slots.of(begin, k)]) continue;
      Loop loop;
      loop.chains.emplace_back();
      std::uint32_t h = begin;
      bool turned_last = false;
      do {
        seen[slots.of(h, k)] = 1;
        const Piece piece = pair_piece(s, laying, h, k);
        if (!left_out[slots.of(h, k)]) {
          append(loop.chains.back().path, piece.start, piece.bend.value_or(piece.end));
          if (piece.bend) lead_on(loop.chains.back().path, piece.end);
        }
        std::uint32_t g = s.halves[h].next;
        while (laying.spans[g / 2].pairs <= i) g = s.halves[Skeleton::twin(g)].next;
        turned_last = false;
        if (g == Skeleton::twin(h) && !left_out[slots.of(h, k)]) {
          const Piece back = pair_piece(s, laying, g, k);
          if (distance(back.start.at, piece.end.at) > 4) {
            // Along the axis the ends of the ribs lie off the node itself.
            const Place node = s.end(h).at, way = unit(s.start(h).at, node);
            auto beyond = [&](Place p) { return (p.x - node.x) * way.x + (p.y - node.y) * way.y; };
            loop.chains.back().after = beyond(piece.end.at);
            loop.chains.emplace_back();
            loop.chains.back().before = beyond(back.start.at);
            turned_last = true;
          }
        }
        h = g;
      } while (h != begin);
      finish(loop, turned_last);
      Line line = joined(loop, i);
      if (line.path.size() >= 2) out.push_back(std::move(line));
    }
  return out;
}

std::vector<std::vector<Place>> trace_rest(const Skeleton& s, const Laying& laying) {
  std::vector<std::vector<Place>> out;
  const auto halves = static_cast<std::uint32_t>(s.halves.size());
  std::vector<std::uint8_t> seen(halves, 0);
  for (std::uint32_t begin = 0; begin < halves; ++begin) {
    if (seen[begin] || !laying.spans[begin / 2].open) continue;
    std::vector<Place> ring;
    auto add = [&](Place p) {
      if (ring.empty() || distance(ring.back(), p) >= same_um) ring.push_back(p);
    };
    std::uint32_t h = begin;
    do {
      seen[h] = 1;
      const auto k = static_cast<std::size_t>(laying.spans[h / 2].pairs);
      add(s.on_start_rib(h, std::min(laying.start(h)[k], s.start(h).clearance)));
      add(s.on_end_rib(h, std::min(laying.end(h)[k], s.end(h).clearance)));
      h = s.halves[h].next;
      while (!laying.spans[h / 2].open) h = s.halves[Skeleton::twin(h)].next;
    } while (h != begin);
    if (ring.size() >= 3) out.push_back(std::move(ring));
  }
  return out;
}

}  // namespace weft::walls
