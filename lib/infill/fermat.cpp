// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/fermat.h"

#include "core/stop.h"
#include "geometry/offset.h"
#include "geometry/spatial_index.h"
#include "infill/few_points.h"
#include "infill/web.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace weft::infill {
namespace {

constexpr double farthest = 1.6;  // distances of rings that may be joined, in those they have by themselves
constexpr double apart = 1.2;     // least distance of two openings of a ring
constexpr std::size_t most_samples = 128;

/// A place where a ring is opened to go over to another.
struct Opening {
  double at = 0, half = 0;  ///< along the ring, µm
  std::size_t ring = 0;     ///< the other one, and its opening
  std::size_t opening = 0;
};

/// A ring by the length along it.
class Loop {
 public:
  Loop(Ring ring, std::size_t on_level, std::size_t of_region)
      : level(on_level), region(of_region), ring_(std::move(ring)) {
    way_.reserve(ring_.size() + 1);
    way_.push_back(0);
    for (std::size_t i = 0; i < ring_.size(); ++i)
      way_.push_back(way_.back() + distance(ring_[i], ring_[(i + 1) % ring_.size()]));
  }
  const Ring& ring() const { return ring_; }
  double length() const { return way_.back(); }
  double along(std::size_t edge, double share) const { return std::lerp(way_[edge], way_[edge + 1], share); }
  double around(double at) const { return at - length() * std::floor(at / length()); }
  double between(double a, double b) const {
    const double d = around(a - b);
    return std::min(d, length() - d);
  }
  Point at(double along) const {
    along = around(along);
    auto after = std::upper_bound(way_.begin(), way_.end(), along);
    if (after == way_.end()) --after;
    const auto edge = static_cast<std::size_t>(after - way_.begin()) - 1;
    const Point a = ring_[edge], b = ring_[(edge + 1) % ring_.size()];
    const double share = (along - way_[edge]) / std::max(way_[edge + 1] - way_[edge], 1e-9);
    return {rounded(std::lerp(a.x, b.x, share)), rounded(std::lerp(a.y, b.y, share))};
  }
  /// Appends the way from a place on, so far one way (+1) or the other (−1), with both its ends.
  void walk(double from, double so_far, int way, Ring& to) const {
    to.push_back(at(from));
    std::vector<std::pair<double, std::size_t>> passed;
    for (std::size_t i = 0; i < ring_.size(); ++i) {
      const double d = around(way > 0 ? way_[i] - from : from - way_[i]);
      if (d > 0 && d < so_far) passed.emplace_back(d, i);
    }
    std::sort(passed.begin(), passed.end());
    for (const auto& [d, i] : passed) to.push_back(ring_[i]);
    to.push_back(at(from + way * so_far));
  }

  std::size_t level, region;
  std::vector<Opening> openings;

 private:
  Ring ring_;
  std::vector<double> way_;
};

class Spiral {
 public:
  Spiral(std::vector<Regions> levels, double spacing) : spacing_(spacing), levels_(std::move(levels)) {
    for (std::size_t level = 0; level < levels_.size(); ++level)
      for (std::size_t r = 0; r < levels_[level].size(); ++r) {
        add(levels_[level][r].outer, level, r);
        for (const Ring& hole : levels_[level][r].holes) add(hole, level, r);
      }
    set_.resize(loops_.size());
    std::iota(set_.begin(), set_.end(), std::size_t{0});
    join();
  }

  /// The rings as closed lines.
  std::vector<Ring> lines() {
    std::vector<Ring> out;
    std::vector<bool> done(loops_.size(), false);
    for (std::size_t i = 0; i < loops_.size(); ++i) {
      if (done[i]) continue;
      Ring& line = out.emplace_back();
      if (loops_[i].openings.empty()) {
        done[i] = true;
        line = loops_[i].ring();
        continue;
      }
      // begins behind its first opening, which is passed last
      const Opening& first = loops_[i].openings.front();
      follow(i, first.at + first.half, 1, loops_[i].openings.size(), line, done);
      line.erase(std::unique(line.begin(), line.end()), line.end());
    }
    return out;
  }

 private:
  void add(const Ring& ring, std::size_t level, std::size_t region) {
    if (ring.size() >= 3 && perimeter_of(ring) > spacing_) loops_.emplace_back(ring, level, region);
  }
  std::size_t set_of(std::size_t i) {
    while (set_[i] != i) i = set_[i] = set_[set_[i]];
    return i;
  }

  /// Each ring with those of the region around it, as long as that closes no circle.
  void join() {
    std::size_t outer = 0;  // first ring of the level around
    for (std::size_t i = 0; i < loops_.size(); ++i) {
      stop_if_asked();
      const std::size_t level = loops_[i].level;
      if (level == 0) continue;
      while (loops_[outer].level + 1 < level) ++outer;
      const Regions& around = levels_[level - 1];
      const Point inside = loops_[i].ring().front();
      for (std::size_t k = outer; k < i && loops_[k].level + 1 == level; ++k) {
        if (set_of(i) == set_of(k)) continue;
        if (side_of(around[loops_[k].region].outer, inside) == Side::outside) continue;
        open_towards(i, k);
      }
    }
  }

