// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/streamlines.h"

#include "core/stop.h"
#include "geometry/spatial_index.h"
#include "infill/few_points.h"
#include "infill/gap_widths.h"
#include "infill/prepared.h"
#include "infill/web.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <optional>
#include <unordered_map>

namespace weft::infill {
namespace {

constexpr double steps_apart = 4;    // steps of integration in the distance of lines
constexpr double nearest_end = 0.7;  // distances of lines: a line ends where another is as near
constexpr double nearest_seed = 0.95;
constexpr double narrowest = 0.6, widest = 1.6;  // of a line, by its gap

/// Places of lines in cells as wide as lines are apart.
class Samples {
 public:
  struct Sample {
    Place at;
    std::uint32_t line = 0, number = 0;
  };
  explicit Samples(double apart) : apart_(apart) {}
  void add(const Sample& sample) { cells_[key(cell(sample.at.x), cell(sample.at.y))].push_back(sample); }
  /// Calls see(sample) with all that may be within so many cells.
  template <class See>
  void near(Place p, int cells, const See& see) const {
    for (int j = -cells; j <= cells; ++j)
      for (int i = -cells; i <= cells; ++i) {
        const auto found = cells_.find(key(cell(p.x) + i, cell(p.y) + j));
        if (found != cells_.end())
          for (const Sample& s : found->second) see(s);
      }
  }

 private:
  int cell(double v) const { return static_cast<int>(std::floor(v / apart_)); }
  static std::uint64_t key(int x, int y) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32U | static_cast<std::uint32_t>(y);
  }
  double apart_;
  std::unordered_map<std::uint64_t, std::vector<Sample>> cells_;  // looked into, never walked through
};

class Flow {
 public:
  Flow(const Region& region, const SparseStyle& style)
      : style_(style),
        inside_(Regions{region}),
        apart_(style.band / style.density),
        step_(apart_ / steps_apart),
        samples_(apart_) {}

  std::vector<Web::Curve> lines(const Box& box) {
    seed_from(box);
    std::vector<Web::Curve> out;
    for (const std::vector<Place>& line : lines_) {
      Polyline points;
      for (const Place p : line) points.push_back({rounded(p.x), rounded(p.y)});
      out.push_back({few_points(points, false, curve_tolerance), false});
    }
    return out;
  }

  /// Mean distance to the neighbours on both sides, in what lines are to be apart.
  double gap(Place p) const {
    const auto angle = angle_at(p);
    if (!angle) return 1;
    const Place along{std::cos(*angle), std::sin(*angle)};
    double left = 2 * apart_, right = 2 * apart_;
    samples_.near(p, 2, [&](const Samples::Sample& s) {
      const Place d = s.at - p;
      const double across = along.x * d.y - along.y * d.x;
      if (std::abs(along.x * d.x + along.y * d.y) > 0.5 * apart_ || std::abs(across) < 0.3 * apart_) return;
      (across > 0 ? left : right) = std::min(across > 0 ? left : right, std::abs(across));
    });
    // beside a wall a line covers half of what is between
    const auto alone = [&](double& side, double other) {
      if (side >= 2 * apart_) side = std::min(other, apart_);
    };
    alone(left, right), alone(right, left);
    return std::clamp((left + right) / 2 / apart_, narrowest, widest);
  }

 private:
  std::optional<double> angle_at(Place p) const {
    const Direction* field =
        style_.prepared != nullptr && style_.prepared->direction ? &*style_.prepared->direction : nullptr;
    const double turn = style_.turned && style_.turn % 2 == 1 ? std::numbers::pi / 2 : 0;
    if (field == nullptr) return style_.angle_rad + turn;
    const auto angle = field->at(p.x, p.y, style_.z);
    if (!angle) return std::nullopt;
    return *angle + (style_.turned ? turn : style_.angle_rad);
  }
  bool is_inside(Place p) const { return inside_.region_at({rounded(p.x), rounded(p.y)}).has_value(); }

  /// The unit vector along the field that looks forward.
  std::optional<Place> along(Place p, Place forward) const {
    const auto angle = angle_at(p);
    if (!angle) return std::nullopt;
    const Place d{std::cos(*angle), std::sin(*angle)};
    return d.x * forward.x + d.y * forward.y < 0 ? -1.0 * d : d;
  }
  std::optional<Place> next(Place p, Place& forward) const {
    const auto a = along(p, forward);
    const auto b = a ? along(p + 0.5 * step_ * *a, *a) : a;
    const auto c = b ? along(p + 0.5 * step_ * *b, *b) : b;
    const auto d = c ? along(p + step_ * *c, *c) : c;
    if (!d) return std::nullopt;
    const Place sum = *a + 2.0 * *b + 2.0 * *c + *d;
    if (norm(sum) < 3) return std::nullopt;  // it turns within a step
    forward = 1 / norm(sum) * sum;
    return p + step_ * forward;
  }

