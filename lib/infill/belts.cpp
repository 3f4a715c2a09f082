// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/belts.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "geometry/simplify.h"

#include <algorithm>
#include <cmath>

namespace weft::infill {
namespace {

constexpr int most_lines = 3;
constexpr double widest = most_lines + 0.5;  // bands: wider ones are filled across
constexpr double looked_at = 7;              // bands: how deep
constexpr double step_um = 200;              // along the wall: half a bead
constexpr double mean_over_um = 4000;        // along the wall, of a belt's width: no line begins and ends for less
constexpr double shortest_um = 2000;         // of a line, and of a pause in it
constexpr Um wall_within = 25;               // of the wall: the edge that belts follow. Less than grids know of it
constexpr Um over_wall = 100;                // that an area is drawn over the wall beside it
constexpr Um over_line = 10;                 // and over the line beside it

/// A place on a ring around a belt.
struct Sample {
  double along = 0;  // µm from the ring's first point, of the middle of what it stands for
  double length = 0;
  double width = 0;        // of the belt there, from the wall
  double over = 0;         // by how much its mean is within the limits between which there is a line
  bool free = false;       // solid or sparse: a line may go on there
  bool line = false;       // there is one
  bool all_solid = false;  // from wall to wall
};

/// A ring, and how a belt lies along it.
class Along {
 public:
  /// @param depth of the ring below the wall
  Along(const Ring& ring, double depth, const Mask& solid, const Mask& sparse, double band)
      : ring_(ring), cell_(solid.grid().cell), most_(looked_at * band) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point a = ring[i], b = ring[(i + 1) % ring.size()];
      const double length = distance(a, b);
      if (length == 0) continue;
      const double nx = -(b.y - a.y) / length, ny = (b.x - a.x) / length;  // inwards: the inside is to the left
      const int looks = static_cast<int>(std::ceil(length / step_um));
      for (int k = 0; k < looks; ++k) {
        const Point p = lerp(a, b, (k + 0.5) / looks);
        const auto at = [&](double d) {
          return Point{p.x + rounded((d - depth) * nx), p.y + rounded((d - depth) * ny)};
        };
        Sample s{perimeter_ + (k + 0.5) / looks * length, length / looks, 0};
        s.free = solid.at(p) || sparse.at(p);
        if (s.free) look_across(at, depth, solid, sparse, s);
        samples_.push_back(s);
      }
      perimeter_ += length;
    }
    find_all_solid();
  }

  /// Decides where the line at that depth runs.
  void decide(double depth, double band) {
    const std::vector<double> mean = means();
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      samples_[i].over = std::min(mean[i] - depth, widest * band - mean[i]);
      samples_[i].line = samples_[i].free && samples_[i].over >= 0;
    }
    // a pause is closed where it is short, then what is short goes
    turn_short(false);
    turn_short(true);
  }

  std::vector<BeltLine> lines() const {
    const std::size_t n = samples_.size();
    const auto is_line = [](const Sample& s) { return s.line; };
    if (std::all_of(samples_.begin(), samples_.end(), is_line)) return {{ring_, true}};
    std::vector<BeltLine> out;
    for (std::size_t first = 0; first < n; ++first) {
      if (!samples_[first].line || samples_[(first + n - 1) % n].line) continue;
      std::size_t count = 1;
      while (samples_[(first + count) % n].line) ++count;
      const Sample &a = samples_[first], &b = samples_[(first + count - 1) % n];
      out.push_back(
          {between(a.along - a.length / 2 + later(first), b.along + b.length / 2 + later(first + count)), false});
    }
    return out;
  }

  bool any() const {
    return std::any_of(samples_.begin(), samples_.end(), [](const Sample& s) { return s.line; });
  }

 private:
  /// From the wall to the first cell that is sparse, or half way to the other side.
  template <class At>
  void look_across(const At& at, double depth, const Mask& solid, const Mask& sparse, Sample& s) const {
    double way = cell_ / 2;
    for (; way < most_; way += cell_) {
      const Point p = at(way);
      if (sparse.at(p)) {
        s.width = way - cell_ / 2;
        return;
      }
      if (way >= depth && !solid.at(p)) break;
    }
    s.width = (way - cell_ / 2) / 2, s.all_solid = true;
  }

  /// A spike between belts is as wide as they are; where all is solid for longer there is no belt.
  void find_all_solid() {
    const std::size_t n = samples_.size();
    const auto all_solid = [](const Sample& s) { return s.all_solid; };
    if (std::all_of(samples_.begin(), samples_.end(), all_solid)) return widen(0, n);
    for (std::size_t first = 0; first < n; ++first) {
      if (!samples_[first].all_solid || samples_[(first + n - 1) % n].all_solid) continue;
      double length = 0;
      std::size_t count = 0;
      for (; samples_[(first + count) % n].all_solid; ++count) length += samples_[(first + count) % n].length;
      if (length >= shortest_um) widen(first, count);
    }
  }
  void widen(std::size_t first, std::size_t count) {
    for (std::size_t k = first; k < first + count; ++k) samples_[k % samples_.size()].width = most_;
  }

  /// Of the widths around each place.
  std::vector<double> means() const {
    const std::size_t n = samples_.size();
    std::vector<double> mean(n);
    std::size_t first = 0, count = 0;  // of the window [first, first + count), round the ring
    double length = 0, sum = 0;
    const auto take = [&](std::size_t i, double sign) {
      const Sample& s = samples_[i % n];
      length += sign * s.length, sum += sign * s.length * s.width;
    };
    const auto place = [&](std::size_t i) { return samples_[i % n].along + perimeter_ * static_cast<double>(i / n); };
    const double half = std::min(mean_over_um, perimeter_) / 2;
    for (std::size_t i = 0; i < n; ++i) {
      // one turn on, so that the window never begins before the ring
      const double here = place(i + n);
      if (i == 0)
        for (first = n; first > 0 && place(first - 1) >= here - half;) --first;
      while (place(first) < here - half && count > 0) take(first, -1), ++first, --count;
      while (count < n && place(first + count) <= here + half) take(first + count, 1), ++count;
      mean[i] = length > 0 ? sum / length : 0;
    }
    return mean;
  }

  /// How much later than that sample what it is begins: where its mean passes the limit.
  double later(std::size_t i) const {
    const std::size_t n = samples_.size();
    const Sample &a = samples_[(i + n - 1) % n], &b = samples_[i % n];
    if (!a.free || !b.free || (a.over >= 0) == (b.over >= 0)) return 0;
    return a.over / (a.over - b.over) * (a.length + b.length) / 2 - a.length / 2;
  }

  /// Runs that have a line, or none, and are short become the other; a pause only where a line may go on.
  void turn_short(bool line) {
    const std::size_t n = samples_.size();
    for (std::size_t first = 0; first < n; ++first) {
      if (samples_[first].line != line || samples_[(first + n - 1) % n].line == line) continue;
      double length = -later(first);
      bool may = true;
      std::size_t count = 0;
      for (; count < n && samples_[(first + count) % n].line == line; ++count) {
        length += samples_[(first + count) % n].length;
        may &= line || samples_[(first + count) % n].free;
      }
      if (length + later(first + count) >= shortest_um || !may) continue;
      for (std::size_t k = 0; k < count; ++k) samples_[(first + k) % n].line = !line;
    }
  }

  /// The ring from one place to another.
  Polyline between(double from, double to) const {
    if (to <= from) to += perimeter_;
    Polyline out;
    const std::size_t n = ring_.size();
    double at = 0;
    for (std::size_t i = 0; i < 2 * n && at < to; ++i) {
      const Point a = ring_[i % n], b = ring_[(i + 1) % n];
      const double length = distance(a, b);
      if (length > 0 && at + length > from) {
        if (out.empty()) out.push_back(lerp(a, b, std::max(0.0, (from - at) / length)));
        out.push_back(lerp(a, b, std::min(1.0, (to - at) / length)));
      }
      at += length;
    }
    return out;
  }

  Ring ring_;
  double cell_, most_;
  std::vector<Sample> samples_;
  double perimeter_ = 0;
};

