// SPDX-License-Identifier: GPL-3.0-or-later
#include "slice/nearest_run.h"

#include "core/tolerances.h"
#include "geometry/axis_curve.h"
#include "geometry/boolean.h"
#include "geometry/medial_axis.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

namespace weft::slice {
namespace {

using geometry::MedialAxis;
using geometry::Place;

/// Curved axis is led along by pieces that stand off it by no more, for they are borders of what is printed.
constexpr double chord_um = 5;
constexpr double anywhere = std::numeric_limits<double>::infinity();  // what is nearest is asked for at any distance

/// A border that is nearer to an edge than this lies on it; one nearer to its ends is one of them.
constexpr double on_edge_um = 40, at_end_um = 4;

/// The ring with a corner where a border lies on one of its edges.
Ring divided(const Ring& ring, std::span<const Point> borders) {
  Ring out;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i], b = ring[(i + 1) % ring.size()];
    out.push_back(a);
    const double length = distance(a, b), ux = (b.x - a.x) / length, uy = (b.y - a.y) / length;
    std::vector<double> at;
    for (const Point p : borders) {
      const double along = (p.x - a.x) * ux + (p.y - a.y) * uy, aside = (p.y - a.y) * ux - (p.x - a.x) * uy;
      if (std::abs(aside) < on_edge_um && along > at_end_um && along < length - at_end_um) at.push_back(along);
    }
    std::sort(at.begin(), at.end());
    for (const double along : at) {
      const Point p{a.x + rounded(along * ux), a.y + rounded(along * uy)};
      if (distance(out.back(), p) > at_end_um) out.push_back(p);
    }
  }
  return out;
}

/// Walks along the strips of an axis, and puts what lies between outline and axis together, as long as its kind is the
/// same, and no deeper than asked for.
class Cells {
 public:
  Cells(const MedialAxis& axis, std::vector<int> kind_of_site, std::size_t count, double depth)
      : axis_(axis), kind_(std::move(kind_of_site)), rings_(count), depth_(depth) {}

  std::vector<std::vector<Ring>> rings() && {
    const auto count = axis_.half_edges.size();
    std::vector<std::uint32_t> before(count);
    for (std::uint32_t h = 0; h < count; ++h) before[axis_.half_edges[h].next] = h;
    seen_.assign(count, false);
    for (std::uint32_t h = 0; h < count; ++h)  // runs that begin somewhere, then those that go all round
      if (kind(h) != kind(before[h])) walk(h);
    for (std::uint32_t h = 0; h < count; ++h) walk(h);
    return std::move(rings_);
  }

 private:
  using Node = MedialAxis::Node;
  int kind(std::uint32_t h) const { return kind_[axis_.half_edges[h].site]; }

  void walk(std::uint32_t first) {
    if (seen_[first]) return;
    feet_.clear(), inner_.clear();
    below_ = nullptr;
    const int kind_here = kind(first);
    auto last = first;
    for (auto h = first; !seen_[h] && kind(h) == kind_here; h = axis_.half_edges[h].next) {
      seen_[h] = true;
      // Both sides of an edge round the same nodes, so that what is beside each other shares its border.
      const std::uint32_t even = h & ~1U;
      nodes_.assign(1, axis_.nodes[axis_.half_edges[even].from]);
      geometry::add_nodes_between(axis_, even, chord_um, anywhere, nodes_);
      nodes_.push_back(axis_.nodes[axis_.half_edges[even + 1].from]);
      if (h != even) std::reverse(nodes_.begin(), nodes_.end());
      const auto& site = axis_.sites[axis_.half_edges[h].site];
      for (std::size_t i = 0; i + 1 < nodes_.size(); ++i) strip(nodes_[i], nodes_[i + 1], site);
      // Along the outline its own corners and the ends of the run: more would not lie on it, once rounded.
      if (h == first || axis_.half_edges[last].site != axis_.half_edges[h].site)
        put(geometry::foot_on(site, nodes_.front().at), feet_);
      last = h;
      if (const auto next = axis_.half_edges[h].next;
          seen_[next] || axis_.half_edges[next].site != axis_.half_edges[h].site || kind(next) != kind_here)
        put(geometry::foot_on(site, nodes_.back().at), feet_);
    }
    feet_.insert(feet_.end(), inner_.rbegin(), inner_.rend());
    rings_[static_cast<std::size_t>(kind_here)].push_back(feet_);
  }

  /// What lies between a straight piece of the axis and its site.
  void strip(const Node& from, const Node& to, const MedialAxis::Site& site) {
    const bool deep = from.clearance > depth_, deep_at_end = to.clearance > depth_;
    if (!deep) put(from.at, inner_), below_ = nullptr;
    if (!deep && !deep_at_end) return put(to.at, inner_);
    const Place across = deep == deep_at_end ? from.at : deep ? at_depth(to, from) : at_depth(from, to);
    along_depth(deep ? from.at : across, deep_at_end ? to.at : across, site);
    if (!deep_at_end) put(to.at, inner_), below_ = nullptr;
  }