  bool is_free(Place p, double distance) const {
    bool free = true;
    samples_.near(p, 1, [&](const Samples::Sample& s) { free = free && norm(s.at - p) >= distance; });
    return free;
  }

  /// Walks from a seed one way, until just outside of the region, or to another line, or to itself.
  std::vector<Place> walk(Place from, Place forward, const std::vector<Place>& before) const {
    constexpr std::size_t most_steps = 100'000;
    std::vector<Place> out;
    Place p = from;
    StopNowAndThen stop(64);
    while (out.size() < most_steps) {
      stop.step();
      const auto q = next(p, forward);
      if (!q) break;
      if (!is_free(*q, nearest_end * apart_) || comes_back(*q, out, before)) break;
      out.push_back(*q);
      if (!is_inside(*q)) break;
      p = *q;
    }
    return out;
  }
  /// Whether it comes near what of itself is far along it.
  bool comes_back(Place p, const std::vector<Place>& own, const std::vector<Place>& before) const {
    constexpr std::size_t beside = 3 * static_cast<std::size_t>(steps_apart);
    const double least = nearest_end * apart_;
    for (std::size_t i = 0; i + beside < own.size(); ++i)
      if (norm(own[i] - p) < least) return true;
    for (std::size_t i = own.size() >= beside ? 0 : beside - own.size(); i < before.size(); ++i)
      if (norm(before[i] - p) < least) return true;
    return false;
  }

  void try_seed(Place seed, std::deque<std::uint32_t>& queue) {
    if (!is_inside(seed) || !is_free(seed, nearest_seed * apart_)) return;
    const auto angle = angle_at(seed);
    if (!angle) return;
    const Place forward{std::cos(*angle), std::sin(*angle)};
    const std::vector<Place> ahead = walk(seed, forward, {}), behind = walk(seed, -1.0 * forward, ahead);
    std::vector<Place> line(behind.rbegin(), behind.rend());
    line.push_back(seed);
    line.insert(line.end(), ahead.begin(), ahead.end());
    if (static_cast<double>(line.size()) * step_ < apart_) return;
    const auto number = static_cast<std::uint32_t>(lines_.size());
    for (std::uint32_t i = 0; i < line.size(); ++i) samples_.add({line[i], number, i});
    lines_.push_back(std::move(line));
    queue.push_back(number);
  }

  /// From beside each line that there is; then from the places of a lattice, for what no line led to.
  void seed_from(const Box& box) {
    std::deque<std::uint32_t> queue;
    const auto grow = [&] {
      while (!queue.empty()) {
        stop_if_asked();
        const std::vector<Place> line = lines_[queue.front()];
        queue.pop_front();
        for (std::size_t i = 1; i < line.size(); i += 2) {
          const Place d = line[i] - line[i - 1];
          const double l = std::max(norm(d), 1e-9);
          for (const double side : {1.0, -1.0}) try_seed(line[i] + side * apart_ / l * Place{-d.y, d.x}, queue);
        }
      }
    };
    // on multiples of the distance from where patterns are anchored, so that layers and parts agree
    const auto first = [&](Um low, Um anchor) { return anchor + apart_ * std::ceil((low - anchor) / apart_); };
    for (double y = first(box.min.y, style_.origin.y); y <= box.max.y; y += apart_)
      for (double x = first(box.min.x, style_.origin.x); x <= box.max.x; x += apart_) {
        try_seed({x, y}, queue);
        grow();
      }
  }

  const SparseStyle& style_;
  geometry::SegmentIndex inside_;
  double apart_, step_;
  Samples samples_;
  std::vector<std::vector<Place>> lines_;
};

}  // namespace

void fill_streamlines(const Region& region, const SparseStyle& style, Beads& beads) {
  Flow flow(region, style);
  const double apart = style.band / style.density;
  const std::vector<Web::Curve> lines = flow.lines(box_of(region.outer));
  Web web(region, style);
  web.add_curves(region, lines);
  const std::size_t from = beads.size();
  constexpr double longest_joint = 1.5;  // distances of lines
  web.emit(style.anchor_max >= 0 ? style.anchor_max : longest_joint * apart, style.band,
           style.density * area_mm2(region) * 1e6 / style.band, beads);
  if (style.prepared != nullptr && style.prepared->direction)
    follow_gaps(
        [&](Point p) {
          return flow.gap({static_cast<double>(p.x), static_cast<double>(p.y)});
        },
        apart, from, beads);
}

}  // namespace weft::infill
