// SPDX-License-Identifier: GPL-3.0-or-later
#include "travel/obstacles.h"

#include "core/convex_hull.h"
#include "geometry/boolean.h"
#include "geometry/simplify.h"
#include "geometry/spatial_index.h"
#include "geometry/touching.h"

#include <algorithm>
#include <utility>

namespace weft::travel {
namespace {

/// Travels keep this far from the edges of the room, µm.
constexpr Um clearance = 100;

/// Rounds are led so much further out that nothing of their chords comes nearer than travel_avoid_distance.
constexpr Um arc = 30;

Regions kept_off(const Regions& obstacles, Um distance) {
  return geometry::offset_apart(obstacles,
                                {.by = distance + arc, .corner = geometry::Corner::round, .arc_tolerance = arc});
}

Regions obstacles_of(const TravelSettings& settings, const LayerInput& input) {
  constexpr Um coarse = 50;  // support is kept off by much more
  Regions out;
  const auto add = [&](const Regions& more) { out.insert(out.end(), more.begin(), more.end()); };
  // Ring by ring: where chords meet, what is kept off both meets as well.
  const auto add_coarse = [&](const Regions& more) { add(geometry::coarsened(more, coarse)); };
  for (const auto& object : input.objects) {
    if (!object.support && settings.travel_avoid_other_parts) add(object.outline);
    if (object.support && settings.travel_avoid_supports) add_coarse(object.outline);
  }
  if (settings.travel_avoid_supports) add_coarse(input.support);
  return out;
}

/// Whether a box lies within a convex ring.
bool surrounds(const Ring& ring, const Box& box) {
  if (!is_convex(ring)) return false;
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i)
    for (const Point p : {box.min, Point{box.max.x, box.min.y}, box.max, Point{box.min.x, box.max.y}})
      if (orient(ring[i], ring[(i + 1) % n], p) <= 0) return false;
  return true;
}

/// The room less what travels go round and what is to be kept from it.
Regions area_around(const TravelSettings& settings, const Regions& obstacles, const Room& room) {
  Regions place = free_area(room);
  if (place.empty() && room.reach.size() >= 3) place = {{room.reach, {}}};
  if (place.empty()) {
    const Box box = box_of(obstacles).grown(2 * settings.travel_avoid_distance + 10000);
    place = {{{box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}}, {}}};
  }
  const Regions off = kept_off(obstacles, settings.travel_avoid_distance);
  // Mostly all of that lies inside: then it is holes of the place, and no sweep is needed to know.
  if (place.size() > 1 || !place.front().holes.empty() || !surrounds(place.front().outer, box_of(off)))
    return geometry::subtract(place, off);
  auto rings = geometry::rings_of(place);
  for (Ring& ring : geometry::rings_of(off)) rings.push_back(std::move(ring));
  return geometry::regions_from_rings(rings, geometry::WindingRule::even_odd);
}

/// Whether the straight way from p to q meets a box.
bool meets(Point p, Point q, const Box& box) {
  if (!box.overlaps({{std::min(p.x, q.x), std::min(p.y, q.y)}, {std::max(p.x, q.x), std::max(p.y, q.y)}})) return false;
  int left = 0, right = 0;
  for (const Point corner : {box.min, Point{box.max.x, box.min.y}, box.max, Point{box.min.x, box.max.y}}) {
    const auto side = orient(p, q, corner);
    left += side >= 0, right += side <= 0;
  }
  return left > 0 && right > 0;
}

/// Whether p lies in a ring or no further from it than that.
bool is_near(const Ring& ring, Point p, double within) {
  if (side_of(ring, p) != Side::outside) return true;
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (geometry::foot_of(p, {ring[i], ring[(i + 1) % ring.size()]}).distance_um <= within) return true;
  return false;
}

}  // namespace

Regions free_area(const Room& room) {
  if (room.reach.size() < 3) return {};
  if (is_convex(room.reach) && room.no_go.empty()) return {};
  const Regions reach{{room.reach, {}}};
  if (room.no_go.empty()) return reach;
  return geometry::subtract(reach, geometry::offset(geometry::regions_from_rings(room.no_go), {.by = clearance}));
}

