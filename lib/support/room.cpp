// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/room.h"

#include "geometry/boolean.h"
#include "geometry/nudge.h"
#include "geometry/simplify.h"
#include "geometry/touching.h"
#include "geometry/trimmed.h"
#include "support/lengths.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <cstdlib>

namespace weft::support {
namespace {

/// Corners of the part that lie nearer to the straight line are none to support. What is lost by that, the distances
/// are larger.
constexpr Um fine_outline = 10_um;

/// What is no further from the part than that. Corners are mitered: an arc a corner is what costs.
Regions kept_off(const Regions& part, Um by) {
  if (part.empty()) return part;
  return geometry::offset_apart(part, {.by = by + fine_outline + outline_bound});
}

double distance_between(const geometry::Segment& s, const geometry::Segment& t) {
  if (segments_touch(s.a, s.b, t.a, t.b)) return 0;
  return std::min({geometry::foot_of(s.a, t).distance_um, geometry::foot_of(s.b, t).distance_um,
                   geometry::foot_of(t.a, s).distance_um, geometry::foot_of(t.b, s).distance_um});
}

/// Whether any of a ring lies in what an edge goes around, or comes as near to the edge.
bool is_near(const Ring& ring, const geometry::SegmentIndex& edge, Um within) {
  std::vector<std::uint32_t> met;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const geometry::Segment side{ring[i], ring[i + 1 < ring.size() ? i + 1 : 0]};
    const Box box = side.box().grown(within);
    if (!box.overlaps(edge.box())) continue;
    edge.near(box, met);
    if (std::any_of(met.begin(), met.end(), [&](std::uint32_t m) {
          const geometry::Segment& other = edge.segments()[m];
          return box.overlaps(other.box()) && distance_between(side, other) <= within;
        }))
      return true;
  }
  return edge.winding(ring.front()).value_or(1) != 0;
}

/// Whether a piece of the part comes as near to an area.
bool comes_near(const Region& part, const Regions& area, const geometry::SegmentIndex& edge, Um within) {
  return is_near(part.outer, edge, within) ||
         std::any_of(part.holes.begin(), part.holes.end(),
                     [&](const Ring& hole) { return is_near(hole, edge, within); }) ||
         std::any_of(area.begin(), area.end(),
                     [&](const Region& region) { return side_of(part, region.outer.front()) != Side::outside; });
}

}  // namespace

Um beside(const SupportSettings& settings, const Object& object) {
  return settings.support_xy_distance.of(object.outer_line);
}

LayerRun layers_between(const Object& object, Um low, Um high) {
  const auto& layers = object.layers;
  const auto first = std::partition_point(layers.begin(), layers.end(), [&](const auto* l) { return l->z <= low; });
  const auto last = std::partition_point(first, layers.end(), [&](const auto* l) { return l->z - l->height < high; });
  return {static_cast<std::size_t>(first - layers.begin()), static_cast<std::size_t>(last - layers.begin())};
}

Regions blocked_between(const Object& object, Um low, Um high) {
  Regions out;
  const auto run = layers_between(object, low, high);
  for (std::size_t i = run.from; i < std::min(run.to, object.blocked.size()); ++i) append(out, object.blocked[i]);
  return out.empty() ? out : geometry::unite(out);
}

Room::Room(const SupportSettings& settings, const Object& object)
    : s_(settings),
      o_(object),
      beside_(beside(settings, object)),
      close_(settings.support_xy_overrides_z ? beside_ : std::min(beside_, settings.support_xy_distance_overhang)),
      outlines_(tasks::parallel_map(object.layers.size(),
                                    [&](std::size_t i) {
                                      Outlines out{geometry::simplified(object.layers[i]->regions, fine_outline), {}};
                                      for (const Region& region : out.regions)
                                        out.boxes.push_back(box_of(region.outer));
                                      return out;
                                    })),
      bounds_(object.room != nullptr ? geometry::SegmentIndex(*object.room) : geometry::SegmentIndex()) {}

