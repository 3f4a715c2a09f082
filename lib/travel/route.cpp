// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stop.h"
#include "travel/bead_path.h"
#include "travel/blocks.h"
#include "travel/lift.h"
#include "travel/retraction_window.h"
#include "travel/scarf.h"
#include "travel/way.h"

#include <algorithm>
#include <utility>

namespace weft::travel {
namespace {

/// A bead that is about to be laid down, in the pieces it is printed in.
struct Held {
  std::vector<Extrude> pieces;
  std::vector<Junction> onward;  ///< where a closed bead's end leads on: over what was printed first
  bool closed_outer = false, closed_wall = false, scarf = false;

  bool empty() const { return pieces.empty(); }
  std::vector<Junction>& last() { return pieces.back().path; }
  Point begin() const { return pieces.front().path.front().at; }
  Point end() const { return pieces.back().path.back().at; }
  bool outer_wall() const { return pieces.front().role == Role::outer_wall; }
  Um drop() const { return pieces.front().below.empty() ? 0 : pieces.front().below.front(); }
};

double volume_mm3(const Extrude& bead) {
  double sum = 0;
  for (std::size_t i = 1; i < bead.path.size(); ++i)
    sum += distance(bead.path[i - 1].at, bead.path[i].at) / 1000.0 *
           mean_area_mm2(bead.path[i - 1], bead.path[i], to_mm(bead.height));
  return sum;
}

/// Writes the steps of a layer: each bead is held until it is known whether a retraction follows it.
class Writer {
 public:
  Writer(const TravelSettings& settings, const RetractionSettings& retraction, const Prepared& layer,
         std::optional<Point> from)
      : settings_(settings),
        retraction_(retraction),
        layer_(layer),
        router_(settings, retraction, layer),
        window_(retraction),
        at_(from) {
    plan_.z = layer.input.z, plan_.height = layer.input.height, plan_.time = layer.input.time;
    plan_.scope = layer.input.scope;
  }

  void print(const Turn& turn) {
    const Block& block = layer_.blocks[turn.block];
    Held next = held_of(beads_of(layer_.input, block)[turn.bead], turn, height_of(layer_.input, block));
    drop_ = next.drop();
    if (held_.empty()) {
      label(block.object);
      first_travel(next);
    } else {
      lay_down(next, block.object);
    }
    held_ = std::move(next);
    at_ = held_.end();
  }

  Routed finish() {
    if (!held_.empty()) {
      const Point counted_on = held_.begin();  // by the layer above, of a closed bead
      const bool scarf = held_.scarf;
      const Polyline gap = held_.closed_wall ? cut_end(held_.last(), gap_um()) : Polyline{};
      put_down();
      drop_ = 0;
      travel(gap);
      if (scarf) travel(router_.way(*at_, counted_on).points);
    }
    label(Block::adhesion);
    return {std::move(plan_), departures_};
  }

 private:
  Held held_of(const Bead& bead, const Turn& turn, Um height) const {
    Held held;
    auto path = path_of(bead, turn);
    held.closed_outer = bead.closed && bead.role == Role::outer_wall;
    held.closed_wall = held.closed_outer || (bead.closed && bead.role == Role::inner_wall);
    const Um loop = bead.closed ? rounded(1000 * length_mm(bead)) : 0;
    // On the bed a ramp would begin in it.
    held.scarf = (held.closed_outer || (held.closed_wall && settings_.scarf_joint_inner_walls)) &&
                 settings_.scarf_joint_seam_length > 0 && !layer_.input.time.first();
    if (held.scarf) {
      auto scarf = scarfed(settings_, path, height);
      held.pieces.push_back({std::move(scarf.ramp), bead.role, bead.tool, bead.scope, height, 0, {}});
      held.pieces.back().below = std::move(scarf.below);
      held.onward = scarf.body;
      if (scarf.body.size() > 1)
        held.pieces.push_back({std::move(scarf.body), bead.role, bead.tool, bead.scope, height, 0, {}});
      held.pieces.push_back({std::move(scarf.cover), bead.role, bead.tool, bead.scope, height, 0, {}});
    } else {
      if (bead.closed) held.onward = path;
      held.pieces.push_back({std::move(path), bead.role, bead.tool, bead.scope, height, 0, {}});
    }
    for (Extrude& piece : held.pieces) piece.loop_length = loop, piece.on_support = bead.on_support;
    return held;
  }

