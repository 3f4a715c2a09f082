// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/sparse.h"

#include "core/stop.h"
#include "core/table.h"
#include "geometry/offset.h"
#include "geometry/simplify.h"
#include "geometry/spatial_index.h"
#include "infill/fit_sides.h"
#include "infill/gyroid.h"
#include "infill/scan.h"
#include "model/flow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace weft::infill {
namespace {

constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();
constexpr double least_narrowing = 0.75;  // of the band, for the joints' sake
constexpr double least_inset = 0.7;       // of what a joint keeps from the edge
constexpr double shallowest = 0.3;        // sine of the angle between line and edge below which they are not joined

/// A place in the layer, fractional microns.
struct Place {
  double x = 0, y = 0;
};
Place operator+(Place a, Place b) {
  return {a.x + b.x, a.y + b.y};
}
Place operator-(Place a, Place b) {
  return {a.x - b.x, a.y - b.y};
}
Place operator*(double s, Place a) {
  return {s * a.x, s * a.y};
}
double norm(Place a) {
  return std::hypot(a.x, a.y);
}

/// A piece of the pattern between two edges of the region; its ends are `2i` and `2i + 1`.
struct Line {
  std::vector<Place> places;
  double length = 0;
};

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

/// An end of a line on the region's edge.
struct End {
  std::uint32_t edge = 0;
  double along = 0;  ///< where on the edge, 0 … 1
  double sine = 1;   ///< of the angle between line and edge
};

/// Lines of a region and where they end, and how they are joined to paths.
class Web {
 public:
  Web(const Region& region, const SparseStyle& style) : style_(style), outline_(region, Frame(0, style.origin)) {
    const std::vector<Turned>& points = outline_.points();
    normals_.reserve(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      const Place d = place(outline_.next(i)) - place(i);
      const double l = std::max(norm(d), 1e-9);
      normals_.push_back({-d.y / l, d.x / l});  // to the left: inwards
    }
  }

  void add_lines(const Region& region, double angle_rad, double spacing) {
    const Frame frame(angle_rad, style_.origin);
    const Outline turned(region, frame);
    const double first = std::ceil(turned.least_y() / spacing) * spacing;
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
      const double way = infill::length_of(places);
      lines_.push_back({std::move(places), way});
      for (const std::uint32_t edge : {i.from_edge, i.to_edge}) {
        const Turned p = turned.points()[edge], q = turned.points()[turned.next(edge)];
        ends_.push_back({edge, (y - p.y) / (q.y - p.y), std::abs(q.y - p.y) / std::hypot(q.x - p.x, q.y - p.y)});
      }
    }
  }

  /// Cuts curves with the region. Pre: they begin and end outside of it.
  void add_curves(const Region& region, const std::vector<Polyline>& curves) {
    const geometry::SegmentIndex edges(Regions{region});
    std::vector<geometry::SegmentIndex::Crossing> met;
    for (const Polyline& curve : curves) {
      stop_if_asked();
      std::vector<Place> piece;
      End begin;
      for (std::size_t i = 1; i < curve.size(); ++i) {
        const Point a = curve[i - 1], b = curve[i];
        met.clear();
        edges.crossings(a, b, met);
        for (const auto& m : met) {
          const Place p = relative(a) + m.along * (relative(b) - relative(a));
          if (m.enters) {  // a curve may seem to enter twice where it runs through a corner: the later place counts
            piece.assign(1, p), begin = end_of(edges, m, a, b);
          } else if (!piece.empty()) {
            piece.push_back(p);
            ends_.push_back(begin), ends_.push_back(end_of(edges, m, a, b));  // a line's ends are its pair
            const double way = infill::length_of(piece);
            lines_.push_back({std::move(piece), way});
            piece.clear();
          }
        }
        if (!piece.empty()) piece.push_back(relative(b));
      }
    }
  }

  void emit(double spacing, Um band, Beads& beads) {
    band_ = band;
    double raw = 0;
    for (const Line& line : lines_) raw += line.length;
    // joints that make up much of a small area's plastic are not worth it: shorter ones, or none
    for (const double longest : {1.5 * spacing, 0.75 * spacing, 0.4 * spacing, 0.0}) {
      join(style_.connect ? longest : 0.0);
      const std::vector<std::vector<Place>> paths = joined_paths();
      double laid = 0;
      for (const std::vector<Place>& path : paths) laid += infill::length_of(path);
      if (laid <= 0) return;
      if (style_.connect && longest > 0 && raw < least_narrowing * laid) continue;
      return write(paths, std::max(1, rounded(band * std::clamp(raw / laid, least_narrowing, 1.0))), beads);
    }
  }

