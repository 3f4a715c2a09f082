// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/simplify.h"
#include "geometry/touching.h"
#include "travel/blocks.h"
#include "travel/box_columns.h"
#include "travel/comb_base.h"
#include "travel/off_surfaces.h"

#include <algorithm>

namespace weft::travel {
namespace {

constexpr std::size_t corners_kept = 12;

Comb comb_boundary(const TravelSettings& settings, const LayerInput& input) {
  if (settings.retraction_combing == Combing::off) return {};
  if (settings.retraction_combing == Combing::infill) return Comb(gathered(input, &ObjectLayer::sparse));
  const bool all = settings.retraction_combing == Combing::all;
  if (all && settings.retraction_combing_offset == 0 && all_closed(input)) return Comb(outer_wall_rings(input));
  const auto base = comb_base(input, all ? settings.retraction_combing_offset : 0);
  if (settings.retraction_combing == Combing::noskin)
    return Comb(geometry::subtract(base, gathered(input, &ObjectLayer::skin)));
  return Comb(base);
}

/// Travels keep this far from the edges of the room, µm.
constexpr Um clearance = 100;

/// Where the nozzle may go at all; nothing where any straight way between two places of the room stays in it.
Regions free_area(const Room& room) {
  if (room.reach.size() < 3) return {};
  bool convex = true;
  const std::size_t n = room.reach.size();
  for (std::size_t i = 0; i < n; ++i)
    convex = convex && orient(room.reach[i], room.reach[(i + 1) % n], room.reach[(i + 2) % n]) >= 0;
  if (convex && room.no_go.empty()) return {};
  const Regions reach{{room.reach, {}}};
  if (room.no_go.empty()) return reach;
  return geometry::subtract(reach, geometry::offset(geometry::regions_from_rings(room.no_go), {.by = clearance}));
}

/// What travels go round.
Regions obstacles_of(const TravelSettings& settings, const LayerInput& input) {
  constexpr Um coarse = 50;  // support is kept off by much more
  Regions out;
  const auto add = [&](const Regions& more) { out.insert(out.end(), more.begin(), more.end()); };
  for (const auto& object : input.objects) {
    if (!object.support && settings.travel_avoid_other_parts) add(object.outline);
    if (object.support && settings.travel_avoid_supports) add(geometry::simplified(object.outline, coarse));
  }
  if (settings.travel_avoid_supports) add(geometry::simplified(input.support, coarse));
  return out;
}

/// Whether a box lies within a convex ring.
bool surrounds(const Ring& ring, const Box& box) {
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (orient(ring[i], ring[(i + 1) % n], ring[(i + 2) % n]) < 0) return false;
    for (const Point p : {box.min, Point{box.max.x, box.min.y}, box.max, Point{box.min.x, box.max.y}})
      if (orient(ring[i], ring[(i + 1) % n], p) <= 0) return false;
  }
  return true;
}

/// The room less what travels go round and what is to be kept from it.
Regions area_around(const TravelSettings& settings, const Regions& outline, const Room& room, const Regions& free) {
  if (outline.empty()) return {};
  Regions place = free;
  if (place.empty() && room.reach.size() >= 3) place = {{room.reach, {}}};
  if (place.empty()) {
    const Box box = box_of(outline).grown(2 * settings.travel_avoid_distance + 10000);
    place = {{{box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}}, {}}};
  }
  const Regions kept_off =
      geometry::offset_apart(outline, {.by = settings.travel_avoid_distance, .corner = geometry::Corner::round});
  // Mostly all of that lies inside: then it is holes of the place, and no sweep is needed to know.
  if (place.size() > 1 || !place.front().holes.empty() || !surrounds(place.front().outer, box_of(kept_off)))
    return geometry::subtract(place, kept_off);
  auto rings = geometry::rings_of(place);
  for (Ring& ring : geometry::rings_of(kept_off)) rings.push_back(std::move(ring));
  return geometry::regions_from_rings(rings, geometry::WindingRule::even_odd);
}

