// SPDX-License-Identifier: GPL-3.0-or-later
#include "travel/way.h"

#include "travel/off_surfaces.h"

#include <algorithm>

namespace weft::travel {
namespace {

/// How far from the comb boundary a bead may end and still be reached from it without a retraction, µm.
constexpr Um reach_um = 2500;

}  // namespace

double length_from(Point p, const Polyline& way) {
  double sum = 0;
  for (const Point q : way) sum += distance(p, q), p = q;
  return sum;
}

Way Router::way(Point p, Point q, bool to_outer_wall) const {
  auto inside = off_outer_walls(p, q);
  if (!inside || leaves_room(p, inside->points)) return direct(p, q);
  Polyline& points = inside->points;
  const double length = length_from(p, points);
  if (too_long(length, distance(p, q))) return direct(p, q);
  const bool strict = (inside->on_outer_walls || !retraction_.retract_only_when_crossing) &&
                      length >= retraction_.retraction_min_travel;
  // Checked all the same: the boundary may be moved outwards, and an outer wall may leave the outline where it is thin.
  const bool crosses = leaves_outline(p, points);
  return {std::move(points), drains(length, to_outer_wall) || strict || crosses, crosses, false};
}

/// A way inside, through necks where there is none in the comb area. One that leads over an outer wall to come to that
/// area goes along the middle of such a neck, too, if that keeps off the wall.
std::optional<Router::Inside> Router::off_outer_walls(Point p, Point q) const {
  auto wide = combed(layer_.comb, p, q);
  if (layer_.narrows.empty()) return wide;
  if (wide)
    wide->on_outer_walls =
        wide->from_um + wide->to_um > most_on_outer_walls_um() && lies_on_outer_walls(p, *wide, true);
  if (wide ? !wide->on_outer_walls : apart(p, q)) return wide;
  auto narrow = combed(half_a_bead_in(), p, q);
  if (!narrow && !wide) narrow = combed(layer_.narrows, p, q);
  if (!narrow) return wide;
  narrow->on_outer_walls = lies_on_outer_walls(p, *narrow, false);
  const bool no_better = narrow->on_outer_walls || too_long(length_from(p, narrow->points), distance(p, q));
  return wide && no_better ? wide : narrow;
}

/// How much of a way may lie on outer walls: leaving one squarely and coming to one takes half a bead each, and half as
/// much again is for ways that slant.
double Router::most_on_outer_walls_um() const {
  return 1.5 * layer_.input.nozzle;
}

/// Whether more of a way than that lies on outer walls: what oozes there is a scar as long. Short ways are not asked.
bool Router::lies_on_outer_walls(Point p, const Inside& way, bool ends_alone) const {
  if (length_from(p, way.points) < retraction_.retraction_min_travel) return false;
  double sum = 0;
  for (std::size_t i = 0; i < way.points.size() && sum <= most_on_outer_walls_um(); p = way.points[i++])
    if (!ends_alone || (i == 0 && way.from_um > 0) || (i + 1 == way.points.size() && way.to_um > 0))
      sum += on_outer_walls_um(p, way.points[i]);
  return sum > most_on_outer_walls_um();
}

/// How much of a segment lies within half a nozzle of the centreline of an outer wall, up to a quarter of it.
double Router::on_outer_walls_um(Point p, Point q) const {
  const Um nozzle = layer_.input.nozzle;
  const double least_step_um = nozzle / 4.0;
  if (!outer_walls_) outer_walls_ = outer_walls(layer_.input);
  double sum = 0;
  const double length = distance(p, q);
  for (double at = 0; at < length;) {
    const Point here = lerp(p, q, at / length);
    const auto wall = outer_walls_->nearest_on_boundary(here, nozzle);
    const double off = (wall ? distance(here, *wall) : nozzle) - nozzle / 2.0;  // nothing nearer within as far ahead
    const double step = std::min(std::max(off, least_step_um), length - at);
    if (off < 0) sum += step;
    at += step;
  }
  return sum;
}

/// Whether the two lie in different parts of the layer: no way inside leads from one to the other.
bool Router::apart(Point p, Point q) const {
  const std::uint32_t part = outline_.part_of(p), other = outline_.part_of(q);
  return part != other && part != Comb::outside && other != Comb::outside;
}

const Comb& Router::half_a_bead_in() const {
  if (!half_a_bead_in_) half_a_bead_in_ = half_a_bead_within(layer_.input);
  return *half_a_bead_in_;
}

/// A detour is worth a retraction's time and the strings it saves, and not more. Without retractions nothing else is
/// left against strings.
bool Router::too_long(double combed_um, double straight_um) const {
  if (!settings_.retraction_combing_max_detour || !retraction_.retraction_enable) return false;
  return combed_um - straight_um > settings_.retraction_combing_max_detour->of(rounded(straight_um));
}

/// Whether a way inside is so long that the nozzle comes to its end with less than it left with. Where an outer wall
/// begins that is seen; a way too short for any retraction is none the less.
bool Router::drains(double combed_um, bool to_outer_wall) const {
  const auto& any = settings_.retraction_combing_max_distance;
  const auto& outer = settings_.retraction_combing_max_distance_wall_0;
  return (any && combed_um > *any) ||
         (to_outer_wall && outer && combed_um > *outer && combed_um >= retraction_.retraction_min_travel);
}

/// Over the part's edge: round the other parts where asked, round what may not be entered in any case.
Way Router::direct(Point p, Point q) const {
  Way way{{q}, false, leaves_outline(p, {q}), false};
  if (way.crosses) {
    auto round = obstacles_.way(p, q);
    // Parts are gone round however long it takes where that is asked for; support, where it costs little.
    if (round && (settings_.travel_avoid_other_parts || !too_long(length_from(p, *round), distance(p, q))))
      way.points = std::move(*round);
  }
  if (leaves_room(p, way.points)) {
    const std::uint32_t part = layer_.free.part_of(p);
    std::optional<Polyline> round;
    if (part != Comb::outside && part == layer_.free.part_of(q)) round = layer_.free.way(p, q);
    way.outside = !round;
    way.points = round ? std::move(*round) : Polyline{q};
    way.crosses = leaves_outline(p, way.points);
  }
  way.retract = way.crosses || length_from(p, way.points) >= retraction_.retraction_min_travel;
  return way;
}

bool Router::leaves_room(Point p, const Polyline& way) const {
  if (layer_.free.empty()) return false;
  for (const Point q : way) {
    if (!layer_.free.sees(p, q)) return true;
    p = q;
  }
  return layer_.free.part_of(p) == Comb::outside;
}

bool Router::leaves_outline(Point p, const Polyline& way) const {
  const bool inside = outline_.part_of(p) != Comb::outside;
  for (const Point q : way) {
    if (!outline_.sees(p, q)) return true;
    p = q;
  }
  return inside != (outline_.part_of(p) != Comb::outside);
}

/// The point of the comb area from which p is reached inside the part.
std::optional<Router::Gate> Router::gate(const Comb& comb, Point p) const {
  if (const std::uint32_t part = comb.part_of(p); part != Comb::outside) return Gate{p, part};
  const auto gate = comb.nearest_on_boundary(p, reach_um);
  if (!gate || outline_.part_of(p) == Comb::outside || !outline_.sees(p, *gate)) return std::nullopt;
  return Gate{*gate, comb.part_of(*gate)};
}

std::optional<Router::Inside> Router::combed(const Comb& comb, Point p, Point q) const {
  if (comb.empty()) return std::nullopt;
  const auto from = gate(comb, p);
  if (!from) return std::nullopt;
  const auto to = gate(comb, q);
  if (!to) return std::nullopt;
  const double first = distance(p, from->at), last = distance(to->at, q);
  if (first + last > 0 && distance(p, q) <= first + last && outline_.sees(p, q)) return Inside{{q}, first, last};
  if (from->part == Comb::outside || from->part != to->part) return std::nullopt;
  auto inside = comb.way(from->at, to->at);
  if (!inside) return std::nullopt;
  if (from->at != p) inside->insert(inside->begin(), from->at);
  if (to->at != q) inside->push_back(q);
  return Inside{std::move(*inside), first, last};
}

}  // namespace weft::travel
