// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/web.h"

#include "core/stop.h"
#include "geometry/simplify.h"
#include "infill/few_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::infill {
namespace {

constexpr double farther = 4;       // than other joints are those without which a path would end
constexpr double least_even = 0.8;  // of the band: how narrow lines may become by them

Place turn(double x, double y, double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  return {x * c - y * s, x * s + y * c};
}

}  // namespace

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

Web::Web(const Region& region, const SparseStyle& style)
    : region_(region), style_(style), outline_(region, Frame(0, style.origin)) {
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

void Web::add_lines(const Region& region, const Lines& of) {
  const Frame frame(of.angle_rad, style_.origin);
  const Outline turned(region, frame);
  const double first = std::ceil((turned.least_y() - of.phase) / of.spacing) * of.spacing + of.phase;
  const LineSet lines{first, of.spacing, static_cast<int>(std::floor((turned.greatest_y() - first) / of.spacing)) + 1};
  const std::vector<Interval> intervals = turned.cut(lines);
  const std::vector<Interval> wanted =
      of.within != nullptr ? Outline(*of.within, frame).cut(lines) : std::vector<Interval>{};
  const SideFit fit(turned, lines, intervals, style_.band);
  // bent crossings need all lines to run into one half of the plane
  const double turns = std::round(of.angle_rad / (2 * std::numbers::pi) * 1e6) / 1e6;
  const bool backwards = style_.bend && turns - std::floor(turns) >= 0.5;
  if (of.more) --families_;
  const auto add = [&](std::uint32_t k, double from, double to) {
    Interval i = intervals[k];
    const double y = lines.y(i.line);
    const auto end_at = [&](std::uint32_t edge, bool on_edge) {
      const Turned p = turned.points()[edge], q = turned.points()[turned.next(edge)];
      return on_edge ? End{edge, (y - p.y) / (q.y - p.y), std::abs(q.y - p.y) / std::hypot(q.x - p.x, q.y - p.y)}
                     : End{};
    };
    End begin = end_at(i.from_edge, from <= i.from), end = end_at(i.to_edge, to >= i.to);
    i.from = std::max(i.from, from), i.to = std::min(i.to, to);
    std::vector<Place> places{turn(i.from, y, of.angle_rad)};
    if (!fit.is_plain(k)) give_way(fit.of(k), i, y, of.angle_rad, places);
    places.push_back(turn(i.to, y, of.angle_rad));
    if (backwards) std::reverse(places.begin(), places.end()), std::swap(begin, end);
    add_piece(std::move(places), begin, end);
    family_.push_back(families_);
    row_.push_back(std::lround((y - of.phase) / of.spacing));
  };
  StopNowAndThen stop(64);
  for (std::uint32_t k = 0, w = 0; k < intervals.size(); ++k) {
    stop.step();
    const Interval& i = intervals[k];
    if (of.within == nullptr) {
      add(k, i.from, i.to);
      continue;
    }
    constexpr double same = 2;  // µm: what is wanted ends where the region does, but for rounding
    while (w < wanted.size() && (wanted[w].line < i.line || (wanted[w].line == i.line && wanted[w].to <= i.from))) ++w;
    for (std::uint32_t v = w; v < wanted.size() && wanted[v].line == i.line && wanted[v].from < i.to; ++v)
      add(k, wanted[v].from - same, wanted[v].to + same);
  }
  ++families_;
}

/// Of a line from a to b, where it meets an edge.
Web::End Web::end_on(const geometry::SegmentIndex& edges, const geometry::SegmentIndex::Crossing& met, Point a,
                     Point b) {
  const geometry::Segment& s = edges.segments()[met.segment];
  const double ex = s.b.x - s.a.x, ey = s.b.y - s.a.y, dx = b.x - a.x, dy = b.y - a.y;
  const double px = a.x + met.along * dx - s.a.x, py = a.y + met.along * dy - s.a.y, l2 = ex * ex + ey * ey;
  return {static_cast<std::uint32_t>(met.segment), std::clamp((px * ex + py * ey) / l2, 0.0, 1.0),
          std::abs(ex * dy - ey * dx) / std::sqrt(l2 * (dx * dx + dy * dy))};
}

void Web::end_at_lines(double farthest) {
  std::vector<geometry::Segment> segments;
  std::vector<int> family;
  for (std::uint32_t line = 0; line < lines_.size(); ++line)
    for (std::size_t i = 1; i < lines_[line].places.size(); ++i) {
      segments.push_back({on_plane(lines_[line].places[i - 1]), on_plane(lines_[line].places[i])});
      family.push_back(family_[line]);
    }
  const geometry::SegmentIndex all(std::move(segments)), edges(Regions{region_});
  std::vector<geometry::SegmentIndex::Crossing> met;
  StopNowAndThen stop(64);
  for (std::uint32_t e = 0; e < ends_.size(); ++e) {
    if (on_edge(e)) continue;
    stop.step();
    std::vector<Place> places = lines_[e / 2].places;
    if (e % 2 == 0) std::reverse(places.begin(), places.end());
    const Place end = places.back(), before = places[places.size() - 2];
    const double last = norm(end - before);
    if (last <= 0) continue;
    const Place way = (1 / last) * (end - before);
    const double back = std::min(last, farthest);
    const Point from = on_plane(end - back * way), to = on_plane(end + farthest * way);
    met.clear();
    edges.crossings(on_plane(end), to, met);
    const auto wall = met.empty() ? std::nullopt : std::optional(met.front());
    const double room = wall ? wall->along * farthest : farthest;
    met.clear();
    all.crossings(from, to, met);
    double nearest = farthest;
    for (const auto& each : met)
      if (const double by = each.along * (back + farthest) - back;
          family[each.segment] != family_[e / 2] && std::abs(by) < std::abs(nearest) && by < room)
        nearest = by;
    // the line's round end reaches over the other's middle
    double by = style_.band / 2.0 - nearest;
    if (nearest >= farthest || by >= lines_[e / 2].length - style_.band) {
      if (!wall) continue;
      by = -room;
      ends_[e] = end_on(edges, *wall, on_plane(end), to);
    }
    shorten(places, by);
    if (e % 2 == 0) std::reverse(places.begin(), places.end());
    lines_[e / 2].length -= by, lines_[e / 2].places = std::move(places);
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
    return end_on(edges, met, a, b);
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

/// Of all lines and joints as they are.
double Web::laid_length() const {
  double out = 0;
  for (std::uint32_t line = 0; line < lines_.size(); ++line)
    out += length(line) - pull_[2 * line] - pull_[2 * line + 1];
  for (std::uint32_t e = 0; e < ends_.size(); ++e)
    if (joint_[e] != nobody && !arc_[e].empty()) {
      std::vector<Place> way{pulled(e)};
      way.insert(way.end(), arc_[e].begin(), arc_[e].end());
      way.push_back(pulled(joint_[e]));
      out += infill::length_of(way);
    } else if (joint_[e] != nobody && e < joint_[e] && arc_[joint_[e]].empty()) {
      out += norm(pulled(e) - pulled(joint_[e]));
    }
  return out;
}

void Web::emit(double most, Um band, double wanted, Beads& beads) {
  band_ = band;
  double raw = 0, around = 0;
  for (const Line& line : lines_) raw += line.length;
  for (const std::vector<Place>& loop : loops_) around += infill::length_of(loop) + norm(loop.back() - loop.front());
  const double widest = wanted > 0 ? 1 / least_narrowing : 1;
  if (wanted <= 0) wanted = raw + around;
  neighbours_ = most / 2;
  most_ = most;
  // joints that make up much of a small area's plastic are not worth it: shorter ones, or the shortest alone, and those
  // of dashes
  for (const double longest : {most, most / 2, 0.0}) {
    join(longest);
    if (style_.connect && most > 0) join_the_rest(longest);
    if (style_.connect && longest > 0) merge_loops(longest);
    if (style_.connect && most > 0)
      join_far(style_.anchor_max >= 0 ? most : farther * most, wanted / least_even - around - laid_length());
    if (style_.anchor_um > 0) anchor(style_.anchor_um);
    const std::vector<std::vector<Place>> paths = joined_paths();
    double laid = around;
    for (const std::vector<Place>& path : paths) laid += infill::length_of(path);
    if (laid <= 0) return;
    if (style_.connect && !style_.alone && longest > 0 && wanted < least_narrowing * laid) continue;
    return write(paths, std::max(1, rounded(band * std::clamp(wanted / laid, least_narrowing, widest))), beads);
  }
}

double Web::free_pull(std::uint32_t end) const {
  return on_edge(end) ? -style_.overlap.along(std::max(ends_[end].sine, shallowest)) : 0;
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
    Polyline line;
    line.reserve(path.size());
    for (const Place& p : path) {
      const Point at = on_plane(p);
      if (line.empty() || line.back() != at) line.push_back(at);
    }
    if (closed && line.size() > 1 && line.back() == line.front()) line.pop_back();
    if (!closed) line = geometry::simplified_line(line, tolerance_of(style_.density));
    if (line.size() < (closed ? 3U : 2U)) return;
    Bead& bead = beads.emplace_back();
    bead.role = Role::infill, bead.part = style_.part, bead.closed = closed;
    bead.path.reserve(line.size());
    for (const Point at : line) bead.path.push_back({at, width, static_cast<float>(style_.layers)});
  };
  for (const std::vector<Place>& path : paths) write_one(path, false);
  for (const std::vector<Place>& loop : loops_) write_one(loop, true);
}

}  // namespace weft::infill