/// Of each ring, whether what it goes round is a hole: whether an odd number of the others is round it.
std::vector<char> holes_among(const std::vector<Ring>& rings) {
  std::vector<Box> boxes;
  for (const auto& r : rings) boxes.push_back(box_of(r));
  const BoxColumns columns(std::move(boxes));
  std::vector<char> hole(rings.size(), 0);
  StopNowAndThen stop(64);
  for (std::size_t i = 0; i < rings.size(); ++i) {
    stop.step();
    columns.each_around(i, [&](std::uint32_t k) {
      if (side_of(rings[k], rings[i][0]) == Side::inside) hole[i] = hole[i] == 0;
    });
  }
  return hole;
}

void add_seams(const TravelSettings& settings, Prepared& layer) {
  std::vector<Ring> rings;
  for (std::uint32_t b = 0; b < layer.blocks.size(); ++b) {
    Block& block = layer.blocks[b];
    const Beads& beads = beads_of(layer.input, block);
    for (const std::uint32_t w : block.walls) {
      const bool seam = begins_a_seam_line(beads[w]);
      block.seams.push_back(seam ? static_cast<std::uint32_t>(layer.seams.size()) : Block::no_seam);
      if (!seam) continue;
      layer.seams.push_back({b, w, {}});
      rings.push_back(ring_of(beads[w]));
    }
  }
  const auto hole = holes_among(rings);
  for (std::size_t s = 0; s < rings.size(); ++s) {
    stop_if_asked();
    auto& seam = layer.seams[s];
    const bool counter_clockwise = double_area(rings[s]) > 0;
    const bool material_left = counter_clockwise != (hole[s] != 0);
    const auto& own = seams_of(settings, layer.input, layer.blocks[seam.block]);
    seam.corners = corners_of(beads_of(layer.input, layer.blocks[seam.block])[seam.bead], own.z_seam_corner,
                              material_left, corners_kept);
    if (own.z_seam_visibility_weight == 0 || own.z_seam_type == SeamType::random ||
        own.z_seam_type == SeamType::shortest)
      continue;
    // A corner so much blunter than the best cannot be hidden enough to win: its rays are spared.
    const double decides = 2 * own.z_seam_visibility_weight / std::max(0.01, own.z_seam_corner_weight);
    const auto worth = std::find_if(seam.corners.begin(), seam.corners.end(), [&](const Corner& c) {
      return static_cast<double>(c.strength) < static_cast<double>(seam.corners.front().strength) - decides;
    });
    add_exposure(beads_of(layer.input, layer.blocks[seam.block])[seam.bead], material_left, layer.outline,
                 {seam.corners.begin(), worth});
  }
}

}  // namespace

AreasRead areas_read(const TravelSettings& settings) {
  const auto combing = settings.retraction_combing;
  return {combing == Combing::noskin, combing == Combing::no_outer_surfaces, combing == Combing::infill};
}

Prepared prepare_order(const TravelSettings& settings, LayerInput input) {
  Prepared out;
  out.input = std::move(input);
  out.blocks = blocks_of(out.input);
  out.outline = Comb(gathered(out.input, &ObjectLayer::outline));
  add_seams(settings, out);
  return out;
}

void prepare_ways(const TravelSettings& settings, Prepared& layer) {
  const auto outline = gathered(layer.input, &ObjectLayer::outline);
  if (settings.retraction_combing == Combing::no_outer_surfaces) {
    layer.comb = within_second_walls(layer.input, outline);
    layer.narrows = within_outer_walls(layer.input);
  } else {
    layer.comb = comb_boundary(settings, layer.input);
  }
  const auto free = free_area(layer.input.room);
  layer.free = Comb(free);
  layer.around = Comb(area_around(settings, obstacles_of(settings, layer.input), layer.input.room, free));
}

Prepared prepare(const TravelSettings& settings, LayerInput input) {
  auto out = prepare_order(settings, std::move(input));
  prepare_ways(settings, out);
  return out;
}

}  // namespace weft::travel