 private:
  /// Beside an edge along it a line bends aside, so as not to lie in a wall.
  void give_way(const std::vector<Sides>& sides, const Interval& i, double y, double angle_rad,
                std::vector<Place>& places) const {
    const double half = style_.band / 2.0;
    for (const Sides& each : sides) {
      const double aside = std::min(each.above, half) - std::min(each.below, half);
      if (aside != 0 && each.x > i.from && each.x < i.to) places.push_back(turn(each.x, y + aside, angle_rad));
    }
  }
  static Place turn(double x, double y, double angle_rad) {
    const double c = std::cos(angle_rad), s = std::sin(angle_rad);
    return {x * c - y * s, x * s + y * c};
  }
  Place place(std::uint32_t i) const { return {outline_.points()[i].x, outline_.points()[i].y}; }
  Place relative(Point p) const {
    return {static_cast<double>(p.x) - style_.origin.x, static_cast<double>(p.y) - style_.origin.y};
  }
  double length(std::uint32_t line) const { return lines_[line].length; }
  static End end_of(const geometry::SegmentIndex& edges, const geometry::SegmentIndex::Crossing& met, Point a,
                    Point b) {
    const geometry::Segment& s = edges.segments()[met.segment];
    const double ex = s.b.x - s.a.x, ey = s.b.y - s.a.y, dx = b.x - a.x, dy = b.y - a.y;
    const double px = a.x + met.along * dx - s.a.x, py = a.y + met.along * dy - s.a.y, l2 = ex * ex + ey * ey;
    return {static_cast<std::uint32_t>(met.segment), std::clamp((px * ex + py * ey) / l2, 0.0, 1.0),
            std::abs(ex * dy - ey * dx) / std::sqrt(l2 * (dx * dx + dy * dy))};
  }
  /// The line, walked from that end, as it is after both ends were shortened or prolonged.
  std::vector<Place> walked_from(std::uint32_t end) const {
    std::vector<Place> places = lines_[end / 2].places;
    shorten(places, pull_[end | 1U]);
    std::reverse(places.begin(), places.end());
    shorten(places, pull_[end & ~1U]);
    if (end % 2 == 0) std::reverse(places.begin(), places.end());
    return places;
  }
  /// Where the line ends after it was shortened.
  Place pulled(std::uint32_t end) const {
    std::vector<Place> places = lines_[end / 2].places;
    if (end % 2 == 0) std::reverse(places.begin(), places.end());
    shorten(places, pull_[end]);
    return places.back();
  }
  std::uint32_t set_of(std::uint32_t line) {
    while (set_[line] != line) line = set_[line] = set_[set_[line]];
    return line;
  }

