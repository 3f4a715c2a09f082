// SPDX-License-Identifier: GPL-3.0-or-later
#include "gcode/digest.h"

#include "core/convex_hull.h"
#include "gcode/dialect.h"
#include "model/flow.h"

#include <algorithm>

namespace weft::gcode {
namespace {

void take_in(LayerDigest& out, const Extrude& bead, Um z) {
  for (const auto& j : bead.path) {
    out.extents.add({j.at.x, j.at.y, z});
    out.covered.add(Box{j.at, j.at}.grown(flow::line_width(j.width, bead.height) / 2));
  }
  out.bytes += 48 * bead.path.size();
  if (bead.path.size() < 2) return;
  out.at = place_of(bead, bead.path.size() - 1, z);
  out.wiped_to.reset();
  if (bead.acceleration_mm_s2 > 0) out.print_acceleration = bead.acceleration_mm_s2;
}

void take_in(LayerDigest& out, const Travel& travel, bool own_acceleration) {
  for (const Point3 p : travel.path) out.extents.add(p);
  if (travel.path.empty()) return;
  out.at = travel.path.back();
  out.wiped_to.reset();
  if (travel.acceleration_mm_s2 > 0)
    (own_acceleration ? out.travel_acceleration : out.print_acceleration) = travel.acceleration_mm_s2;
}

void take_in(LayerDigest& out, const Retract& retract, Um z) {
  for (const Point p : retract.wipe) out.extents.add({p.x, p.y, z});
  if (!retract.wipe.empty()) out.wiped_to = retract.wipe.back();
}

}  // namespace

void Extents::add(Point3 p) {
  least = {std::min(least.x, p.x), std::min(least.y, p.y), std::min(least.z, p.z)};
  most = {std::max(most.x, p.x), std::max(most.y, p.y), std::max(most.z, p.z)};
}

void Extents::unite(const Extents& other) {
  if (!other.empty()) add(other.least), add(other.most);
}

namespace {

/// f(corner) of the squares around junctions, as wide as their line.
template <class F>
void for_each_corner(const LayerPlan& layer, const F& f) {
  for (const auto& step : layer.steps)
    if (const auto* bead = std::get_if<Extrude>(&step))
      for (const auto& j : bead->path) {
        const Box around = Box{j.at, j.at}.grown(flow::line_width(j.width, bead->height) / 2);
        for (const Point corner : {around.min, {around.max.x, around.min.y}, around.max, {around.min.x, around.max.y}})
          f(corner);
      }
}

/// Sorts no more than what may be a corner of it.
Ring hull_of(const LayerPlan& layer) {
  Outermost outermost;
  for_each_corner(layer, [&](Point p) { outermost.add(p); });
  const Ring octagon = outermost.octagon();
  Ring corners = octagon;
  for_each_corner(layer, [&](Point p) {
    if (!strictly_inside(p, octagon)) corners.push_back(p);
  });
  return convex_hull(std::move(corners));
}

}  // namespace

LayerDigest digest_of(const Settings& settings, const LayerPlan& layer) {
  const Dialect dialect = dialect_of(settings);
  LayerDigest out;
  out.bytes = 1024 + 96 * layer.steps.size();
  const auto set_retracted = [&](bool v, bool to_change) {
    (out.changes.empty() ? out.retracted : out.changes.back().retracted) = v;
    (out.changes.empty() ? out.to_change : out.changes.back().to_change) = to_change;
  };
  const auto lose_place = [&] {
    out.place_lost = true;
    out.at.reset(), out.wiped_to.reset();
  };
  const overloaded take{[&](const Extrude& bead) { take_in(out, bead, layer.z); },
                        [&](const Travel& travel) { take_in(out, travel, dialect.separate_travel_acceleration()); },
                        [&](const Retract& retract) {
                          take_in(out, retract, layer.z);
                          set_retracted(true, retract.to_change);
                        },
                        [&](const Prime&) { set_retracted(false, false); },
                        [&](const SetFan& fan) { out.fan = fan.share; },
                        [&](const SetPressureAdvance& advance) { out.pressure_advance_s = advance.seconds; },
                        [&](const ToolChange& change) {
                          out.pressure_advance_s.reset();
                          out.changes.push_back({change.tool, {}});
                          lose_place();
                        },
                        [&](const Feed& feed) {
                          if (!feed.moves) return;
                          out.extents.add({feed.to.x, feed.to.y, layer.z});
                          out.at = Point3{feed.to.x, feed.to.y, layer.z};
                          out.wiped_to.reset();
                        },
                        [&](const Pause& pause) {
                          out.bytes += pause.text.size();
                          out.pauses.push_back(pause);
                          lose_place();
                        },
                        LeavesAlone<ObjectStart, ObjectEnd, SetTemperature>{}};
  for (const auto& step : layer.steps) std::visit(take, step);
  if (layer.time.first()) out.hull = hull_of(layer);
  return out;
}

void advance(MachineState& state, const LayerDigest& layer) {
  if (layer.place_lost) state.at.reset(), state.z = MachineState::from_above;
  if (layer.at) state.at = layer.at;
  if (layer.wiped_to && state.at) state.at = Point3{layer.wiped_to->x, layer.wiped_to->y, state.at->z};
  if (layer.retracted) state.set_retracted(*layer.retracted, layer.to_change);
  for (const auto& change : layer.changes) {
    state.tool = change.tool;
    if (change.retracted) state.set_retracted(*change.retracted, change.to_change);
  }
  if (layer.retracted || !layer.changes.empty()) state.drawn_mm.reset();
  if (layer.fan) state.fan = *layer.fan;
  if (layer.pressure_advance_s || !layer.changes.empty()) state.pressure_advance_s = layer.pressure_advance_s;
  if (layer.print_acceleration > 0) state.print_acceleration = layer.print_acceleration;
  if (layer.travel_acceleration > 0) state.travel_acceleration = layer.travel_acceleration;
}

}  // namespace weft::gcode
