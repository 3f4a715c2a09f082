// SPDX-License-Identifier: GPL-3.0-or-later
#include "slice/nearest_run.h"

#include "geometry/boolean.h"
#include "geometry/medial_axis.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

namespace weft::slice {
namespace {

using geometry::MedialAxis;
using geometry::Place;

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

/// The place of a site that is nearest to p.
Place foot(const MedialAxis::Site& site, Place p) {
  if (site.corner) return site.a;
  const double dx = site.b.x - site.a.x, dy = site.b.y - site.a.y, square = dx * dx + dy * dy;
  const double t = square > 0 ? ((p.x - site.a.x) * dx + (p.y - site.a.y) * dy) / square : 0;
  const double within = std::clamp(t, 0.0, 1.0);
  return {site.a.x + within * dx, site.a.y + within * dy};
}

/// Walks along the strips of an axis, and puts what lies between it and the outline together, as long as its kind is
/// the same.
class Cells {
 public:
  Cells(const MedialAxis& axis, std::vector<int> kind_of_site, std::size_t count)
      : axis_(axis), kind_(std::move(kind_of_site)), rings_(count) {}

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
  int kind(std::uint32_t h) const { return kind_[axis_.half_edges[h].site]; }
  Point rounded_at(Place p) const { return {axis_.origin.x + rounded(p.x), axis_.origin.y + rounded(p.y)}; }
  Place begin_of(std::uint32_t h) const { return axis_.nodes[axis_.half_edges[h].from].at; }

  void walk(std::uint32_t first) {
    const int kind_here = kind(first);
    Ring feet, axis;
    for (auto h = first; !seen_[h] && kind(h) == kind_here; h = axis_.half_edges[h].next) {
      seen_[h] = true;
      const Place from = begin_of(h), to = begin_of(MedialAxis::twin(h));
      const auto& site = axis_.sites[axis_.half_edges[h].site];
      for (const Place p : {from, to}) feet.push_back(rounded_at(foot(site, p))), axis.push_back(rounded_at(p));
    }
    if (feet.empty()) return;
    feet.insert(feet.end(), axis.rbegin(), axis.rend());
    rings_[static_cast<std::size_t>(kind_here)].push_back(std::move(feet));
  }

  const MedialAxis& axis_;
  std::vector<int> kind_;
  std::vector<std::vector<Ring>> rings_;
  std::vector<bool> seen_;
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

std::vector<Regions> nearest_to(const Region& region, int count, std::span<const Point> borders,
                                const std::function<int(Point)>& kind_at) {
  std::vector<Regions> out(static_cast<std::size_t>(count));
  Region with_borders{divided(region.outer, borders), {}};
  for (const Ring& hole : region.holes) with_borders.holes.push_back(divided(hole, borders));
  if (const auto kind = kind_of_all(with_borders, kind_at)) {
    out[static_cast<std::size_t>(*kind)] = {region};
    return out;
  }
  const auto axis = geometry::medial_axis(with_borders);
  if (!axis.valid) return {};
  std::vector<int> kinds;
  for (const auto& site : axis.sites) {
    const Place middle{(site.a.x + site.b.x) / 2, (site.a.y + site.b.y) / 2};
    kinds.push_back(kind_at({axis.origin.x + rounded(middle.x), axis.origin.y + rounded(middle.y)}));
  }
  auto rings = Cells(axis, std::move(kinds), out.size()).rings();
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = geometry::regions_from_rings(rings[k]);
  return out;
}

}  // namespace weft::slice
