// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stop.h"
#include "core/tolerances.h"
#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "geometry/simplify.h"
#include "geometry/spatial_index.h"
#include "model/simplify.h"
#include "slice/slice.h"
#include "slice/stitch.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <span>
#include <tuple>

namespace weft::slice {
namespace {

/// How many planes lie below a height, by a table with a step finer than the planes are apart.
class PlanesBelow {
 public:
  explicit PlanesBelow(const std::vector<Plane>& planes) : planes_(planes) {
    if (planes.empty()) return;
    Um closest = max_coord;
    for (std::size_t i = 1; i < planes.size(); ++i) closest = std::min(closest, planes[i].below - planes[i - 1].below);
    while ((2 << shift_) <= closest && shift_ < 20) ++shift_;
    const Um top = planes.back().below;
    for (std::uint32_t i = 0; (static_cast<Um>(table_.size()) << shift_) <= top;) {
      while (planes[i].below < static_cast<Um>(table_.size()) << shift_) ++i;
      table_.push_back(i);
    }
  }

  std::uint32_t operator()(Um z) const {
    if (z <= 0) return 0;
    const auto step = static_cast<std::size_t>(z >> shift_);
    if (step >= table_.size()) return static_cast<std::uint32_t>(planes_.size());
    std::uint32_t i = table_[step];
    while (i < planes_.size() && planes_[i].below < z) ++i;
    return i;
  }

 private:
  const std::vector<Plane>& planes_;
  int shift_ = 0;
  std::vector<std::uint32_t> table_;
};
}  // namespace

Cutter::Cutter(const Mesh& mesh, std::vector<Plane> planes) : mesh_(&mesh), planes_(std::move(planes)) {
  const PlanesBelow planes_below(planes_);
  std::vector<std::uint32_t> at(mesh.vertices.size());
  for (std::size_t v = 0; v < at.size(); ++v) at[v] = planes_below(mesh.vertices[v].z);
  const auto range_of = [&](const Triangle& t) {  // the planes between its lowest and its highest corner
    return std::minmax({at[t[0]], at[t[1]], at[t[2]]});
  };
  starts_.assign(planes_.size() + 1, 0);
  StopNowAndThen stop(4096);
  for (const auto& triangle : mesh.triangles) {
    stop.step();
    const auto [first, end] = range_of(triangle);
    for (std::uint32_t p = first; p < end; ++p) ++starts_[p];
  }
  std::uint32_t sum = 0;
  for (auto& start : starts_) start = sum += start;  // ends, which filling from behind turns into starts
  triangles_.resize(sum);
  for (std::size_t t = mesh.triangles.size(); t-- > 0;) {
    stop.step();
    const auto [first, end] = range_of(mesh.triangles[t]);
    for (std::uint32_t p = first; p < end; ++p) triangles_[--starts_[p]] = static_cast<std::uint32_t>(t);
  }
}

namespace {

/// A ring told by as few chords as `resolution` allows: a corner is worth an outline that lies so far off along
/// tolerances::shortest_piece. Chords lie in the middle of what they stand for, so that they stand off less than those
/// between corners of the model would, holes get no smaller and pins no thinner.
Ring in_few_chords(const Ring& ring, Um resolution) {
  if (ring.size() <= 3 || resolution <= 0) return ring;
  constexpr Um lattice = 1;  // where edges within a slanted face are cut there are corners that tell nothing
  Ring corners = geometry::coarsened(ring, lattice);
  const auto first = std::min_element(corners.begin(), corners.end(),
                                      [](Point a, Point b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); });
  std::rotate(corners.begin(), first, corners.end());
  const Point origin = corners.front();  // the same wherever the ring begins, and wherever it stands
  VertexPath path;
  path.reserve(corners.size());
  for (const Point p : corners)
    path.push_back({static_cast<double>(p.x - origin.x), static_cast<double>(p.y - origin.y), 0});
  const double off = resolution;
  simplify(path, true, off * off * tolerances::shortest_piece);
  Ring out;
  out.reserve(path.size());
  for (const PathVertex& v : path) {
    const Point p{origin.x + rounded(v.x), origin.y + rounded(v.y)};
    if (out.empty() || out.back() != p) out.push_back(p);
  }
  return out.size() >= 3 ? out : corners;
}

/// What rings enclose: those that run clockwise are holes in the others, and no more than that where they reach beyond
/// them. Those that meet no other are parts that are inside out, unless a shell of the mesh cuts through another: then
/// they are where it leaves that one.
Regions solid_of(std::vector<Ring> rings, bool cut_through, bool& met) {
  if (cut_through) return geometry::regions_from_rings(rings, geometry::WindingRule::positive, &met);
  const auto hole = [](const Ring& ring) { return double_area(ring) < 0; };
  Regions any = geometry::regions_from_rings(rings, geometry::WindingRule::nonzero, &met);
  if (std::none_of(rings.begin(), rings.end(), hole)) return any;
  Regions solid = geometry::regions_from_rings(rings, geometry::WindingRule::positive);
  if (area_mm2(any) - area_mm2(solid) < 1e-6 * tolerances::sliver_area_um2) return any;
  std::vector<Ring> outer;
  std::copy_if(rings.begin(), rings.end(), std::back_inserter(outer), [&](const Ring& r) { return !hole(r); });
  const Regions others = geometry::regions_from_rings(outer);
  for (Ring& ring : rings) {
    if (!hole(ring)) continue;
    const Region part{{ring.rbegin(), ring.rend()}, {}};
    if (geometry::intersect({part}, others).empty()) ring = part.outer;
  }
  return geometry::regions_from_rings(rings, geometry::WindingRule::positive);
}

Regions solid_of(std::vector<Ring> rings, bool cut_through, SlicingMode mode, bool& met) {
  if (mode == SlicingMode::even_odd) return geometry::regions_from_rings(rings, geometry::WindingRule::even_odd, &met);
  Regions solid = solid_of(std::move(rings), cut_through, met);
  if (mode == SlicingMode::regular) return solid;
  for (Region& region : solid) region.holes.clear();
  return geometry::unite(solid);  // what stood in a hole is within its region now
}

/// Whether `is(ring)` of any outline within `near` of a place.
template <class Is>
bool any_near(const geometry::SegmentIndex& rings, Point at, Um near, std::vector<std::uint32_t>& found, Is is) {
  found.clear();
  rings.near({{at.x - near, at.y - near}, {at.x + near, at.y + near}}, found);
  return std::any_of(found.begin(), found.end(), [&](std::uint32_t s) {
    return geometry::foot_of(at, rings.segments()[s]).distance_um <= near && is(rings.origin(s).region);
  });
}

/// Whether a corner of one outline lies on another, up to `near`.
bool corners_on_others(const std::vector<Ring>& rings, Um near) {
  const geometry::SegmentIndex index{std::span<const Ring>(rings)};
  std::vector<std::uint32_t> found;
  for (std::uint32_t r = 0; r < rings.size(); ++r)
    for (const Point p : rings[r])
      if (any_near(index, p, near, found, [r](std::uint32_t ring) { return ring != r; })) return true;
  return false;
}

/// Whether outlines of two bodies may be no further apart than `near`.
bool near_each_other(const std::vector<Ring>& rings, Um near) {
  std::vector<Box> boxes;
  for (const Ring& ring : rings)
    if (double_area(ring) > 0) boxes.push_back(box_of(ring));
  std::sort(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) { return a.min.x < b.min.x; });
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = i + 1; j < boxes.size() && boxes[j].min.x <= boxes[i].max.x + near; ++j)
      if (boxes[j].min.y <= boxes[i].max.y + near && boxes[i].min.y <= boxes[j].max.y + near)
        return corners_on_others(rings, near);
  return false;
}

