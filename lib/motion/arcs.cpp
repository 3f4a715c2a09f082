// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/arcs.h"

#include "core/tolerances.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace weft::motion {
namespace {

constexpr std::size_t least_pieces = 2;  // two lines are longer than one arc
constexpr std::size_t first_tries = 3;   // what is flat over two pieces may bend over four
constexpr double most_rad = 1.9 * std::numbers::pi;
constexpr double largest_radius_um = 1e6;
constexpr double lattice_um = 1.5;  // what the rounding of the centre moves an arc by

double angle_about(Point centre, Point p) {
  return std::atan2(static_cast<double>(p.y - centre.y), static_cast<double>(p.x - centre.x));
}

/// How far the arc turns, radians, > 0.
double sweep_of(Point from, Point to, const Arc& arc) {
  const double turn = angle_about(arc.centre, to) - angle_about(arc.centre, from);
  const double sweep = std::fmod(arc.ccw ? turn : -turn, 2 * std::numbers::pi);
  return sweep < 0 ? sweep + 2 * std::numbers::pi : sweep;
}

/// How far the piece from a to b is from the circle at most: at its ends, and where it comes nearest to the centre.
double off_circle_um(Point centre, double radius, Point a, Point b) {
  const double to_a = distance(centre, a), to_b = distance(centre, b);
  double off = std::max(std::abs(to_a - radius), std::abs(to_b - radius));
  const double length = distance(a, b);
  if (length == 0) return off;
  const double along = static_cast<double>(dot(centre - a, b - a)) / length;
  if (along > 0 && along < length) {
    const double foot = std::abs(static_cast<double>(orient(a, b, centre))) / length;
    off = std::max(off, std::abs(foot - radius));
  }
  return off;
}

/// Firmware rounds down: its pieces may be nearly twice as long as they are meant.
int pieces_of(double length_um, double chord_um) {
  return std::max(1, static_cast<int>(length_um / chord_um));
}

class Fitter {
 public:
  Fitter(const ArcRules& rules, const Extrude& bead) : rules_(rules), bead_(bead), path_(bead.path) {}

  /// The arc from junction `first` that goes on longest.
  std::optional<Arc> longest_from(std::size_t first) const {
    std::size_t good = first + least_pieces, bad = path_.size();
    std::optional<Arc> best;
    for (std::size_t tries = 0; !best && tries < first_tries; ++tries, ++good) {
      if (good >= bad || furthest(first, good) < good) return std::nullopt;
      best = arc(first, good);
    }
    if (!best) return std::nullopt;
    good = best->last;
    for (std::size_t step = least_pieces; good + 1 < bad; step *= 2) {  // gallop
      const std::size_t wanted = std::min(good + step, bad - 1), next = furthest(first, wanted);
      if (next < wanted) bad = next + 1;
      if (next == good) break;
      auto longer = arc(first, next);
      if (!longer) {
        bad = next;
        break;
      }
      best = longer, good = next;
    }
    while (good + 1 < bad) {  // bisect
      const std::size_t middle = good + (bad - good) / 2;
      if (auto longer = arc(first, middle))
        best = longer, good = middle;
      else
        bad = middle;
    }
    return stays_round(*best) ? best : std::nullopt;
  }

  /// Two arcs that follow each other as one, which may turn by more than 180°.
  std::optional<Arc> joined(const Arc& a, const Arc& b) const {
    if (a.last != b.first || a.ccw != b.ccw || distance(a.centre, b.centre) > lattice_um + rules_.tolerance ||
        furthest(a.first, b.last) < b.last)
      return std::nullopt;
    for (const Point centre : {a.centre, b.centre, lerp(a.centre, b.centre, 0.5)}) {
      const Arc both{a.first, b.last, centre, a.ccw};
      const double begin = distance(centre, path_[a.first].at), end = distance(centre, path_[b.last].at);
      if (std::abs(begin - end) <= lattice_um && holds(both, most_rad)) return both;
    }
    return std::nullopt;
  }

 private:
  /// Do the pieces that firmware cuts it into stand off it by no more than its tolerance?
  bool stays_round(const Arc& arc) const {
    const Point from = path_[arc.first].at;
    const double radius = distance(arc.centre, from), length = radius * sweep_of(from, path_[arc.last].at, arc);
    const double piece = length / pieces_of(length, chord_um(rules_.firmware, rules_.segment, radius));
    return piece * piece <= 8 * radius * rules_.tolerance;
  }

  /// Along the piece from junction i, which is extruded evenly.
  double laid(std::size_t i) const { return (laid_at(path_[i]) + laid_at(path_[i + 1])) / 2; }
  static double laid_at(const Junction& j) { return j.width * static_cast<double>(j.flow); }
  bool has_room(Point p) const {
    return rules_.room.empty() || (p.x >= rules_.room.min.x && p.x <= rules_.room.max.x && p.y >= rules_.room.min.y &&
                                   p.y <= rules_.room.max.y);
  }

  /// How far one speed, one band and the room go, up to junction `last`.
  std::size_t furthest(std::size_t first, std::size_t last) const {
    if (!has_room(path_[first].at)) return first;
    double least = laid(first), most = least;
    std::size_t i = first;
    while (i < last) {
      const std::size_t next = i + 1;
      if (!bead_.segment_speed_mm_s.empty() && bead_.segment_speed_mm_s[next - 1] != bead_.segment_speed_mm_s[first])
        break;
      least = std::min(least, laid(i)), most = std::max(most, laid(i));
      if (most - least > tolerances::band_step || !has_room(path_[next].at) || path_[next].at == path_[i].at) break;
      i = next;
    }
    return i;
  }

