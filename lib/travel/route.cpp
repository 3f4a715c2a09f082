#include "travel/blocks.h"

#include <algorithm>

namespace weft::travel {
namespace {

/// How far from the comb boundary a bead may end and still be reached from it without a retraction, µm.
constexpr Um reach_um = 2500;

Junction between(const Junction& a, const Junction& b, Point at) {
  const double whole = distance(a.at, b.at), t = whole > 0 ? std::min(1.0, distance(a.at, at) / whole) : 0.0;
  return {at, rounded(a.width + t * (static_cast<double>(b.width) - a.width)),
          a.flow + static_cast<float>(t) * (b.flow - a.flow)};
}

/// The bead's path in the order it is printed; a closed one ends where it began.
std::vector<Junction> path_of(const Bead& bead, const Turn& turn) {
  std::vector<Junction> path;
  const std::size_t n = bead.path.size();
  path.reserve(n + 2);
  if (!bead.closed) {
    if (turn.reversed)
      path.assign(bead.path.rbegin(), bead.path.rend());
    else
      path = bead.path;
    return path;
  }
  const std::size_t i = turn.start.segment, next = (i + 1) % n;
  const bool at_junction = turn.start.at == bead.path[i].at;
  path.push_back(at_junction ? bead.path[i] : between(bead.path[i], bead.path[next], turn.start.at));
  for (std::size_t k = next; k != i; k = (k + 1) % n) path.push_back(bead.path[k]);
  if (!at_junction) path.push_back(bead.path[i]);
  path.push_back(path.front());
  return path;
}

double length_from(Point p, const Polyline& way) {
  double sum = 0;
  for (const Point q : way) sum += distance(p, q), p = q;
  return sum;
}

struct Way {
  Polyline points;  ///< after the first
  bool retract = false, crosses = false;
};

/// Ways between beads of one layer.
class Router {
 public:
  Router(const TravelSettings& settings, const RetractionSettings& retraction, const Prepared& layer)
      : settings_(settings), retraction_(retraction), comb_(layer.comb), outline_(layer.outline) {}

  Way way(Point p, Point q) const {
    if (auto combed = combed_way(p, q)) {
      const double length = length_from(p, *combed);
      const bool far = settings_.retraction_combing_max_distance && length > *settings_.retraction_combing_max_distance;
      const bool strict = !retraction_.retract_only_when_crossing && length >= retraction_.retraction_min_travel;
      // A boundary moved outwards may lead out of the part.
      const bool crosses = settings_.retraction_combing_offset > 0 && leaves_outline(p, *combed);
      return {std::move(*combed), far || strict || crosses, crosses};
    }
    const bool crosses = leaves_outline(p, {q});
    return {{q}, crosses || distance(p, q) >= retraction_.retraction_min_travel, crosses};
  }

 private:
  bool leaves_outline(Point p, const Polyline& way) const {
    bool inside = outline_.part_of(p) != Comb::outside;
    for (const Point q : way) {
      if (!outline_.sees(p, q)) return true;
      p = q;
    }
    return inside != (outline_.part_of(p) != Comb::outside);
  }

  /// The point of the comb area from which p is reached inside the part.
  std::optional<Point> gate(Point p) const {
    if (comb_.part_of(p) != Comb::outside) return p;
    const auto gate = comb_.nearest_on_boundary(p, reach_um);
    if (!gate || outline_.part_of(p) == Comb::outside || !outline_.sees(p, *gate)) return std::nullopt;
    return gate;
  }

  std::optional<Polyline> combed_way(Point p, Point q) const {
    if (comb_.empty()) return std::nullopt;
    const auto from = gate(p), to = gate(q);
    if (!from || !to) return std::nullopt;
    const double to_gates = distance(p, *from) + distance(*to, q);
    if (to_gates > 0 && distance(p, q) <= to_gates && outline_.sees(p, q)) return Polyline{q};
    const std::uint32_t part = comb_.part_of(*from);
    if (part == Comb::outside || part != comb_.part_of(*to)) return std::nullopt;
    auto inside = comb_.way(*from, *to);
    if (!inside) return std::nullopt;
    if (*from != p) inside->insert(inside->begin(), *from);
    if (*to != q) inside->push_back(q);
    return inside;
  }

  const TravelSettings& settings_;
  const RetractionSettings& retraction_;
  const Comb& comb_;
  const Comb& outline_;
};

}  // namespace

LayerPlan route(const TravelSettings& settings, const RetractionSettings& retraction, const Prepared& layer,
                const Ordered& ordered, std::optional<Point> from) {
  LayerPlan plan{layer.input.z, layer.input.height, {}};
  const Router router(settings, retraction, layer);
  constexpr std::uint32_t nothing = Block::adhesion;
  std::uint32_t object = nothing;
  bool new_layer = true;
  for (const auto& turn : ordered.turns) {
    const Block& block = layer.blocks[turn.block];
    const Bead& bead = beads_of(layer.input, block)[turn.bead];
    Extrude extrude{path_of(bead, turn), bead.role, layer.input.height, 0, {}};
    const Point begin = extrude.path.front().at;
    if (block.object != object) {
      if (object != nothing) plan.steps.push_back(ObjectEnd{layer.input.objects[object].object});
      object = block.object;
      if (object != nothing) plan.steps.push_back(ObjectStart{layer.input.objects[object].object});
    }
    if (new_layer || begin != *from) {
      Way way = from ? router.way(*from, begin) : Way{{begin}, false, false};
      if (new_layer && from && retraction.retract_at_layer_change) way.retract = true;
      const bool retract = way.retract && retraction.retraction_enable;
      Travel travel;
      travel.crosses_wall = way.crosses;
      for (const Point p : way.points) travel.path.push_back({p.x, p.y, layer.input.z});
      if (retract) plan.steps.push_back(Retract{});
      plan.steps.push_back(std::move(travel));
      if (retract) plan.steps.push_back(Prime{});
    }
    new_layer = false;
    from = extrude.path.back().at;
    plan.steps.push_back(std::move(extrude));
  }
  if (object != nothing) plan.steps.push_back(ObjectEnd{layer.input.objects[object].object});
  return plan;
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