/// Whether an area has outlines of two bodies within `near`: what has one is a notch of it.
bool lies_between(const Region& area, const geometry::SegmentIndex& bodies, Um near) {
  std::optional<std::uint32_t> one;
  std::vector<std::uint32_t> found;
  const auto is_another = [&one](std::uint32_t body) { return body != (one ? *one : one.emplace(body)); };
  for (const Ring& ring : geometry::rings_of({area}))
    for (const Point p : ring)
      if (any_near(bodies, p, near, found, is_another)) return true;
  return false;
}

double outlines_um(const Regions& regions) {
  double out = 0;
  for (const Ring& ring : geometry::rings_of(regions)) out += perimeter_of(ring);
  return out;
}

/// Bodies that touch are one: where two faces lie on each other, each is cut and simplified by itself, and often made
/// of other triangles, and between what comes of them is a crack through the part, which walls would follow on both
/// sides.
/// @param bodies their outlines, as they were cut
Regions without_cracks(const Regions& solid, const std::vector<Ring>& bodies, Um radius) {
  constexpr double least_um = 400;  // both sides of what is half as long as a bead is wide
  constexpr Um lap = 10;            // what is filled meets what it lies between
  const Regions closed = geometry::closing(solid, radius, geometry::Corner::miter);
  if (outlines_um(closed) > outlines_um(solid) - least_um) return solid;
  // Cracks may be too thin to be areas: both sides are drawn back first, and what that takes elsewhere is a thin rim.
  const Regions cracks_and_rim = geometry::subtract(closed, geometry::offset(solid, {.by = -lap}));
  Regions cracks = geometry::opening(cracks_and_rim, lap * 7 / 10, geometry::Corner::miter);
  const geometry::SegmentIndex index{std::span<const Ring>(bodies)};
  std::erase_if(cracks, [&](const Region& crack) {
    return perimeter_of(crack.outer) < least_um || !lies_between(crack, index, 2 * lap);
  });
  return cracks.empty() ? solid : geometry::unite(solid, cracks);
}

}  // namespace

Cut Cutter::cut(std::size_t i, const LayerSettings& settings) const {
  const Plane& plane = planes_[i];
  Cut out{{plane.z, plane.height, {}}, {}, {}};
  Chains chains = stitch(*mesh_, triangles_of(i), plane.below);
  if (!chains.open.empty()) close(chains, out.closed, out.bridged);
  StopNowAndThen stop(64);
  for (auto& ring : chains.rings) {
    stop.step();
    ring = in_few_chords(ring, settings.resolution);
  }
  const Um radius = settings.slice_closing_radius;
  bool met = radius > 0 && near_each_other(chains.rings, 2 * radius);
  const std::vector<Ring> bodies = met ? chains.rings : std::vector<Ring>{};
  out.layer.regions = solid_of(std::move(chains.rings), mesh_->cut_through, settings.slicing_mode, met);
  if (met && radius > 0) out.layer.regions = without_cracks(out.layer.regions, bodies, radius);
  return out;
}

}  // namespace weft::slice