Obstacles::Obstacles(const TravelSettings& settings, const LayerInput& input)
    : settings_(settings), input_(input), what_(obstacles_of(settings, input)) {
  std::vector<Box> reach;
  for (const Region& region : what_) {
    reach.push_back(box_of(region.outer).grown(settings.travel_avoid_distance + 2 * arc + 2));
    convex_.push_back(region.holes.empty() && is_convex(region.outer));
  }
  for (auto& together : geometry::touching(reach)) {
    Box box;
    for (const std::size_t i : together) box.add(reach[i]);
    clusters_.push_back({std::move(together), box});
  }
  open_ = is_open();
}

bool Obstacles::is_open() const {
  const Room& room = input_.room;
  if (!room.no_go.empty()) return false;
  if (room.reach.size() < 3) return true;
  Box all;
  for (const Cluster& cluster : clusters_) all.add(cluster.reach);
  return surrounds(room.reach, all);
}

const Regions& Obstacles::kept_off(const Cluster& cluster) const {
  if (cluster.kept_off.empty()) {
    Regions some;
    for (const std::size_t i : cluster.of) some.push_back(what_[i]);
    cluster.kept_off = travel::kept_off(some, settings_.travel_avoid_distance);
  }
  return cluster.kept_off;
}

/// Whether p lies in what is kept off something without holes: a way that begins or ends there leaves it just once.
bool Obstacles::leaves_freely(const Cluster& cluster, Point p) const {
  constexpr Um doubt = 2;  // of whole microns
  if (!cluster.reach.contains(p)) return false;
  if (cluster.of.size() == 1 && convex_[cluster.of.front()])
    return is_near(what_[cluster.of.front()].outer, p, settings_.travel_avoid_distance - doubt);
  const Regions& off = kept_off(cluster);
  return off.size() == 1 && off.front().holes.empty() && side_of(off.front().outer, p) == Side::inside;
}

/// The clusters that may stand in the straight way.
std::vector<std::uint32_t> Obstacles::between(Point p, Point q) const {
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = 0; i < clusters_.size(); ++i) {
    const Cluster& cluster = clusters_[i];
    if (meets(p, q, cluster.reach) && !leaves_freely(cluster, p) && !leaves_freely(cluster, q)) out.push_back(i);
  }
  return out;
}

/// Such a way keeps to the rings that the straight one meets: it can meet no others but those in their box.
std::optional<Polyline> Obstacles::way_round(Point p, Point q, const std::vector<std::uint32_t>& between) const {
  Box box;
  box.add(p), box.add(q);
  for (const auto i : between) box.add(clusters_[i].reach);
  const Comb comb = round_clusters(box);
  return comb.way(p, q, {comb.hole_around(p), comb.hole_around(q)});
}

/// What is kept off the clusters that a box meets, in a box around all of it.
Comb Obstacles::round_clusters(const Box& box) const {
  std::vector<Ring> rings;
  Box all = box;
  for (const Cluster& cluster : clusters_)
    if (box.overlaps(cluster.reach)) {
      for (Ring& ring : geometry::rings_of(kept_off(cluster))) rings.push_back(std::move(ring));
      all.add(cluster.reach);
      ++gathered_;
    }
  all = all.grown(1000);
  rings.push_back({all.min, {all.max.x, all.min.y}, all.max, {all.min.x, all.max.y}});
  return Comb(std::move(rings));
}

const Comb& Obstacles::around() const {
  if (!around_ && open_) {
    Box room = box_of(what_).grown(2 * settings_.travel_avoid_distance + 10000);
    room.add(box_of(input_.room.reach));
    around_ = round_clusters(room);
  }
  if (!around_) around_.emplace(area_around(settings_, what_, input_.room));
  return *around_;
}

std::optional<Polyline> Obstacles::way(Point p, Point q) const {
  if (what_.empty()) return std::nullopt;
  if (open_) {
    const auto clusters = between(p, q);
    if (clusters.empty()) return Polyline{q};
    if (gathered_ < clusters_.size()) return way_round(p, q, clusters);  // then all of them at once cost less
  }
  const Comb& comb = around();
  if (comb.empty()) return std::nullopt;
  return comb.way(p, q, {comb.hole_around(p), comb.hole_around(q)});
}

}  // namespace weft::travel
