// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/offset.h"

#include "core/stop.h"
#include "geometry/clipper_door.h"
#include "geometry/offset_curve.h"
#include "geometry/simplify.h"
#include "geometry/wound.h"

#include <optional>
#include <utility>

namespace weft::geometry {
namespace {

/// Curves that neither cross nor touch anything are outlines as they are, and those that cross cleanly are followed
/// from crossing to crossing: no sweep is needed.
std::optional<Regions> settled(const clipper::FineRings& curves, Point origin) {
  std::vector<Ring> rings;
  for (const auto& curve : curves) {
    rings.push_back(clipper::coarse(curve, origin));
    if (rings.back().empty()) rings.pop_back();
  }
  return wound(rings, WindingRule::positive, origin);
}
}  // namespace

Regions offset(const Regions& regions, const OffsetOptions& options) {
  const Box box = box_of(regions);
  if (box.empty()) return {};
  OffsetCurve curve(options, box.centre());
  clipper::FineRings curves;
  StopNowAndThen stop(64);
  const auto draw = [&](Ring ring) {
    stop.step();
    drop_collinear(ring);
    if (ring.size() >= 3) curves.push_back(curve.of(ring));
  };
  for (const auto& region : regions) {
    draw(region.outer);
    for (const auto& hole : region.holes) draw(hole);
  }
  if (auto done = settled(curves, box.centre())) return *std::move(done);
  return clipper::run(clipper::Operation::unite, WindingRule::positive, curves, {}, box.centre());
}

Regions opening(const Regions& regions, Um radius, Corner corner) {
  return offset(offset(regions, {.by = -radius, .corner = corner}), {.by = radius, .corner = corner});
}

Regions closing(const Regions& regions, Um radius, Corner corner) {
  return offset(offset(regions, {.by = radius, .corner = corner}), {.by = -radius, .corner = corner});
}

}  // namespace weft::geometry
