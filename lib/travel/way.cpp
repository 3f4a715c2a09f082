#include "travel/way.h"

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

Way Router::way(Point p, Point q) const {
  if (auto inside = combed(p, q)) {
    const double length = length_from(p, *inside);
    const bool far = settings_.retraction_combing_max_distance && length > *settings_.retraction_combing_max_distance;
    const bool strict = !retraction_.retract_only_when_crossing && length >= retraction_.retraction_min_travel;
    // Checked all the same: the boundary may be moved outwards, and an outer wall may leave the outline where it is thin.
    const bool crosses = leaves_outline(p, *inside);
    return {std::move(*inside), far || strict || crosses, crosses};
  }
  const bool crosses = leaves_outline(p, {q});
  return {{q}, crosses || distance(p, q) >= retraction_.retraction_min_travel, crosses};
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
std::optional<Point> Router::gate(Point p) const {
  if (comb_.part_of(p) != Comb::outside) return p;
  const auto gate = comb_.nearest_on_boundary(p, reach_um);
  if (!gate || outline_.part_of(p) == Comb::outside || !outline_.sees(p, *gate)) return std::nullopt;
  return gate;
}

std::optional<Polyline> Router::combed(Point p, Point q) const {
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

}  // namespace weft::travel
