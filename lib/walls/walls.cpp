// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/walls.h"

#include "core/stop.h"
#include "model/flow.h"
#include "walls/finish.h"
#include "walls/kinds_of_parts.h"
#include "walls/outline.h"
#include "walls/part.h"
#include "walls/slopes.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

namespace weft::walls {
namespace {

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

/// Whatever evened out a part's volume: compensated beads have the flow that the settings allow.
void keep_flow(const WallSettings& settings, Beads& beads) {
  const auto least = static_cast<float>(settings.min_flow_ratio / 100),
             most = std::max(least, static_cast<float>(settings.max_flow_ratio / 100));
  for (Bead& bead : beads)
    for (Junction& j : bead.path)
      if (j.flow != 1.F) j.flow = std::clamp(j.flow, least, most);
}

/// The walls of a part whose outermost beads end where the settings say.
Part whole_part(const WallSettings& settings, Widths widths, const Region& region, const WallInput& input,
                std::uint32_t index) {
  const Within room = within(region, widths.bulge);
  Part out;
  const auto add = [&](const Regions& pieces) {
    for (const Region& piece : pieces) {
      Part part = part_of(settings, widths, piece, input.nozzle_diameter, index);
      std::move(part.beads.begin(), part.beads.end(), std::back_inserter(out.beads));
      std::move(part.inside.begin(), part.inside.end(), std::back_inserter(out.inside));
      out.dropped_mm += part.beads.empty() && part.inside.empty() ? perimeter_of(piece.outer) / 2000 : part.dropped_mm;
      out.valid = out.valid && part.valid;
    }
  };
  add(room.regions);
  if (widths.bulge > 0) widen_thin(widths.bulge, input.layer.height, out.beads);
  widths.least_feature += 2 * widths.bulge;
  add(room.thin);
  keep_flow(settings, out.beads);
  return out;
}

/// Planned so far apart that they overlap less, beads are as wide as before.
void spread_out(const WallSettings& settings, Um height, Beads& beads) {
  const Um by = flow::spread(height, settings.overlap_factor);
  if (by == 0) return;
  for (Bead& bead : beads)
    for (Junction& j : bead.path)
      if (j.width > height) j.width = std::max(j.width - by, rounded(height * (1 - flow::rounding)));
}

PlacedNotice notice_of(const char* code, const WallInput& input, const Region& region, const std::string& what) {
  return {code, fmt::format("layer {} (z {:.3f}): {}", input.index, to_mm(input.layer.z), what),
          box_of(region.outer).centre()};
}

/// A part too small for any bead. Specks are no news.
void add_left_out(const WallInput& input, const Region& region, std::vector<PlacedNotice>& out) {
  constexpr Um speck = 0.1_mm;
  const Point size = box_of(region.outer).size();
  if (std::max(size.x, size.y) < speck) return;
  out.push_back(notice_of("thin_feature_dropped", input, region,
                          fmt::format("a part of {:.3f} x {:.3f} mm is left out", to_mm(size.x), to_mm(size.y))));
}

}  // namespace

WallLayer build(const WallSettings& settings, const WallInput& input) {
  constexpr double worth_a_notice_mm = 0.5;  // the last bit of every tip is thinner than any bead
  WallLayer out;
  const Widths widths = widths_of(settings, input.nozzle_diameter, input.layer.height, input.index);
  const Um foot = input.settings_above != nullptr ? input.settings_above->xy_offset - settings.xy_offset : 0;
  const Regions regions =
      foot > 0 ? drawn_in(settings, input.layer.regions, foot, rounded(2 * widths.outer) + 2 * widths.bulge)
               : offset_outlines(settings, input.layer.regions);
  if (widths.walls == 0) {
    out.inside = regions;
    return out;
  }
  const auto extra =
      settings.wall_extra_on_slopes && input.above != nullptr
          ? extra_walls(
                widths, regions,
                offset_outlines(input.settings_above != nullptr ? *input.settings_above : settings, *input.above))
          : std::vector<int>(regions.size(), 0);
  KindsOfParts kinds;
  for (std::uint32_t i = 0; i < regions.size(); ++i) {
    stop_if_asked();
    auto again = extra[i] == 0 ? kinds.again(regions[i], i) : std::nullopt;
    Widths own = widths;
    own.walls += extra[i];
    Part part = again ? *std::move(again) : whole_part(settings, own, regions[i], input, i);
    if (!again && extra[i] == 0) kinds.add(regions[i], part);
    put_in_order(part.beads, settings.wall_order);
    if (!part.valid)
      out.notices.push_back(notice_of("walls_without_medial_axis", input, regions[i],
                                      "no medial axis of the outline; its walls are concentric and thin places stay "
                                      "empty"));
    if (part.dropped_mm > worth_a_notice_mm)
      out.notices.push_back(
          notice_of("thin_feature_dropped", input, regions[i],
                    fmt::format("{:.2f} mm of a part too thin for a bead of its own are left out", part.dropped_mm)));
    else if (part.beads.empty() && part.inside.empty())
      add_left_out(input, regions[i], out.notices);
    std::move(part.beads.begin(), part.beads.end(), std::back_inserter(out.beads));
    std::move(part.inside.begin(), part.inside.end(), std::back_inserter(out.inside));
  }
  if (input.over_air != nullptr) steady_over_air(*input.over_air, widths, out.beads);
  spread_out(settings, input.layer.height, out.beads);
  return out;
}

}  // namespace weft::walls