  void put_down() {
    for (auto& piece : held_.pieces) plan_.steps.push_back(std::move(piece));
    held_.pieces.clear();
  }

  /// Not more than a third of the bead goes to the gap; a slanting seam needs none.
  double gap_um() {
    if (held_.scarf) return 0;
    return std::min<double>(settings_.seam_gap_distance.of(layer_.input.nozzle), length_um(held_.last()) / 3);
  }

  void label(std::uint32_t object) {
    if (object == object_) return;
    if (object_ != Block::adhesion) plan_.steps.push_back(ObjectEnd{layer_.input.objects[object_].object});
    object_ = object;
    if (object_ != Block::adhesion) plan_.steps.push_back(ObjectStart{layer_.input.objects[object_].object});
  }

  void travel(const Polyline& way) {
    if (way.empty()) return;
    Travel travel;
    for (const Point p : way) travel.path.push_back({p.x, p.y, plan_.z});
    plan_.steps.push_back(std::move(travel));
    at_ = way.back();
  }

  bool lifts(const Way& way) const {
    return retraction_.retraction_hop > 0 && plan_.z >= retraction_.retraction_hop_above &&
           (!retraction_.retraction_hop_below || plan_.z <= *retraction_.retraction_hop_below) &&
           (!retraction_.retraction_hop_only_when_collides || way.crosses);
  }

  Point3 here() const { return {at_->x, at_->y, plan_.z}; }

  /// Whether filament may be drawn back once more.
  bool draws_back() { return retraction_.retraction_enable && window_.take(); }

  std::vector<Point3> lift(const Way& way) {
    auto lift = lifted(retraction_, *at_, way.points, plan_.z, layer_.input.room);
    if (lift.lowered) departures_.lowered.add(here());
    if (lift.type != retraction_.retraction_hop_type)
      (lift.type == HopType::slope ? departures_.sloped : departures_.vertical).add(here());
    return std::move(lift.path);
  }

  /// To the next bead, with the filament drawn back or not.
  void go(const Way& way, bool draw, Polyline wipe) {
    if (way.outside) departures_.outside.add(here());
    if (way.crosses && !draw && retraction_.retraction_enable) departures_.unretracted.add(here());
    if (draw) plan_.steps.push_back(Retract{std::move(wipe)});
    Travel travel;
    travel.crosses_wall = way.crosses;
    if (draw && at_ && lifts(way)) {
      travel.path = lift(way);
    } else {
      for (const Point p : way.points) travel.path.push_back({p.x, p.y, plan_.z});
    }
    if (travel.path.empty()) return;
    if (std::exchange(rise_, false) && flat(travel.path.front()) != *at_)
      travel.path.insert(travel.path.begin(), here());
    if (drop_ > 0) travel.path.push_back({travel.path.back().x, travel.path.back().y, plan_.z - drop_});
    plan_.steps.push_back(std::move(travel));
    if (draw) plan_.steps.push_back(Prime{});
  }

  void first_travel(const Held& next) {
    const Point begin = next.begin();
    // From where start G-code ends the nozzle comes full: without a retraction it strings over the bed.
    if (!at_) return go({{begin}, false, false, false}, draws_back(), {});
    if (begin == *at_) return;
    const Way way = router_.way(*at_, begin, next.outer_wall());
    rise_ = true;
    go(way, (way.retract || retraction_.retract_at_layer_change) && draws_back(), {});
  }

