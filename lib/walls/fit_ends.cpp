// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/fit_ends.h"

#include "core/stop.h"
#include "geometry/spatial_index.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

namespace weft::walls {
namespace {

using Vertex = Line::Vertex;

constexpr double step_um = 20;
constexpr double under_share = 0.9;  // of half a wall's width: closer to its middle an end lies under it
constexpr double beyond_um = 10;     // so much more is cut: ends that only come out of a wall lie under it beside that
constexpr double most_widths = 2;    // no more than so many widths of the wall are cut; else it lies there on purpose
constexpr double most_gap = 0.8;     // of the bead's width: a wider gap before a wall is not an end's
constexpr double beside = 0.3;       // of the bead's width: where beside its middle an end is looked at, too
constexpr double most_deep = 0.15;   // of the bead's width: so far the middle goes under, for what is bare beside it
constexpr double touch_um = 2;

/// How deep a place lies under a wall: half the wall's width there less the distance.
struct Depth {
  double depth = 0, width = 0;
};

/// The walls' segments near one end of a line, found once for all looks at it.
class Walls {
 public:
  /// @param middles whose ends will be asked for
  Walls(const std::vector<Line>& lines, const std::vector<Line>& middles) : lines_(lines) {
    for (const Line& line : lines)
      for (const Vertex& v : line.path) widest_ = std::max(widest_, v.width);
    double reach_um = reach_under();
    std::vector<geometry::Segment> ends;
    for (const Line& line : middles) {
      if (line.closed || line.path.size() < 2) continue;
      for (const Vertex& end : {line.path.front(), line.path.back()}) {
        ends.push_back({lattice(end.at), lattice(end.at)});
        reach_um = std::max(reach_um, reach_before(end));
      }
    }
    // Most walls are nowhere near an end: they are passed over a run of segments at a time.
    const geometry::SegmentIndex around(std::move(ends));
    const Um reach = rounded(reach_um) + rounding;
    constexpr std::size_t run = 8;
    std::vector<geometry::Segment> segments;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const auto& path = lines[i].path;
      for (std::size_t from = 0, to = 0; from < path.size(); from = to) {
        to = std::min(path.size(), from + run);
        Box box;
        for (std::size_t k = from; k <= to; ++k) box.add(lattice(path[k % path.size()].at));
        around.near(box.grown(reach), near_);
        if (near_.empty()) continue;
        for (std::size_t k = from; k < to; ++k) {
          segments.push_back({lattice(path[k].at), lattice(path[(k + 1) % path.size()].at)});
          origins_.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(k)});
        }
      }
    }
    index_ = geometry::SegmentIndex(std::move(segments));
  }

  /// How long the end of a path lies under a wall of the inset.
  double length_under(const std::vector<Vertex>& path, int inset) {
    look_near(path.back().at, under_share * widest_ / 2, inset);
    if (depth_under(near_, path.back().at).depth <= 0) return 0;  // most ends: no wall is so near
    look_near(path.back().at, reach_under(), inset);
    double longest = 0;
    for (std::size_t from = 0, to = 0; from < near_.size(); from = to) {
      const std::uint32_t line = origins_[near_[from]].line;
      while (to < near_.size() && origins_[near_[to]].line == line) ++to;
      longest = std::max(longest, length_under(path, std::span(near_).subspan(from, to - from)));
    }
    return longest;
  }

  /// How far it is from the end of a path straight on to a wall (of the inset), over the width of the bead on average;
  /// 0 if there is none.
  double gap_before(const std::vector<Vertex>& path, std::optional<int> inset = {}) {
    const Vertex& end = path.back();
    std::size_t back = path.size() - 1;
    while (back > 0 && distance(path[back].at, end.at) < end.width / 2) --back;
    const Place way = unit(path[back].at, end.at), n{-way.y, way.x};
    const double most = most_gap * end.width;
    look_near(end.at, reach_before(end), inset);
    if (near_.empty()) return 0;
    const auto gap = [&](double aside) {
      const Place from{end.at.x + aside * n.x, end.at.y + aside * n.y};
      double x = 0;
      while (x < most) {  // as far as the nearest wall is, there is none
        const double free = -depth_under(near_, {from.x + x * way.x, from.y + x * way.y}, 1).depth;
        if (free < touch_um) return x;
        x += free;
      }
      return most;
    };
    const double middle = gap(0);
    if (middle >= most) return 0;
    const double mean = (middle + gap(-beside * end.width) + gap(beside * end.width)) / 3;
    return std::min(mean, middle + most_deep * end.width);
  }

 private:
  struct Origin {
    std::uint32_t line, segment;
  };
  static constexpr Um rounding = 2;  // of both places, to the lattice
  static Point lattice(Place p) { return {rounded(p.x), rounded(p.y)}; }

  /// How far from an end walls matter that it lies under, or that it may be led on to.
  double reach_under() const { return (most_widths + 0.5) * widest_ + step_um; }
  double reach_before(const Vertex& end) const { return (most_gap + beside) * end.width + widest_ / 2; }

  /// Finds the segments of all walls, or of those of an inset.
  void look_near(Place p, double reach_um, std::optional<int> inset) {
    const Point at = lattice(p);
    const Um reach = rounded(reach_um) + rounding;
    index_.near({{at.x - reach, at.y - reach}, {at.x + reach, at.y + reach}}, near_);
    if (inset) std::erase_if(near_, [&](std::uint32_t s) { return lines_[origins_[s].line].inset != *inset; });
  }

  /// Negative when beside it.
  Depth depth_under(std::span<const std::uint32_t> wall, Place p, double share = under_share) const {
    Depth best{-1e9, 0};
    for (const std::uint32_t s : wall) {
      const auto& path = lines_[origins_[s].line].path;
      const Vertex &a = path[origins_[s].segment], &b = path[(origins_[s].segment + 1) % path.size()];
      const double dx = b.at.x - a.at.x, dy = b.at.y - a.at.y, l2 = dx * dx + dy * dy;
      const double t = l2 > 0 ? std::clamp(((p.x - a.at.x) * dx + (p.y - a.at.y) * dy) / l2, 0.0, 1.0) : 0;
      const double width = a.width + t * (b.width - a.width);
      const double depth = share * width / 2 - distance(lerp(a.at, b.at, t), p);
      if (depth > best.depth) best = {depth, width};
    }
    return best;
  }

  double length_under(const std::vector<Vertex>& path, std::span<const std::uint32_t> wall) const {
    const Depth end = depth_under(wall, path.back().at);
    if (end.depth <= 0) return 0;
    double done = 0, deep = end.depth;
    for (std::size_t i = path.size() - 1; i > 0; --i) {
      const double length = distance(path[i].at, path[i - 1].at);
      const int pieces = std::max(1, static_cast<int>(std::ceil(length / step_um)));
      for (int k = 1; k <= pieces; ++k) {
        const double depth = depth_under(wall, lerp(path[i].at, path[i - 1].at, static_cast<double>(k) / pieces)).depth;
        const double share = depth <= 0 ? deep / (deep - depth) : 1, at = done + length * (k - 1 + share) / pieces;
        if (at > most_widths * end.width) return 0;
        if (depth <= 0) return at + beyond_um;
        deep = depth;
      }
      done += length;
    }
    return 0;
  }

  const std::vector<Line>& lines_;
  std::vector<Origin> origins_;  ///< of the index's segments
  geometry::SegmentIndex index_;
  std::vector<std::uint32_t> near_;
  double widest_ = 0;
};

void lead_on(std::vector<Vertex>& path, double by) {
  const Vertex end = path.back();
  const Place way = unit(path[path.size() - 2].at, end.at);
  path.push_back({{end.at.x + by * way.x, end.at.y + by * way.y}, end.width});
}

}  // namespace

void fit_ends(std::vector<Line>& middles, const std::vector<Line>& pairs) {
  const bool ends = std::any_of(middles.begin(), middles.end(), [](const Line& line) { return !line.closed; });
  if (!ends || pairs.empty()) return;
  Walls walls(pairs, middles);
  for (Line& line : middles) {
    stop_if_asked();
    if (line.closed || line.path.size() < 2) continue;
    for (int end = 0; end < 2; ++end) {
      const double by = walls.length_under(line.path, line.inset);
      if (by > 0) {
        cut_end(line.path, by);
      } else if (end == 0 ? line.last_meets : line.first_meets) {
        // the wall that turns back there, rather than one beside it
        double gap = walls.gap_before(line.path, line.inset);
        if (gap <= 0) gap = walls.gap_before(line.path);
        if (gap > touch_um) lead_on(line.path, gap);
      }
      std::reverse(line.path.begin(), line.path.end());
    }
  }
}

}  // namespace weft::walls
