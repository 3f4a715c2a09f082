#include "model/flow.h"
#include "travel/blocks.h"
#include "travel/lift.h"
#include "travel/way.h"

#include <algorithm>

namespace weft::travel {
namespace {

Junction between(const Junction& a, const Junction& b, Point at) {
  const double whole = distance(a.at, b.at), t = whole > 0 ? std::min(1.0, distance(a.at, at) / whole) : 0.0;
  return {at, rounded(a.width + t * (static_cast<double>(b.width) - a.width)),
          a.flow + static_cast<float>(t) * (b.flow - a.flow)};
}

/// The bead's path in the order it is printed; a closed one ends where it began.
std::vector<Junction> path_of(const Bead& bead, const Turn& turn) {
  const std::size_t n = bead.path.size();
  if (!bead.closed) {
    if (turn.reversed) return {bead.path.rbegin(), bead.path.rend()};
    return bead.path;
  }
  std::vector<Junction> path;
  path.reserve(n + 2);
  const std::size_t i = turn.start.segment, next = (i + 1) % n;
  const bool at_junction = turn.start.at == bead.path[i].at;
  path.push_back(at_junction ? bead.path[i] : between(bead.path[i], bead.path[next], turn.start.at));
  for (std::size_t k = next; k != i; k = (k + 1) % n) path.push_back(bead.path[k]);
  if (!at_junction) path.push_back(bead.path[i]);
  path.push_back(path.front());
  return path;
}

/// The first `length_um` of the path, as the points after its first.
Polyline first_of(const std::vector<Junction>& path, double length_um) {
  Polyline line;
  for (std::size_t i = 1; i < path.size() && length_um > 0; ++i) {
    const double step = distance(path[i - 1].at, path[i].at);
    line.push_back(step <= length_um ? path[i].at : lerp(path[i - 1].at, path[i].at, length_um / step));
    length_um -= step;
  }
  return line;
}

/// Takes the last `length_um` off the path, as the points after its new last.
Polyline cut_end(std::vector<Junction>& path, double length_um) {
  Polyline tail;
  while (path.size() > 1 && length_um >= 1) {
    const Junction last = path.back(), before = path[path.size() - 2];
    const double step = distance(before.at, last.at);
    tail.insert(tail.begin(), last.at);
    if (step > length_um) {
      path.back() = between(before, last, lerp(last.at, before.at, length_um / step));
      break;
    }
    length_um -= step;
    path.pop_back();
  }
  return tail;
}

double length_um(const std::vector<Junction>& path) {
  double sum = 0;
  for (std::size_t i = 1; i < path.size(); ++i) sum += distance(path[i - 1].at, path[i].at);
  return sum;
}

/// Writes the steps of a layer: each bead is held until it is known whether a retraction follows it.
class Writer {
 public:
  Writer(const TravelSettings& settings, const RetractionSettings& retraction, const Prepared& layer,
         std::optional<Point> from)
      : settings_(settings), retraction_(retraction), layer_(layer), router_(settings, retraction, layer), at_(from) {
    plan_.z = layer.input.z, plan_.height = layer.input.height;
  }

  void print(const Turn& turn) {
    const Block& block = layer_.blocks[turn.block];
    const Bead& bead = beads_of(layer_.input, block)[turn.bead];
    Extrude next{path_of(bead, turn), bead.role, layer_.input.height, 0, {}};
    const Point begin = next.path.front().at;
    if (held_.path.empty()) {
      label(block.object);
      first_travel(begin);
    } else {
      lay_down(begin, block.object);
    }
    held_ = std::move(next);
    at_ = held_.path.back().at;
    closed_outer_ = bead.closed && bead.role == Role::outer_wall;
  }

  LayerPlan finish() {
    if (!held_.path.empty()) {
      const Polyline gap = closed_outer_ ? cut_end(held_.path, gap_um()) : Polyline{};
      plan_.steps.push_back(std::move(held_));
      travel(gap);  // the layer above counts on the bead's end
    }
    label(Block::adhesion);
    return std::move(plan_);
  }

 private:
  /// Not more than a third of the bead goes to the gap.
  double gap_um() const { return std::min<double>(settings_.seam_gap_distance, length_um(held_.path) / 3); }

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