  /// Opens two rings where they are near each other: far from where the outer one is opened already, so that lines go
  /// half around it before they go in.
  void open_towards(std::size_t inner, std::size_t outer) {
    Loop &a = loops_[inner], &b = loops_[outer];
    const geometry::SegmentIndex index(std::span<const Ring>(&b.ring(), 1));
    struct Candidate {
      double on_a, on_b, far;
    };
    std::vector<Candidate> found;
    double least = std::numeric_limits<double>::infinity();
    const auto samples = static_cast<std::size_t>(std::clamp(a.length() / spacing_, 16.0, double{most_samples}));
    for (std::size_t k = 0; k < samples; ++k) {
      const double on_a = a.length() * static_cast<double>(k) / static_cast<double>(samples);
      const auto near = index.nearest(a.at(on_a), farthest * spacing_);
      if (!near) continue;
      const double on_b = b.along(near->segment, near->along);
      if (too_near(a, on_a) || too_near(b, on_b)) continue;
      // at a corner the two sides of one opening may lie far from those of the other
      const double far = step_between(a, on_a, b, on_b);
      if (far > farthest * spacing_) continue;
      least = std::min(least, far);
      found.push_back({on_a, on_b, far});
    }
    const Candidate* best = nullptr;
    double best_score = -1;
    constexpr double as_near = 1.15;
    for (const Candidate& c : found) {
      if (c.far > as_near * least) continue;
      double score = b.length();
      for (const Opening& o : b.openings) score = std::min(score, b.between(c.on_b, o.at));
      if (score > best_score + 1) best_score = score, best = &c;
    }
    if (best == nullptr) return;
    set_[set_of(inner)] = set_of(outer);
    a.openings.push_back({best->on_a, half_of(a), outer, b.openings.size()});
    b.openings.push_back({best->on_b, half_of(b), inner, a.openings.size() - 1});
  }
  /// The longer one of the two steps between rings that are opened there.
  double step_between(const Loop& a, double on_a, const Loop& b, double on_b) const {
    const double half_a = half_of(a), half_b = half_of(b);
    const Point a1 = a.at(on_a - half_a), a2 = a.at(on_a + half_a), b1 = b.at(on_b - half_b), b2 = b.at(on_b + half_b);
    return std::min(std::max(distance(a1, b1), distance(a2, b2)), std::max(distance(a1, b2), distance(a2, b1)));
  }
  double half_of(const Loop& loop) const { return std::min(spacing_ / 2, loop.length() / 8); }
  bool too_near(const Loop& loop, double at) const {
    return std::any_of(loop.openings.begin(), loop.openings.end(),
                       [&](const Opening& o) { return loop.between(at, o.at) < apart * spacing_; });
  }

  /// Goes around a ring, and around those that it is opened to on the way.
  /// @param entered  the opening that it was entered by; as many as there are openings: none
  void follow(std::size_t ring, double from, int way, std::size_t entered, Ring& to, std::vector<bool>& done) {
    done[ring] = true;
    const Loop& loop = loops_[ring];
    std::vector<std::pair<double, std::size_t>> ahead;
    for (std::size_t o = 0; o < loop.openings.size(); ++o)
      if (o != entered) {
        const Opening& opening = loop.openings[o];
        const double edge = opening.at - way * opening.half;
        ahead.emplace_back(loop.around(way > 0 ? edge - from : from - edge), o);
      }
    std::sort(ahead.begin(), ahead.end());
    double here = 0;
    for (const auto& [d, o] : ahead) {
      loop.walk(from + way * here, d - here, way, to);
      const Opening opening = loop.openings[o];
      const Loop& other = loops_[opening.ring];
      const Opening& there = other.openings[opening.opening];
      const Point at = to.back(), up = other.at(there.at + there.half), down = other.at(there.at - there.half);
      if (!done[opening.ring]) {
        if (distance(at, up) <= distance(at, down))
          follow(opening.ring, there.at + there.half, 1, opening.opening, to, done);
        else
          follow(opening.ring, there.at - there.half, -1, opening.opening, to, done);
      }
      here = d + 2 * opening.half;
    }
    const double whole = loop.length() - (entered < loop.openings.size() ? 2 * loop.openings[entered].half : 0);
    if (here < whole) loop.walk(from + way * here, whole - here, way, to);
  }

  double spacing_;
  std::vector<Regions> levels_;
  std::vector<Loop> loops_;  // by level, then by region
  std::vector<std::size_t> set_;
};

}  // namespace

std::vector<Ring> spirals_through(std::vector<Regions> levels, double spacing, Um tolerance) {
  std::vector<Ring> lines = Spiral(std::move(levels), spacing).lines();
  for (Ring& line : lines) line = few_points(line, true, tolerance);
  return lines;
}

void fill_fermat(const Region& region, const SparseStyle& style, Beads& beads) {
  const double spacing = style.band / style.density;
  std::vector<Regions> levels;
  for (Regions rest{region};;) {
    stop_if_asked();
    rest = geometry::offset(rest, {.by = -std::max(1, rounded(levels.empty() ? spacing / 2 : spacing))});
    if (rest.empty()) break;
    levels.push_back(rest);
  }
  const std::vector<Ring> lines = spirals_through(std::move(levels), spacing, tolerance_of(style.density));
  double way = 0;
  for (const Ring& line : lines) way += perimeter_of(line);
  if (way <= 0) return;
  const double wanted = style.density * area_mm2(region) * 1e6 / style.band;
  const Um width = std::max(1, rounded(style.band * std::clamp(wanted / way, least_narrowing, 1 / least_narrowing)));
  for (const Ring& line : lines) {
    if (line.size() < 3) continue;
    Bead& bead = beads.emplace_back();
    bead.role = Role::infill, bead.part = style.part, bead.closed = true;
    for (const Point p : line) bead.path.push_back({p, width, static_cast<float>(style.layers)});
  }
}

}  // namespace weft::infill
