#include "geometry/clipper_door.h"

#include "core/tolerances.h"
#include "geometry/simplify.h"

#include <stdexcept>

#include <polyclipping/clipper.hpp>

namespace weft::geometry::clipper {
namespace {
using ClipperLib::cInt;

ClipperLib::ClipType type_of(Operation operation) {
  switch (operation) {
    case Operation::unite:
      return ClipperLib::ctUnion;
    case Operation::intersect:
      return ClipperLib::ctIntersection;
    case Operation::subtract:
      return ClipperLib::ctDifference;
    case Operation::exclusive_or:
      return ClipperLib::ctXor;
  }
  return ClipperLib::ctUnion;
}

ClipperLib::PolyFillType fill_of(WindingRule rule) {
  switch (rule) {
    case WindingRule::nonzero:
      return ClipperLib::pftNonZero;
    case WindingRule::positive:
      return ClipperLib::pftPositive;
    case WindingRule::even_odd:
      return ClipperLib::pftEvenOdd;
  }
  return ClipperLib::pftNonZero;
}

std::int64_t nearest_quotient(std::int64_t value, std::int64_t divisor) {
  const std::int64_t shifted = 2 * value + divisor;  // floor((2v + d) / 2d): the same step everywhere on the line
  const std::int64_t quotient = shifted / (2 * divisor);
  return shifted % (2 * divisor) < 0 ? quotient - 1 : quotient;
}

/// Whether anything was added: Clipper refuses rings without area, and fails when it has none at all.
bool add(ClipperLib::Clipper& sweep, const FineRings& rings, ClipperLib::PolyType type, std::int64_t coarser) {
  bool added = false;
  ClipperLib::Path path;
  for (const auto& ring : rings) {
    path.clear();
    for (const auto p : ring) path.emplace_back(nearest_quotient(p.x, coarser), nearest_quotient(p.y, coarser));
    added |= sweep.AddPath(path, type, true);
  }
  return added;
}

/// The contour on the lattice; empty when it is a sliver or the rounding turned it over.
Ring settled(const ClipperLib::Path& contour, std::int64_t coarser, Point origin, bool hole) {
  Ring ring;
  ring.reserve(contour.size());
  for (const auto& p : contour)
    ring.push_back(origin + Point{static_cast<Um>(nearest_quotient(p.X * coarser, steps)),
                                  static_cast<Um>(nearest_quotient(p.Y * coarser, steps))});
  drop_collinear(ring);
  const std::int64_t twice = hole ? -double_area(ring) : double_area(ring);
  if (static_cast<double>(twice) < 2 * tolerances::sliver_area_um2) ring.clear();
  return ring;
}

Regions regions_of(const ClipperLib::PolyTree& tree, std::int64_t coarser, Point origin) {
  Regions out;
  for (const auto* node = tree.GetFirst(); node != nullptr; node = node->GetNext()) {
    if (node->IsHole()) continue;
    Region region{settled(node->Contour, coarser, origin, false), {}};
    if (region.outer.empty()) continue;
    for (const auto* child : node->Childs) {
      Ring hole = settled(child->Contour, coarser, origin, true);
      if (!hole.empty()) region.holes.push_back(std::move(hole));
    }
    out.push_back(std::move(region));
  }
  return out;
}
}  // namespace

Regions run(Operation operation, WindingRule rule, const FineRings& subject, const FineRings& clip, Point origin) {
  // Clipper gives up when rounding contradicts its sweep order: very rare, and another grid has other roundings.
  for (const std::int64_t coarser : {1, 3, 16, 160}) {
    try {
      ClipperLib::Clipper sweep;
      const bool any_subject = add(sweep, subject, ClipperLib::ptSubject, coarser);
      const bool any_clip = add(sweep, clip, ClipperLib::ptClip, coarser);
      if (!any_subject && !any_clip) return {};
      ClipperLib::PolyTree tree;
      if (sweep.Execute(type_of(operation), tree, fill_of(rule), fill_of(rule)))
        return regions_of(tree, coarser, origin);
    } catch (const ClipperLib::clipperException&) {
    }
  }
  throw std::logic_error("geometry: a polygon Boolean failed on every grid");
}

}  // namespace weft::geometry::clipper