Regions Room::part(Um low, Um high, const Box& near) const {
  const auto run = layers_between(o_, low, high);
  Regions out, some;
  for (std::size_t i = run.from; i < run.to; ++i) {
    const Outlines& layer = outlines_[i];
    some.clear();
    for (std::size_t r = 0; r < layer.boxes.size(); ++r)
      if (layer.boxes[r].overlaps(near)) append(some, geometry::trimmed({&layer.regions[r], 1}, near));
    if (some != out) append(out, some);  // layers of a straight wall are one
  }
  return out;
}

/// What of a level waits for the next step over a slope: what the part has left since the step began, no wider than a
/// step may be.
Regions Room::stair(const Stack::Level& level, const Box& near) const {
  const Um step = s_.support_bottom_stair_step_height, width = s_.support_bottom_stair_step_width;
  if (step <= 0 || width <= 0 || level.bottom() <= o_.floor) return {};
  const Um begun = o_.floor + (level.bottom() - o_.floor) / step * step, gap = bottom_gap(s_);
  if (begun == level.bottom()) return {};
  const Box wide = near.grown(width + 1);
  const Regions now = part(level.bottom() - gap - 1, level.bottom() - gap, wide);
  if (now.empty()) return {};
  return geometry::intersect(geometry::unite(part(begun - gap, level.bottom() - gap, wide)), grown(now, width));
}

Regions Room::kept_off_beside(const Stack::Level& level, const Box& near) const {
  return kept_off(part(level.bottom(), level.z, near.grown(beside_ + 3 * outline_bound)), beside_);
}

Regions Room::part_near(Um low, Um high, const Place& place, Um within) const {
  Regions out = part(low, high, place.box.grown(within));
  std::erase_if(out, [&](const Region& piece) { return !support::comes_near(piece, place.area, place.edge, within); });
  return out;
}

Regions Room::kept_out(const Stack::Level& level, const Place& place, const Regions& part_beside) const {
  Regions out;
  const Um above = top_gap(s_), below = bottom_gap(s_);
  if (above > 0) {
    // What lies in the gap is kept off sideways too, so that a bead has room beside it for a contact that ends lower.
    const Regions in_gap = part_near(level.z, level.z + above, place, close_ + 3 * outline_bound);
    if (in_gap != part_beside) out = kept_off(in_gap, close_);
  }
  if (below > 0 && level.bottom() > o_.floor) append(out, part_near(level.bottom() - below, level.bottom(), place, 1));
  append(out, stair(level, place.box));
  if (s_.support_blockers_avoided) append(out, blocked_between(o_, level.bottom(), level.z));
  return out;
}

Regions Room::barred(const Stack::Level& level, const Place& place, const Regions& contacts,
                     const Regions* above) const {
  const bool is_contact = std::all_of(place.area.begin(), place.area.end(), [&](const Region& region) {
    return std::find(contacts.begin(), contacts.end(), region) != contacts.end();
  });
  const Regions part = part_near(level.bottom(), level.z, place, (is_contact ? close_ : beside_) + 3 * outline_bound);
  Regions barred = kept_out(level, place, part);
  if (part.empty()) return barred;
  if (is_contact) {
    append(barred, kept_off(part, close_));
    return barred;
  }
  Regions nearer;  // where the part is come nearer than elsewhere
  const auto keep_off = [&](Um distance) {
    const Regions off = kept_off(part, distance);
    append(barred, nearer.empty() ? off : geometry::beyond(off, nearer, 0));
  };
  const auto come_nearer = [&](const Regions& beside, Um distance) {
    const Regions near = geometry::trimmed(beside, place.box.grown(o_.nozzle + 1));
    if (near.empty() || close_ == beside_) return;
    keep_off(distance);
    append(nearer, grown(near, o_.nozzle));  // a strip alone could not be printed
  };
  come_nearer(contacts, close_);
  if (above != nullptr) come_nearer(*above, (close_ + beside_) / 2);
  keep_off(beside_);
  return barred;
}

/// What of it lies in the object's room.
Regions Room::within_bounds(const Region& region, const Box& box, bool& cut) const {
  if (o_.room == nullptr) return {region};
  std::vector<std::uint32_t> met;
  bounds_.near(box, met);
  const bool meets =
      std::any_of(met.begin(), met.end(), [&](std::uint32_t i) { return box.overlaps(bounds_.segments()[i].box()); });
  if (!meets && bounds_.region_at(region.outer.front())) return {region};
  cut = true;
  return geometry::intersect({region}, geometry::trimmed(*o_.room, box));
}