  void retracted(const Way& way, Polyline wipe) {
    plan_.steps.push_back(Retract{std::move(wipe)});
    Travel travel;
    travel.crosses_wall = way.crosses;
    if (lifts(way)) {
      travel.path = lifted(retraction_, *at_, way.points, plan_.z, layer_.input.reach);
    } else {
      for (const Point p : way.points) travel.path.push_back({p.x, p.y, plan_.z});
    }
    plan_.steps.push_back(std::move(travel));
    plan_.steps.push_back(Prime{});
  }

  void first_travel(Point begin) {
    Way way = at_ ? router_.way(*at_, begin) : Way{{begin}, false, false};
    if (at_ && retraction_.retraction_enable && (way.retract || retraction_.retract_at_layer_change)) {
      retracted(way, {});
    } else {
      travel(way.points);
      if (!plan_.steps.empty())
        if (auto* t = std::get_if<Travel>(&plan_.steps.back())) t->crosses_wall = way.crosses;
    }
  }

  /// The end of a bead that the pressure in the nozzle prints.
  Polyline coast() {
    if (!settings_.coasting_enable || held_.path.size() < 2) return {};
    const auto& last = held_.path.back();
    const double area_mm2 = to_mm(last.width) * to_mm(held_.height) * static_cast<double>(last.flow);
    const double coast_um = area_mm2 > 0 ? 1000 * settings_.coasting_volume / area_mm2 : 0;
    return coast_um * 3 > length_um(held_.path) ? Polyline{} : cut_end(held_.path, coast_um);
  }

  /// Puts the held bead down and goes to where the next one begins.
  void lay_down(Point begin, std::uint32_t next_object) {
    Way way = begin == *at_ ? Way{} : router_.way(*at_, begin);
    const bool retract = way.retract && retraction_.retraction_enable;
    const bool closed = held_.path.front().at == held_.path.back().at;
    const Polyline gap = closed_outer_ ? cut_end(held_.path, gap_um()) : Polyline{};
    if (!gap.empty()) at_ = held_.path.back().at;
    Polyline coasted = retract ? coast() : Polyline{};
    Polyline wipe;
    if (retract && retraction_.wipe && !retraction_.firmware_retraction) {
      std::vector<Junction> back(held_.path.rbegin(), held_.path.rend());
      wipe = first_of(closed ? held_.path : back, retraction_.wipe_distance);
      if (closed && !gap.empty()) wipe.insert(wipe.begin(), held_.path.front().at);
    }
    const Polyline run_on =
        closed_outer_ && wipe.empty() ? first_of(held_.path, settings_.wall_0_wipe_dist) : Polyline{};
    plan_.steps.push_back(std::move(held_));
    travel(coasted);
    if (!run_on.empty() && !gap.empty()) travel(gap);
    travel(run_on);
    if (!wipe.empty()) at_ = wipe.back();
    label(next_object);
    if (begin == *at_) return;
    if (!gap.empty() || !run_on.empty() || !wipe.empty()) {
      const bool must = way.retract;
      way = router_.way(*at_, begin);
      way.retract = way.retract || must;
    }
    if (way.retract && retraction_.retraction_enable) {
      retracted(way, std::move(wipe));
    } else {
      const auto before = plan_.steps.size();
      travel(way.points);
      if (plan_.steps.size() > before) std::get<Travel>(plan_.steps.back()).crosses_wall = way.crosses;
    }
  }

  const TravelSettings& settings_;
  const RetractionSettings& retraction_;
  const Prepared& layer_;
  Router router_;
  LayerPlan plan_;
  std::optional<Point> at_;
  Extrude held_;
  bool closed_outer_ = false;
  std::uint32_t object_ = Block::adhesion;
};

}  // namespace

LayerPlan route(const TravelSettings& settings, const RetractionSettings& retraction, const Prepared& layer,
                const Ordered& ordered, std::optional<Point> from) {
  Writer writer(settings, retraction, layer, from);
  for (const auto& turn : ordered.turns) writer.print(turn);
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
    plans.push_back(route(settings, retraction, prepared[i], ordered, from));
    if (ordered.end) from = ordered.end;
  }
  return plans;
}

}  // namespace weft::travel