  /// Joins ends that are neighbours along an edge, going around each ring once. Paths never close.
  void join(double longest) {
    joint_.assign(ends_.size(), nobody);
    arc_from_.clear();
    set_.resize(lines_.size());
    for (std::uint32_t i = 0; i < set_.size(); ++i) set_[i] = i;
    pull_.resize(ends_.size());
    for (std::uint32_t e = 0; e < ends_.size(); ++e)
      pull_[e] = -style_.overlap_um / std::max(ends_[e].sine, shallowest);
    if (longest <= 0) return;
    std::vector<std::uint32_t> order(ends_.size());
    for (std::uint32_t e = 0; e < order.size(); ++e) order[e] = e;
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      if (ends_[a].edge != ends_[b].edge) return ends_[a].edge < ends_[b].edge;
      return ends_[a].along != ends_[b].along ? ends_[a].along < ends_[b].along : a < b;
    });
    StopNowAndThen stop(64);
    for (std::size_t i = 0; i < order.size();) {
      std::size_t last = i;  // one past the ring
      const std::uint32_t ring = outline_.ring_of(ends_[order[i]].edge);
      while (last < order.size() && outline_.ring_of(ends_[order[last]].edge) == ring) ++last;
      for (std::size_t k = i; k < last; ++k) {
        stop.step();
        const std::uint32_t a = order[k], b = order[k + 1 < last ? k + 1 : i];
        if (joint_[a] == nobody && joint_[b] == nobody) try_join(a, b, longest);
      }
      i = last;
    }
  }

  void try_join(std::uint32_t a, std::uint32_t b, double longest) {
    if (a == b || set_of(a / 2) == set_of(b / 2)) return;
    if (ends_[a].sine < shallowest || ends_[b].sine < shallowest) return;
    const double inset = band_ / 2.0 - style_.overlap_um;
    const auto room = [&](std::uint32_t e) {
      return inset / ends_[e].sine + std::max(pull_[e ^ 1U], 0.0) < length(e / 2);
    };
    if (!room(a) || !room(b)) return;
    const double before_a = pull_[a], before_b = pull_[b];
    pull_[a] = inset / ends_[a].sine, pull_[b] = inset / ends_[b].sine;
    std::optional<std::vector<Place>> arc = arc_between(a, b, inset, longest);
    if (!arc) {
      pull_[a] = before_a, pull_[b] = before_b;
      return;
    }
    joint_[a] = b, joint_[b] = a;
    set_[set_of(a / 2)] = set_of(b / 2);
    arc_from_.emplace_back(a, std::move(*arc));
  }

  /// The inner points of the way from end a to end b beside the edge; nothing when it is too long or folds.
  std::optional<std::vector<Place>> arc_between(std::uint32_t a, std::uint32_t b, double inset, double longest) const {
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

  /// How far inside of the edges from the first to the last a place is; beside a notch a corner's inner point is
  /// outside.
  double inside_of(Place p, std::uint32_t first, std::uint32_t last) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::uint32_t edge = first;; edge = outline_.next(edge)) {
      const Place from = place(edge), way = place(outline_.next(edge)) - from, to = p - from, n = normals_[edge];
      const double t = (to.x * way.x + to.y * way.y) / std::max(way.x * way.x + way.y * way.y, 1e-9);
      const double off = norm(to - std::clamp(t, 0.0, 1.0) * way);
      if (off < std::abs(nearest)) nearest = to.x * n.x + to.y * n.y < 0 ? -off : off;
      if (edge == last) return nearest;
    }
  }

  std::vector<std::vector<Place>> joined_paths() const {
    std::vector<const std::vector<Place>*> arc(ends_.size(), nullptr);
    for (const auto& [end, places] : arc_from_) arc[end] = &places;
    std::vector<std::vector<Place>> paths;
    std::vector<bool> done(lines_.size(), false);
    StopNowAndThen stop(64);
    for (std::uint32_t start = 0; start < ends_.size(); ++start) {
      stop.step();
      if (joint_[start] != nobody || done[start / 2]) continue;
      std::vector<Place> path;
      for (std::uint32_t e = start;;) {
        done[e / 2] = true;
        const std::vector<Place> line = walked_from(e);
        path.insert(path.end(), line.begin(), line.end());
        const std::uint32_t a = e ^ 1U, b = joint_[a];
        if (b == nobody) break;
        if (arc[a] != nullptr)
          path.insert(path.end(), arc[a]->begin(), arc[a]->end());
        else if (arc[b] != nullptr)
          path.insert(path.end(), arc[b]->rbegin(), arc[b]->rend());
        e = b;
      }
      if (infill::length_of(path) >= style_.band) paths.push_back(std::move(path));  // shorter is a blob
    }
    return paths;
  }

  void write(const std::vector<std::vector<Place>>& paths, Um width, Beads& beads) const {
    for (const std::vector<Place>& path : paths) {
      Bead bead;
      bead.role = Role::infill, bead.part = style_.part;
      bead.path.reserve(path.size());
      for (const Place& p : path) {
        const Junction j{
            {style_.origin.x + rounded(p.x), style_.origin.y + rounded(p.y)}, width, static_cast<float>(style_.layers)};
        if (bead.path.empty() || bead.path.back().at != j.at) bead.path.push_back(j);
      }
      if (bead.path.size() >= 2) beads.push_back(std::move(bead));
    }
  }

  const SparseStyle& style_;
  Outline outline_;
  std::vector<Place> normals_;
  std::vector<Line> lines_;
  std::vector<End> ends_;
  std::vector<std::uint32_t> joint_, set_;
  Um band_ = 0;
  std::vector<double> pull_;  // how far each end is drawn back along its line
  std::vector<std::pair<std::uint32_t, std::vector<Place>>> arc_from_;
};

