// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/boolean.h"

#include "core/stop.h"
#include "geometry/clipper_door.h"
#include "geometry/simplify.h"
#include "geometry/traced.h"
#include "geometry/wound.h"

#include <algorithm>
#include <iterator>
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

Box box_of(const Regions& a, const Regions& b) {
  Box box = weft::box_of(a);
  box.add(weft::box_of(b));
  return box;
}

/// What each operation leaves: outlines that cross cleanly are followed, others swept.
std::vector<Regions> run(std::span<const Operation> operations, const Regions& a, const Regions& b) {
  const Box box = box_of(a, b);
  if (box.empty()) return std::vector<Regions>(operations.size());
  const Point origin = box.centre();
  auto rings = traced(operations, a, b);
  if (!rings) return clipper::run(operations, WindingRule::nonzero, fine(a, origin), fine(b, origin), origin);
  std::vector<Regions> out;
  for (auto& of_one : *rings) out.push_back(clipper::tidied(std::move(of_one), origin));
  return out;
}

Regions run(Operation operation, const Regions& a, const Regions& b) {
  return std::move(run(std::span(&operation, 1), a, b).front());
}

void add(Regions& to, Regions more) {
  if (to.empty())
    to = std::move(more);
  else
    to.insert(to.end(), std::move_iterator(more.begin()), std::move_iterator(more.end()));
}

/// Each region of `what` counts for itself: calls f(some of them, what of `by` is near) until all are done, so that a
/// job may be stopped in between: one call into the library cannot be.
template <class F>
void by_batches(const Regions& what, const Regions& by, F f) {
  constexpr std::size_t batch = 512;
  static const Regions none;
  if (what.size() <= batch) {
    f(what, box_of(what).overlaps(box_of(by)) ? by : none);
    return;
  }
  std::vector<Box> boxes;
  for (const Region& region : by) boxes.push_back(box_of(region.outer));
  for (std::size_t first = 0; first < what.size(); first += batch) {
    stop_if_asked();
    const auto begin = what.begin() + static_cast<std::ptrdiff_t>(first);
    const Regions some(begin, begin + static_cast<std::ptrdiff_t>(std::min(batch, what.size() - first)));
    const Box box = box_of(some);
    Regions near;
    for (std::size_t i = 0; i < by.size(); ++i)
      if (boxes[i].overlaps(box)) near.push_back(by[i]);
    f(some, near);
  }
}

std::vector<Ring> clean(std::span<const Ring> rings) {
  std::vector<Ring> out;
  out.reserve(rings.size());
  for (const auto& ring : rings) {
    out.push_back(ring);
    drop_collinear(out.back());
    if (out.back().empty()) out.pop_back();
  }
  return out;
}
}  // namespace

Regions regions_from_rings(std::span<const Ring> rings, WindingRule rule, bool* met) {
  Box box;
  for (const auto& ring : rings) box.add(box_of(ring));
  if (box.empty()) return {};
  if (auto regions = wound(clean(rings), rule, box.centre())) return *std::move(regions);
  if (met != nullptr) *met = true;
  FineRings subject;
  subject.reserve(rings.size());
  for (const auto& ring : rings) subject.push_back(fine(ring, box.centre()));
  return clipper::run(Operation::unite, rule, subject, {}, box.centre());
}

Regions unite(const Regions& regions) {
  if (regions.size() > 1)
    if (auto united = wound(clean(rings_of(regions)), WindingRule::nonzero, weft::box_of(regions).centre()))
      return *std::move(united);
  return run(Operation::unite, regions, {});
}
Regions unite(const Regions& a, const Regions& b) {
  return run(Operation::unite, a, b);
}

Regions intersect(const Regions& a, const Regions& b) {
  Regions out;
  by_batches(a, b, [&](const Regions& some, const Regions& near) {
    if (!near.empty()) add(out, run(Operation::intersect, some, near));
  });
  return out;
}

Regions subtract(const Regions& from, const Regions& what) {
  Regions out;
  by_batches(from, what, [&](const Regions& some, const Regions& near) {
    if (some != near) add(out, run(Operation::subtract, some, near));  // as most layers of straight walls are
  });
  return out;
}
Cut cut(const Regions& what, const Regions& by) {
  constexpr Operation both[] = {Operation::intersect, Operation::subtract};
  Cut out;
  by_batches(what, by, [&](const Regions& some, const Regions& near) {
    if (near.empty()) return add(out.outside, run(Operation::subtract, some, {}));
    auto sides = run(both, some, near);
    add(out.inside, std::move(sides[0]));
    add(out.outside, std::move(sides[1]));
  });
  return out;
}
Regions exclusive_or(const Regions& a, const Regions& b) {
  const Box box = box_of(a, b);
  if (box.empty()) return {};
  const Point origin = box.centre();
  return clipper::run(Operation::exclusive_or, WindingRule::nonzero, fine(a, origin), fine(b, origin), origin);
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