  std::optional<Arc> arc(std::size_t first, std::size_t last) const {
    const auto h = sagitta(first, last);
    if (!h || std::abs(*h) <= rules_.tolerance) return std::nullopt;
    const Point a = path_[first].at, b = path_[last].at;
    const double half = distance(a, b) / 2, x = (static_cast<double>(b.x) - a.x) / (2 * half),
                 y = (static_cast<double>(b.y) - a.y) / (2 * half);
    if (std::abs(*h) >= half) return std::nullopt;                // half a circle or more
    const double to_centre = (*h * *h - half * half) / (2 * *h);  // from the chord, to its left
    const double radius = std::hypot(half, to_centre);
    if (radius > largest_radius_um) return std::nullopt;
    Arc out{static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last), {}, *h < 0};
    out.centre = {rounded((static_cast<double>(a.x) + b.x) / 2 - to_centre * y),
                  rounded((static_cast<double>(a.y) + b.y) / 2 + to_centre * x)};
    return holds(out, std::numbers::pi) ? std::optional(out) : std::nullopt;
  }

  /// The middle of what each junction allows, µm to the left of the chord.
  std::optional<double> sagitta(std::size_t first, std::size_t last) const {
    const Point a = path_[first].at, b = path_[last].at;
    const double half = distance(a, b) / 2;
    if (half == 0) return std::nullopt;
    const double ux = (static_cast<double>(b.x) - a.x) / (2 * half), uy = (static_cast<double>(b.y) - a.y) / (2 * half);
    // The circle through the ends and (x, y), from the chord's middle: its centre lies at (x² + y² − half²) / 2y.
    const auto through = [&](double x, double y) {
      if (y == 0) return 0.0;
      const double centre = (x * x + y * y - half * half) / (2 * y), root = std::hypot(centre, half);
      return y > 0 ? half * half / (root - centre) : -half * half / (root + centre);
    };
    double least = -half, most = half;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double dx = static_cast<double>(path_[i].at.x) - a.x, dy = static_cast<double>(path_[i].at.y) - a.y;
      const double x = dx * ux + dy * uy - half, y = dy * ux - dx * uy;
      if (std::abs(x) >= half) return std::nullopt;  // it bulges beyond the chord: more than half a circle
      least = std::max(least, through(x, y - rules_.tolerance));
      most = std::min(most, through(x, y + rules_.tolerance));
      if (least > most) return std::nullopt;
    }
    return 0.5 * (least + most);
  }

  /// Does it stay within the tolerance, and turn by less than that?
  bool holds(const Arc& arc, double less_than_rad) const {
    const double radius = distance(arc.centre, path_[arc.first].at), most = rules_.tolerance + lattice_um;
    const double step = 2 * std::numbers::pi / 3;  // no piece goes so far round, nor back
    for (std::size_t i = arc.first; i < arc.last; ++i) {
      const Point p = path_[i].at, q = path_[i + 1].at;
      if (off_circle_um(arc.centre, radius, p, q) > most || sweep_of(p, q, arc) > step) return false;
    }
    double turned = 0;
    for (std::size_t i = arc.first; i < arc.last; ++i) turned += sweep_of(path_[i].at, path_[i + 1].at, arc);
    return turned < less_than_rad;
  }

  const ArcRules& rules_;
  const Extrude& bead_;
  const std::vector<Junction>& path_;
};

}  // namespace

void fit_arcs(const ArcRules& rules, Extrude& bead) {
  bead.arcs.clear();
  if (!bead.below.empty()) return;
  const Fitter fitter(rules, bead);
  for (std::size_t i = 0; i + least_pieces < bead.path.size();) {
    const auto arc = fitter.longest_from(i);
    if (!arc) {
      ++i;
      continue;
    }
    const auto both = bead.arcs.empty() ? std::nullopt : fitter.joined(bead.arcs.back(), *arc);
    if (both)
      bead.arcs.back() = *both;
    else
      bead.arcs.push_back(*arc);
    i = arc->last;
  }
}

double deviation_um(const Extrude& bead, const Arc& arc) {
  const double radius = distance(arc.centre, bead.path[arc.first].at);
  double most = 0;
  for (std::size_t i = arc.first; i < arc.last; ++i)
    most = std::max(most, off_circle_um(arc.centre, radius, bead.path[i].at, bead.path[i + 1].at));
  return most;
}

double chord_um(Firmware firmware, std::optional<Um> segment, double radius_um) {
  constexpr double klipper_um = 1000, marlin_least_um = 100, marlin_most_um = 1000, marlin_circle = 72, reprap_um = 5;
  if (segment) return *segment;
  if (firmware == Firmware::klipper) return klipper_um;
  if (firmware == Firmware::reprapfirmware) return std::sqrt(8 * radius_um * reprap_um);
  return std::clamp(2 * std::numbers::pi * radius_um / marlin_circle, marlin_least_um, marlin_most_um);
}

Polyline chords_of(Firmware firmware, std::optional<Um> segment, const Extrude& bead, const Arc& arc) {
  const Point from = bead.path[arc.first].at, to = bead.path[arc.last].at;
  const double radius = distance(arc.centre, from), sweep = sweep_of(from, to, arc), length = radius * sweep;
  const int count = pieces_of(length, chord_um(firmware, segment, radius));
  const double begin = angle_about(arc.centre, from);
  Polyline out;
  for (int i = 1; i < count; ++i) {
    const double angle = begin + (arc.ccw ? 1 : -1) * sweep * i / count;
    out.push_back({arc.centre.x + rounded(radius * std::cos(angle)), arc.centre.y + rounded(radius * std::sin(angle))});
  }
  out.push_back(to);
  return out;
}

}  // namespace weft::motion