  /// The end of a bead that the pressure in the nozzle prints.
  Polyline coast() {
    auto& path = held_.last();
    if (!settings_.coasting_enable || path.size() < 2 || held_.scarf) return {};
    const auto& end = path.back();
    const double area_mm2 = to_mm(end.width) * to_mm(held_.pieces.back().height) * static_cast<double>(end.flow);
    const double coast_um = area_mm2 > 0 ? 1000 * settings_.coasting_volume / area_mm2 : 0;
    return coast_um * 3 > length_um(path) ? Polyline{} : cut_end(path, coast_um);
  }

  /// What the nozzle runs over while filament is drawn back: what was printed first, or back over what was last.
  Polyline wipe(const Polyline& gap) {
    if (!retraction_.wipe || retraction_.firmware_retraction) return {};
    if (held_.onward.empty()) {
      const std::vector<Junction> back(held_.last().rbegin(), held_.last().rend());
      return first_of(back, retraction_.wipe_distance);
    }
    Polyline over = first_of(held_.onward, retraction_.wipe_distance);
    if (!gap.empty()) over.insert(over.begin(), held_.onward.front().at);
    return over;
  }

  /// Puts the held bead down and goes to where the next one begins.
  void lay_down(const Held& next, std::uint32_t next_object) {
    const Point begin = next.begin();
    Way way = begin == *at_ ? Way{} : router_.way(*at_, begin, next.outer_wall());
    for (const auto& piece : held_.pieces) window_.feed(volume_mm3(piece) / layer_.input.filament_area_mm2);
    bool draw = way.retract && draws_back();
    const Polyline gap = held_.closed_wall ? cut_end(held_.last(), gap_um()) : Polyline{};
    if (!gap.empty()) at_ = held_.end();
    const Polyline coasted = draw ? coast() : Polyline{};
    Polyline over = draw ? wipe(gap) : Polyline{};
    const Polyline run_on =
        held_.closed_outer && over.empty() ? first_of(held_.onward, settings_.wall_0_wipe_dist) : Polyline{};
    put_down();
    travel(coasted);
    if (!run_on.empty() && !gap.empty()) travel(gap);
    travel(run_on);
    if (!over.empty()) at_ = over.back();
    label(next_object);
    if (begin == *at_) {
      if (!over.empty()) go({}, true, std::move(over));
      return;
    }
    if (!gap.empty() || !run_on.empty() || !over.empty()) {
      way = router_.way(*at_, begin, next.outer_wall());
      draw = draw || (way.retract && draws_back());
    }
    go(way, draw, std::move(over));
  }

  const TravelSettings& settings_;
  const RetractionSettings& retraction_;
  const Prepared& layer_;
  Router router_;
  RetractionWindow window_;
  LayerPlan plan_;
  Departures departures_;
  std::optional<Point> at_;
  Held held_;
  bool rise_ = false;  ///< the next travel begins on the layer below: it goes up before it goes anywhere
  Um drop_ = 0;        ///< how far below the layer's top the next bead begins
  std::uint32_t object_ = Block::adhesion;
};

}  // namespace

Routed route(const TravelSettings& settings, const RetractionSettings& retraction, const Prepared& layer,
             const Ordered& ordered, std::optional<Point> from) {
  Writer writer(settings, retraction, layer, from);
  StopNowAndThen stop(16);
  for (const auto& turn : ordered.turns) {
    stop.step();
    writer.print(turn);
  }
  return writer.finish();
}

std::vector<LayerPlan> plan(const TravelSettings& settings, const RetractionSettings& retraction,
                            std::vector<LayerInput> layers) {
  std::vector<Prepared> prepared;
  for (auto& layer : layers) prepared.push_back(prepare(settings, std::move(layer)));
  const auto linked = link(settings, prepared);
  std::vector<LayerPlan> plans;
  std::optional<Point> from;
  for (std::size_t i = 0; i < prepared.size(); ++i) {
    const auto ordered = order(settings, prepared[i], linked[i]);
    plans.push_back(route(settings, retraction, prepared[i], ordered, from).plan);
    if (ordered.end) from = ordered.end;
  }
  return plans;
}

}  // namespace weft::travel
