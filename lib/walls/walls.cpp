#include "walls/walls.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "walls/finish.h"
#include "walls/kinds_of_parts.h"
#include "walls/part.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

namespace weft::walls {
namespace {

/// The regions with their outlines moved by the xy offsets.
Regions offset_outlines(const WallSettings& settings, const Regions& regions) {
  const Um by = settings.xy_offset;
  const Um holes_by = settings.hole_xy_offset - by;
  if (by == 0 && holes_by == 0) return regions;
  Regions solid, holes;
  for (const Region& region : regions) {
    solid.push_back({region.outer, {}});
    for (const Ring& hole : region.holes) holes.push_back({Ring(hole.rbegin(), hole.rend()), {}});
  }
  if (by != 0) solid = geometry::offset(solid, {.by = by});
  if (holes_by != 0) holes = geometry::offset(holes, {.by = holes_by});
  return geometry::subtract(solid, holes);
}

bool inside(const Region& region, Point p) {
  return side_of(region.outer, p) == Side::inside &&
         std::none_of(region.holes.begin(), region.holes.end(),
                      [&](const Ring& hole) { return side_of(hole, p) == Side::inside; });
}

/// Over air there is nothing to press a bead against: it keeps the width the nozzle gives it.
void steady_over_air(const Regions& over_air, const Widths& widths, Beads& beads) {
  const Box box = box_of(over_air);
  if (box.empty()) return;
  std::vector<Box> boxes;
  boxes.reserve(over_air.size());
  for (const Region& region : over_air) boxes.push_back(box_of(region.outer));
  const auto over = [&](Point p) {
    if (!box.contains(p)) return false;
    for (std::size_t i = 0; i < boxes.size(); ++i)
      if (boxes[i].contains(p) && inside(over_air[i], p)) return true;
    return false;
  };
  for (Bead& bead : beads)
    for (Junction& j : bead.path)
      if (j.flow == 1.F && over(j.at)) j.width = rounded(bead.inset == 0 ? widths.outer : widths.inner);
}

std::string place_of(const WallInput& input, const Region& region) {
  const Point at = box_of(region.outer).centre();
  return fmt::format("layer {} (z {:.3f}), around {:.2f}, {:.2f}", input.index, to_mm(input.layer.z), to_mm(at.x),
                     to_mm(at.y));
}

/// A part too small for any bead. Specks are no news.
void add_left_out(const WallInput& input, const Region& region, Notices& out) {
  constexpr Um speck = 0.1_mm;
  const Point size = box_of(region.outer).size();
  if (std::max(size.x, size.y) < speck) return;
  out.push_back({"thin_feature_dropped", fmt::format("{}: a part of {:.3f} x {:.3f} mm is left out",
                                                     place_of(input, region), to_mm(size.x), to_mm(size.y))});
}

}  // namespace

WallLayer build(const WallSettings& settings, const WallInput& input) {
  constexpr double worth_a_notice_mm = 0.5;  // the last bit of every tip is thinner than any bead
  WallLayer out;
  const Widths widths = widths_of(settings, input.nozzle_diameter, input.layer.height, input.index);
  const Regions regions = offset_outlines(settings, input.layer.regions);
  if (widths.walls == 0) {
    out.inside = regions;
    return out;
  }
  KindsOfParts kinds;
  for (std::uint32_t i = 0; i < regions.size(); ++i) {
    stop_if_asked();
    auto again = kinds.again(regions[i], i);
    Part part = again ? *std::move(again) : part_of(settings, widths, regions[i], input.nozzle_diameter, i);
    if (!again) kinds.add(regions[i], part);
    put_in_order(part.beads, settings.wall_order);
    if (!part.valid)
      out.notices.push_back(
          {"walls_without_medial_axis",
           place_of(input, regions[i]) +
               ": no medial axis of the outline; its walls are concentric and thin places stay empty"});
    if (part.dropped_mm > worth_a_notice_mm)
      out.notices.push_back(
          {"thin_feature_dropped",
           fmt::format("{}: {:.2f} mm of a part thinner than {:.3f} mm are left out", place_of(input, regions[i]),
                       part.dropped_mm, to_mm(settings.min_feature_size))});
    else if (part.beads.empty() && part.inside.empty())
      add_left_out(input, regions[i], out.notices);
    std::move(part.beads.begin(), part.beads.end(), std::back_inserter(out.beads));
    std::move(part.inside.begin(), part.inside.end(), std::back_inserter(out.inside));
  }
  if (input.over_air != nullptr) steady_over_air(*input.over_air, widths, out.beads);
  return out;
}

}  // namespace weft::walls