  Place at_depth(const Node& above, const Node& below) const {
    return geometry::lerp(above.at, below.at, (depth_ - above.clearance) / (below.clearance - above.clearance));
  }

  /// At the depth below the site, where the ways from it to two places lead.
  void along_depth(Place from, Place to, const MedialAxis::Site& site) {
    const Place foot = geometry::foot_on(site, from), foot_of_to = geometry::foot_on(site, to);
    const auto below = [this](Place p, Place towards) {
      return geometry::lerp(p, towards, depth_ / geometry::distance(p, towards));
    };
    if (below_ != &site) {
      put(below(foot, from), inner_);
      begun_ = inner_.size();
    } else if (!site.corner && inner_.size() > begun_) {
      inner_.pop_back();  // straight on
    }
    if (site.corner) {
      const double ax = from.x - foot.x, ay = from.y - foot.y, bx = to.x - foot.x, by = to.y - foot.y;
      const double angle = std::atan2(ax * by - ay * bx, ax * bx + ay * by);
      const double sag = std::min<double>(tolerances::arc, depth_);
      const int chords = std::max(1, static_cast<int>(std::ceil(std::abs(angle) / (2 * std::acos(1 - sag / depth_)))));
      for (int i = 1; i < chords; ++i) {
        const double c = std::cos(angle * i / chords), s = std::sin(angle * i / chords);
        put(below(foot, {foot.x + c * ax - s * ay, foot.y + s * ax + c * ay}), inner_);
      }
    }
    put(below(foot_of_to, to), inner_);
    below_ = &site;
  }

  void put(Place p, Ring& ring) const {
    const Point at{axis_.origin.x + rounded(p.x), axis_.origin.y + rounded(p.y)};
    if (!ring.empty() && ring.back() == at) return;
    if (ring.size() > 1 && ring[ring.size() - 2] == at)
      ring.pop_back();  // there and back again: one kind on both sides
    else
      ring.push_back(at);
  }

  const MedialAxis& axis_;
  std::vector<int> kind_;
  std::vector<std::vector<Ring>> rings_;
  double depth_;
  std::vector<bool> seen_;
  Ring feet_, inner_;                        // of the walk under way
  const MedialAxis::Site* below_ = nullptr;  // inner_ ends at the depth below it
  std::size_t begun_ = 0;                    // and had so many points when it came there
  std::vector<Node> nodes_;
};

/// The kind that all of an outline is of; nothing where it has several.
std::optional<int> kind_of_all(const Region& region, const std::function<int(Point)>& kind_at) {
  std::optional<int> out;
  const auto other = [&](Point p) {
    const int kind = kind_at(p);
    return std::exchange(out, kind).value_or(kind) != kind;
  };
  const auto differs = [&](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point a = ring[i], b = ring[(i + 1) % ring.size()];
      if (other(a) || other({(a.x + b.x) / 2, (a.y + b.y) / 2})) return true;
    }
    return false;
  };
  if (differs(region.outer) || std::any_of(region.holes.begin(), region.holes.end(), differs)) return std::nullopt;
  return out;
}

}  // namespace

std::vector<Regions> nearest_to(const Region& region, int count, std::span<const Point> borders, Um depth,
                                const std::function<int(Point)>& kind_at) {
  std::vector<Regions> out(static_cast<std::size_t>(count));
  Region with_borders{divided(region.outer, borders), {}};
  for (const Ring& hole : region.holes) with_borders.holes.push_back(divided(hole, borders));
  const auto kind = kind_of_all(with_borders, kind_at);
  if (kind && *kind == count - 1) return out;
  const auto axis = geometry::medial_axis(with_borders);
  if (!axis.valid) return {};
  const bool shallow = std::all_of(axis.nodes.begin(), axis.nodes.end(),
                                   [&](const MedialAxis::Node& node) { return node.clearance <= depth; });
  if (kind && shallow) {
    out[static_cast<std::size_t>(*kind)] = {region};
    return out;
  }
  std::vector<int> kinds;
  for (const auto& site : axis.sites) {
    const Place middle{(site.a.x + site.b.x) / 2, (site.a.y + site.b.y) / 2};
    kinds.push_back(kind_at({axis.origin.x + rounded(middle.x), axis.origin.y + rounded(middle.y)}));
  }
  auto rings = Cells(axis, std::move(kinds), out.size(), depth).rings();
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = geometry::regions_from_rings(rings[k]);
  return out;
}

}  // namespace weft::slice