/// Loops at even distances from the edge; their width makes up for the middle, where they do not come out even.
void fill_concentric(const Region& region, const SparseStyle& style, Beads& beads) {
  const double spacing = style.band / style.density;
  std::vector<Ring> loops;
  double way = 0;
  Regions rest{region};
  for (bool first = true; !rest.empty(); first = false) {
    rest = geometry::offset(rest, {.by = -std::max(1, rounded(first ? spacing / 2 : spacing))});
    for (Region& r : rest) {
      loops.push_back(r.outer);
      loops.insert(loops.end(), r.holes.begin(), r.holes.end());
    }
  }
  std::erase_if(loops, [&](const Ring& loop) { return perimeter_of(loop) < style.band; });
  for (const Ring& loop : loops) way += perimeter_of(loop);
  if (way <= 0) return;
  const double wanted = style.density * area_mm2(region) * 1e6 / style.band;  // length of beads
  const Um width = std::max(1, rounded(style.band * std::clamp(wanted / way, least_narrowing, 1 / least_narrowing)));
  for (const Ring& loop : loops) {
    Bead& bead = beads.emplace_back();
    bead.role = Role::infill, bead.part = style.part, bead.closed = true;
    bead.path.reserve(loop.size());
    for (const Point p : loop) bead.path.push_back({p, width, static_cast<float>(style.layers)});
  }
}

/// Follows the pattern's direction; its curves cross the whole region.
void fill_gyroid(const Region& region, const SparseStyle& style, Beads& beads) {
  const double period = gyroid_period(style.band, style.density);
  const Frame frame(style.angle_rad, style.origin);
  Span2 area{{1e300, 1e300}, {-1e300, -1e300}};
  for (const Point p : region.outer) {
    const Turned t = frame.into(p);
    area.min = {std::min(area.min.x, t.x), std::min(area.min.y, t.y)};
    area.max = {std::max(area.max.x, t.x), std::max(area.max.y, t.y)};
  }
  constexpr Um chord = 10;  // how far a simplified curve may stand off
  std::vector<Polyline> curves;
  for (const std::vector<Turned>& curve : gyroid_curves(area, period, style.z)) {
    stop_if_asked();
    Polyline line;
    line.reserve(curve.size());
    for (const Turned t : curve) line.push_back(frame.back(t));
    curves.push_back(geometry::simplified_line(line, chord));
  }
  Web web(region, style);
  web.add_curves(region, curves);
  // at heights where the curves are long they are thin, so that each layer has the density
  web.emit(period / 2, std::max(1, rounded(style.band / gyroid_length_ratio(period, style.z))), beads);
}

/// Lines in as many directions, evenly turned: each direction has its share of the density.
template <int directions>
void fill_crossed(const Region& region, const SparseStyle& style, Beads& beads) {
  const double apart = directions * (style.band / style.density);  // of lines in one direction
  Web web(region, style);
  for (int i = 0; i < directions; ++i)
    web.add_lines(region, style.angle_rad + static_cast<double>(i) / directions * std::numbers::pi, apart);
  web.emit(apart, style.band, beads);
}

void fill_lines(const Region& region, const SparseStyle& style, Beads& beads) {
  SparseStyle turned = style;
  if (style.turned_layer) turned.angle_rad += std::numbers::pi / 2;
  fill_crossed<1>(region, turned, beads);
}

/// One row a pattern.
struct PatternRow {
  InfillPattern pattern;
  void (*fill)(const Region& region, const SparseStyle& style, Beads& beads);
};
constexpr std::array pattern_rows{
    PatternRow{InfillPattern::lines, fill_lines},           PatternRow{InfillPattern::grid, fill_crossed<2>},
    PatternRow{InfillPattern::triangles, fill_crossed<3>},  PatternRow{InfillPattern::gyroid, fill_gyroid},
    PatternRow{InfillPattern::concentric, fill_concentric},
};
static_assert(in_order(pattern_rows, &PatternRow::pattern), "row i of pattern_rows is pattern i");
static_assert(pattern_rows.size() == choices_of(InfillPattern{}).size(), "a pattern has no row");

}  // namespace

Um width_of_sparse(const InfillSettings& infill, Um nozzle, Um height) {
  return infill.infill_line_width.value_or(flow::automatic_width(nozzle, height, false));
}

SparseStyle sparse_style(const InfillSettings& infill, const SparseLayer& layer) {
  return {.pattern = infill.infill_pattern,
          .density = infill.infill_sparse_density / 100,
          .band = flow::band(width_of_sparse(infill, layer.nozzle, layer.height), layer.height),
          .angle_rad = infill.infill_angle * std::numbers::pi / 180,
          .connect = infill.infill_connect_lines,
          .turned_layer = layer.index % 2 == 1,
          .z = layer.z,
          .origin = layer.origin};
}

void fill_sparse(const Region& region, const SparseStyle& style, Beads& beads) {
  if (style.band <= 0 || style.density <= 0 || region.outer.size() < 3) return;
  row_of(pattern_rows, style.pattern).fill(region, style, beads);
}

}  // namespace weft::infill
