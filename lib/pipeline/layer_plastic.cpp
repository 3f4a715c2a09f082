// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/layer_plastic.h"

#include "geometry/along_path.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace weft::pipeline {

geometry::SegmentIndex segments_of(const Beads& beads) {
  std::vector<geometry::Segment> segments;
  for (const Bead& bead : beads) {
    const auto& path = bead.path;
    for (std::size_t i = 1; i < path.size(); ++i) segments.push_back({path[i - 1].at, path[i].at});
    if (bead.closed) segments.push_back({path.back().at, path.front().at});
  }
  return geometry::SegmentIndex(std::move(segments));
}

LayerPlastic::LayerPlastic(const Regions& areas, const Beads& beads, Um line)
    : areas_(areas), beads_(segments_of(beads)), line_(line) {}

bool LayerPlastic::lies(Point p) const {
  return beads_.nearest(p, on_bead()) || areas_.nearest(p, on_area()) || areas_.region_at(p);
}

std::vector<char> LayerPlastic::lying(std::span<const Point> places) const {
  std::vector<char> out = geometry::lie_near(places, beads_, on_bead());
  std::vector<std::size_t> which;
  std::vector<Point> others;
  const auto or_if = [&](auto&& tell) {
    which.clear(), others.clear();
    for (std::size_t i = 0; i < places.size(); ++i)
      if (out[i] == 0) which.push_back(i), others.push_back(places[i]);
    const std::vector<char> told = tell();
    for (std::size_t k = 0; k < told.size(); ++k) out[which[k]] = told[k];
  };
  if (areas_.segments().empty()) return out;
  or_if([&] { return geometry::lie_within(others, areas_); });
  or_if([&] { return geometry::lie_near(others, areas_, on_area()); });
  return out;
}

std::vector<char> LayerPlastic::leaning(std::span<const Point> places) const {
  std::vector<char> out = geometry::lie_near(places, beads_, line_ * 11 / 10);
  const std::vector<char> lies = lying(places);
  for (std::size_t i = 0; i < out.size(); ++i)
    if (lies[i] != 0) out[i] = 0;
  return out;
}

/// Walked in steps, each of which lies or does not.
std::vector<Polyline> LayerPlastic::hanging(const Bead& bead, Um span) const {
  constexpr double step = 300;
  const auto& path = bead.path;
  std::vector<Polyline> out;
  Polyline since;  // the last rest
  bool rested = false, begins_in_air = false;
  const auto add = [&](Point a, Point b, bool is_held) {
    if (!is_held) {
      if (since.empty()) since.push_back(a);
      since.push_back(b);
      return;
    }
    const bool first = !std::exchange(rested, true);
    if (since.empty()) return;
    begins_in_air |= first;
    if (first || length_of(since) > span) out.push_back(std::move(since));
    since.clear();
  };
  Polyline steps{path.front().at};
  for (std::size_t i = 0, n = path.size(); i + (bead.closed ? 0 : 1) < n; ++i) {
    const Point a = path[i].at, b = path[i + 1 < n ? i + 1 : 0].at;
    const int pieces = std::max(1, static_cast<int>(distance(a, b) / step));
    for (int k = 0; k < pieces; ++k) steps.push_back(lerp(a, b, (k + 1.0) / pieces));
  }
  std::vector<Point> middles;
  for (std::size_t i = 1; i < steps.size(); ++i) middles.push_back(lerp(steps[i - 1], steps[i], 0.5));
  const std::vector<char> held = lying(middles);
  for (std::size_t i = 0; i < held.size(); ++i) add(steps[i], steps[i + 1], held[i] != 0);
  if (bead.closed && begins_in_air) {  // it goes on over the begin
    if (!since.empty()) out.front().insert(out.front().begin(), since.begin(), since.end() - 1);
    if (length_of(out.front()) <= span) out.erase(out.begin());
  } else if (!since.empty() && (!bead.closed || !rested || length_of(since) > span)) {
    out.push_back(std::move(since));
  }
  return out;
}

Hanging LayerPlastic::hanging(std::span<const Bead> beads, Um span, Um least) const {
  Hanging out;
  for (const Bead& bead : beads)
    for (const Polyline& piece : hanging(bead, span)) {
      const double length = length_of(piece), apart = length / std::ceil(length / (span * 0.8));
      out.um += length;
      if (const Box box = box_of(bead); bead.closed && std::max(box.size().x, box.size().y) < span / 2) {
        out.at.push_back(box.centre());
        continue;
      }
      if (length < least) continue;
      double next = apart / 2, along = 0;
      for (std::size_t i = 1; i < piece.size(); ++i) {
        along += distance(piece[i - 1], piece[i]);
        if (along < next) continue;
        out.at.push_back(piece[i]);
        next += apart;
      }
    }
  return out;
}

}  // namespace weft::pipeline