/// What lies that far to the left and to the right of a line: rings, one a segment, which overlap at corners.
void draw(const BeltLine& line, double left, double right, std::vector<Ring>& rings) {
  const Polyline& path = line.path;
  const std::size_t n = path.size(), segments = line.closed ? n : n - 1;
  const auto normal = [&](std::size_t i) {  // of a segment, to the left, of length 1
    const Point a = path[i % n], b = path[(i + 1) % n];
    const double length = std::max(1.0, distance(a, b));
    return std::pair{-(b.y - a.y) / length, (b.x - a.x) / length};
  };
  constexpr double least = 0.25;  // of 1 + cos: corners sharper than about 140° are cut off
  const auto beside = [&](std::size_t i, double by) {
    const bool begins = !line.closed && i == 0, ends = !line.closed && i + 1 == n;
    const auto [ax, ay] = normal(begins ? 0 : (i + n - 1) % n);
    const auto [bx, by_] = normal(ends ? n - 2 : i);
    const double scale = by / std::max(least, 1 + ax * bx + ay * by_);
    return Point{path[i].x + rounded(scale * (ax + bx)), path[i].y + rounded(scale * (ay + by_))};
  };
  for (std::size_t i = 0; i < segments; ++i) {
    const std::size_t j = (i + 1) % n;
    Ring quad{beside(i, -right), beside(j, -right), beside(j, left), beside(i, left)};
    if (double_area(quad) < 0) std::reverse(quad.begin(), quad.end());
    rings.push_back(std::move(quad));
  }
}

/// The belts of one region of the inside.
Belts::Of belts_of(const Region& region, const Mask& solid, const Mask& sparse, double band) {
  Belts::Of out;
  const Regions wall = geometry::simplified(Regions{region}, wall_within);
  std::vector<Ring> area;
  for (int k = 1; k <= most_lines; ++k) {
    stop_if_asked();
    const double depth = (k - 0.5) * band;
    const std::size_t before = out.lines.size();
    for (const Ring& ring : geometry::rings_of(geometry::offset(wall, {.by = -rounded(depth)}))) {
      Along along(ring, depth, solid, sparse, band);
      along.decide(depth, band);
      if (!along.any()) continue;
      for (BeltLine& line : along.lines()) {
        draw(line, band / 2, band / 2 + (k == 1 ? over_wall : over_line), area);
        out.lines.push_back(std::move(line));
      }
    }
    if (out.lines.size() == before) break;  // no belt is wide enough for the next
  }
  if (!area.empty()) out.area = geometry::regions_from_rings(area);
  return out;
}

}  // namespace

Belts find_belts(const Regions& inside, const Mask& solid, const Mask& sparse, Um band) {
  Belts belts{{}, Mask(solid.grid())};
  if (!solid.any() || !sparse.any()) return belts;
  Regions all;
  for (std::size_t i = 0; i < inside.size(); ++i) {
    Belts::Of of = belts_of(inside[i], solid, sparse, band);
    if (of.lines.empty()) continue;
    of.region = i;
    all.insert(all.end(), of.area.begin(), of.area.end());
    belts.found.push_back(std::move(of));
  }
  if (!all.empty()) belts.area = Mask(solid.grid(), all);
  return belts;
}

}  // namespace weft::infill
