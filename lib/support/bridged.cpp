// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/bridged.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/clip_lines.h"
#include "geometry/spatial_index.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::support {
namespace {

using namespace weft::literals;

constexpr int directions = 12;
constexpr Um rest = 0.1_mm;            // a strand must find the layer below so far beyond its end
constexpr int most_strands = 400;      // of one direction
constexpr double least_resting = 0.5;  // of the strands' length: with less it is a ledge, and its strands hang

struct Hung {
  double resting_um = 0, all_um = 0;
  std::vector<Polyline> strands;
};

struct Direction {
  double x = 1, y = 0;
  Point along(Point from, double by) const { return {from.x + rounded(x * by), from.y + rounded(y * by)}; }
};

/// The strands of one direction that rest on both ends.
Hung hung(const Regions& gap, const geometry::SegmentIndex& below, Direction d, Um longest, Um strand) {
  const Box box = box_of(gap);
  const Point centre = box.centre();
  const double reach = std::hypot(box.size().x, box.size().y) / 2 + strand;
  const double step = std::max<double>(strand, 2 * reach / most_strands);
  std::vector<Polyline> lines;
  const Direction across{-d.y, d.x};
  for (double a = -reach + step / 2; a < reach; a += step) {
    const Point middle = across.along(centre, a);
    lines.push_back({d.along(middle, -reach), d.along(middle, reach)});
  }
  Hung out;
  for (auto& piece : geometry::clip_lines(lines, gap)) {
    const double length = length_of(piece.line);
    out.all_um += length;
    if (length > longest) continue;
    if (!below.region_at(d.along(piece.line.front(), -rest)) || !below.region_at(d.along(piece.line.back(), rest)))
      continue;
    out.resting_um += length;
    out.strands.push_back(std::move(piece.line));
  }
  return out;
}

}  // namespace

Regions bridged(const Region& gap, const Regions& below, Um longest, Um strand) {
  if (longest <= 0 || below.empty()) return {};
  const Regions one{gap};
  const geometry::SegmentIndex index(below);
  Hung best;
  Direction chosen;
  for (int i = 0; i < directions; ++i) {
    stop_if_asked();
    const double angle = i * std::numbers::pi / directions;
    const Direction d{std::cos(angle), std::sin(angle)};
    auto one_way = hung(one, index, d, longest, strand);
    if (one_way.resting_um <= best.resting_um * 1.001) continue;  // the first of equals
    best = std::move(one_way), chosen = d;
  }
  if (best.strands.empty() || best.resting_um < least_resting * best.all_um) return {};
  const double half = 0.55 * strand;  // neighbours meet
  const Direction across{-chosen.y, chosen.x};
  std::vector<Ring> bands;
  for (const auto& line : best.strands) {
    const Point a = chosen.along(line.front(), -strand), b = chosen.along(line.back(), strand);
    bands.push_back({across.along(a, -half), across.along(b, -half), across.along(b, half), across.along(a, half)});
  }
  return geometry::intersect(one, geometry::regions_from_rings(bands));
}

}  // namespace weft::support