namespace {

/// So much more is kept off, on each level another: what one cut off does not lie on what cuts the next then, which
/// takes three times as long.
Um hair_on(const Stack::Level& level) {
  constexpr Um least = 2, kinds = 7;
  return least + std::abs(level.z / 10) % kinds;
}

}  // namespace

Regions Room::free_part(const Regions& area, const Stack::Level& level, const Regions& contacts, bool* changed,
                        const Regions* above) const {
  Regions out;
  bool any = false;
  for (const Region& region : area) {
    const Box box = box_of(region.outer).grown(1);
    bool cut = false;
    Regions left = within_bounds(region, box, cut);
    if (!left.empty()) {
      const Regions alone{region};
      const Um hair = hair_on(level);
      const Box wide = box.grown(4 * hair);
      const Regions not_there =
          geometry::trimmed(barred(level, {wide, alone, geometry::SegmentIndex(alone)}, contacts, above), wide);
      if (!not_there.empty()) left = geometry::beyond(left, not_there, hair), cut = true;
    }
    any = any || cut;
    append(out, left);
  }
  if (changed != nullptr) *changed = any;
  return out;
}

bool Room::comes_near(Um low, Um high, const Regions& area, const geometry::SegmentIndex& edge, Um within) const {
  const Box reach = edge.box().grown(within);
  const auto run = layers_between(o_, low, high);
  const Regions* before = nullptr;
  for (std::size_t i = run.from; i < run.to; ++i) {
    const Outlines& layer = outlines_[i];
    if (before != nullptr && layer.regions == *before) continue;  // layers of a straight wall are one
    before = &layer.regions;
    for (std::size_t r = 0; r < layer.boxes.size(); ++r) {
      if (!layer.boxes[r].overlaps(reach)) continue;
      if (support::comes_near(layer.regions[r], area, edge, within)) return true;
    }
  }
  return false;
}

bool Room::stands_free(const Regions& area, const geometry::SegmentIndex& edge, const Stack::Level& level,
                       const Stack::Level* above) const {
  if (area.empty()) return true;
  constexpr Um hair = 10;
  if (s_.support_blockers_avoided && !o_.blocked.empty()) return false;
  if (o_.room != nullptr)
    for (const Region& region : area) {
      bool cut = false;
      within_bounds(region, box_of(region.outer).grown(1), cut);
      if (cut) return false;
    }
  const Um kept = fine_outline + outline_bound - hair, gap = top_gap(s_);
  if (comes_near(level.bottom(), level.z, area, edge, beside_ + kept)) return false;
  const Um known = above != nullptr ? above->z : level.z;  // so far up the part is further away than close_
  if (known < level.z + gap && comes_near(known, level.z + gap, area, edge, close_ + kept)) return false;
  const Um step = std::max(s_.support_bottom_stair_step_height, 0);  // a stair may begin so far below
  return level.bottom() <= o_.floor ||
         !comes_near(level.bottom() - bottom_gap(s_) - step, level.bottom(), area, edge, 0);
}

std::vector<Regions> shadows(const Room& room, const Stack& stack) {
  const Object& object = room.object();
  Box box;
  for (const auto* layer : object.layers) box.add(box_of(layer->regions));
  const Um xy = beside(room.settings(), object);
  std::vector<Regions> out(stack.levels.size());
  Regions all;
  std::size_t layer = 0;
  for (std::size_t k = 0; k < stack.levels.size(); ++k) {
    Regions more;
    for (; layer < object.layers.size(); ++layer) {
      const auto& l = *object.layers[layer];
      if (l.z - l.height >= stack.levels[k].z) break;
      const Regions here = room.part(l.z - 1, l.z, box);
      if (!geometry::subtract(here, all).empty()) append(more, here);
    }
    if (!more.empty()) {
      append(all, grown(more, xy));
      all = geometry::simplified(geometry::unite(all), coarse_outline);
    }
    out[k] = all;
  }
  return out;
}

}  // namespace weft::support
