#include "geometry/boolean.h"

#include "geometry/clipper_door.h"
#include "geometry/nesting.h"
#include "geometry/simplify.h"

#include <utility>

namespace weft::geometry {
namespace {
using clipper::FineRing;
using clipper::FineRings;
using clipper::Operation;

FineRing fine(const Ring& ring, Point origin) {
  FineRing out;
  out.reserve(ring.size());
  for (const Point p : ring)
    out.push_back({(std::int64_t{p.x} - origin.x) * clipper::steps, (std::int64_t{p.y} - origin.y) * clipper::steps});
  return out;
}

FineRings fine(const Regions& regions, Point origin) {
  FineRings out;
  for (const auto& region : regions) {
    out.push_back(fine(region.outer, origin));
    for (const auto& hole : region.holes) out.push_back(fine(hole, origin));
  }
  return out;
}

Regions run(Operation operation, const Regions& a, const Regions& b) {
  Box box = box_of(a);
  box.add(box_of(b));
  if (box.empty()) return {};
  const Point origin = box.centre();
  return clipper::run(operation, WindingRule::nonzero, fine(a, origin), fine(b, origin), origin);
}
}  // namespace

Regions regions_from_rings(std::span<const Ring> rings, WindingRule rule) {
  std::vector<Ring> clean;
  clean.reserve(rings.size());
  for (const auto& ring : rings) {
    clean.push_back(ring);
    drop_collinear(clean.back());
    if (clean.back().empty()) clean.pop_back();
  }
  if (auto regions = nested(clean, rule)) return *std::move(regions);
  Box box;
  for (const auto& ring : rings) box.add(box_of(ring));
  if (box.empty()) return {};
  FineRings subject;
  subject.reserve(rings.size());
  for (const auto& ring : rings) subject.push_back(fine(ring, box.centre()));
  return clipper::run(Operation::unite, rule, subject, {}, box.centre());
}

Regions unite(const Regions& regions) {
  return run(Operation::unite, regions, {});
}
Regions unite(const Regions& a, const Regions& b) {
  return run(Operation::unite, a, b);
}

Regions intersect(const Regions& a, const Regions& b) {
  if (!box_of(a).overlaps(box_of(b))) return {};
  return run(Operation::intersect, a, b);
}

Regions subtract(const Regions& from, const Regions& what) {
  return run(Operation::subtract, from, what);
}
Cut cut(const Regions& what, const Regions& by) {
  Box box = box_of(what);
  if (!box.overlaps(box_of(by))) return {{}, subtract(what, by)};
  box.add(box_of(by));
  const Point origin = box.centre();
  constexpr Operation both[] = {Operation::intersect, Operation::subtract};
  auto sides = clipper::run(both, WindingRule::nonzero, fine(what, origin), fine(by, origin), origin);
  return {std::move(sides[0]), std::move(sides[1])};
}
Regions exclusive_or(const Regions& a, const Regions& b) {
  return run(Operation::exclusive_or, a, b);
}

std::vector<Ring> rings_of(const Regions& regions) {
  std::vector<Ring> out;
  for (const auto& region : regions) {
    out.push_back(region.outer);
    out.insert(out.end(), region.holes.begin(), region.holes.end());
  }
  return out;
}

}  // namespace weft::geometry
