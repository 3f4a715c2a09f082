// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/walls.h"

#include "core/alike.h"
#include "core/stop.h"
#include "model/flow.h"
#include "walls/finish.h"
#include "walls/fuzzy.h"
#include "walls/one_wall.h"
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

/// Does a point lie in one of the regions? They are asked from left to right, as far as their boxes reach.
class InAnyOf {
 public:
  explicit InAnyOf(const Regions& regions) : box_(box_of(regions)) {
    boxed_.reserve(regions.size());
    for (const Region& region : regions) {
      boxed_.push_back({box_of(region.outer), &region});
      widest_ = std::max(widest_, boxed_.back().box.size().x);
    }
    std::sort(boxed_.begin(), boxed_.end(), [](const Boxed& a, const Boxed& b) { return a.box.min.x < b.box.min.x; });
  }
  bool never() const { return box_.empty(); }
  bool operator()(Point p) const {
    if (!box_.contains(p)) return false;
    auto at = std::lower_bound(boxed_.begin(), boxed_.end(), p.x - widest_,
                               [](const Boxed& boxed, Um x) { return boxed.box.min.x < x; });
    for (; at != boxed_.end() && at->box.min.x <= p.x; ++at)
      if (at->box.contains(p) && inside(*at->region, p)) return true;
    return false;
  }

 private:
  struct Boxed {
    Box box;
    const Region* region = nullptr;
  };
  std::vector<Boxed> boxed_;
  Box box_;
  Um widest_ = 0;
};

/// Over air there is nothing to press a bead against: it keeps the width the nozzle gives it.
void steady_over_air(const Regions& over_air, const Widths& widths, Beads& beads) {
  const InAnyOf over(over_air);
  if (over.never()) return;
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

/// The place of the outline that is nearest to the middle of its box: a part that winds does not lie there.
Point middle_of(const Ring& outline) {
  const Point centre = box_of(outline).centre();
  Point out = outline.front();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point a = outline[i], b = outline[(i + 1) % outline.size()];
    const Point along = b - a, to = centre - a;
    const double length2 = static_cast<double>(along.x) * along.x + static_cast<double>(along.y) * along.y;
    const double share = (static_cast<double>(along.x) * to.x + static_cast<double>(along.y) * to.y) / length2;
    const Point here = lerp(a, b, std::clamp(share, 0.0, 1.0));
    if (distance(here, centre) < distance(out, centre)) out = here;
  }
  return out;
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
      if (part.beads.empty() && part.inside.empty())
        out.left_out.add(perimeter_of(piece.outer) / 2000, middle_of(piece.outer));
      else
        out.left_out.add(part.left_out);
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

/// The same where top_one_wall asks what lies above.
Part part_seen(const WallSettings& settings, const Widths& widths, const Region& region, const WallInput& input,
               std::uint32_t index) {
  if (settings.top_one_wall != OneWall::top || input.above == nullptr || widths.walls < 2)
    return whole_part(settings, widths, region, input, index);
  Widths single = widths;
  single.walls = 1;
  Part part = whole_part(settings, single, region, input, index);
  const Regions seen = seen_from_above(widths, part.inside, *input.above);
  if (seen.empty()) return whole_part(settings, widths, region, input, index);
  add_covered_walls(settings, widths, seen, input.nozzle_diameter, index, part);
  keep_flow(settings, part.beads);
  return part;
}

/// Planned so far apart that they overlap less, beads are as wide as before.
void spread_out(const WallSettings& settings, Um height, Beads& beads) {
  const Um by = flow::spread(height, settings.overlap_factor);
  if (by == 0) return;
  for (Bead& bead : beads)
    for (Junction& j : bead.path)
      if (j.width > height) j.width = std::max(j.width - by, rounded(height * (1 - flow::rounding)));
}

/// Rough walls, above the first layer. Over air nothing holds what stands off.
void make_fuzzy(const WallSettings& settings, const WallInput& input, Beads& beads) {
  if (!settings.magic_fuzzy_skin_enabled || input.index == 0) return;
  const Regions nothing;
  const InAnyOf over(input.over_air != nullptr ? *input.over_air : nothing);
  for (std::size_t i = 0; i < beads.size(); ++i)
    if (beads[i].inset == 0 && beads[i].closed && (!settings.magic_fuzzy_skin_outside_only || runs_outside(beads[i])))
      roughen(settings, {input.index, i, input.layer.z, input.origin}, over, beads[i]);
}

/// Does all of the layer get a single wall?
bool single_wall(const WallSettings& settings, const WallInput& input) {
  return (settings.initial_layer_one_wall && input.index == 0) ||
         (settings.top_one_wall != OneWall::none && input.above == nullptr);
}

PlacedNotice notice_of(const char* code, const WallInput& input, Point at, const std::string& what) {
  return {code, fmt::format("layer {} (z {:.3f}): {}", input.index, to_mm(input.layer.z), what), at};
}

/// A part whose walls are those of the layer from there on.
struct Laid {
  std::size_t first_bead = 0, first_inside = 0;  ///< of it
  LeftOut left_out;
  bool valid = true;
};

/// What a part of the layer has got, moved to another place, where a part of that number is like it: a plate of pins
/// has one kind of them, and walls move with their region by whole microns.
Part moved(const WallLayer& walls, const std::vector<Laid>& laid, std::size_t like, Point by, std::uint32_t index) {
  const Laid &own = laid[like], &next = laid[like + 1];
  const auto from = [](const auto& all, std::size_t at) { return all.begin() + static_cast<std::ptrdiff_t>(at); };
  Part out;
  out.beads.assign(from(walls.beads, own.first_bead), from(walls.beads, next.first_bead));
  for (Bead& bead : out.beads) {
    bead.part = index;
    for (Junction& j : bead.path) j.at = j.at + by;
  }
  out.inside = weft::moved({from(walls.inside, own.first_inside), from(walls.inside, next.first_inside)}, by);
  out.left_out = own.left_out;
  out.left_out.at = out.left_out.at + by;
  out.valid = own.valid;
  return out;
}

/// What of a part is too thin or too small for any bead, where that is worth telling.
void tell_left_out(const WallInput& input, const Region& region, const Part& part, std::vector<PlacedNotice>& out) {
  constexpr double tips_mm = 0.5;  // the last bit of every tip is thinner than any bead
  constexpr Um speck = 0.1_mm;
  const Point size = box_of(region.outer).size();
  if (part.left_out.mm > tips_mm)
    out.push_back(
        notice_of("thin_feature_dropped", input, part.left_out.at,
                  fmt::format("{:.2f} mm of a part too thin for a bead of its own are left out", part.left_out.mm)));
  else if (part.beads.empty() && part.inside.empty() && std::max(size.x, size.y) >= speck)
    out.push_back(notice_of("thin_feature_dropped", input, middle_of(region.outer),
                            fmt::format("a part of {:.3f} x {:.3f} mm is left out", to_mm(size.x), to_mm(size.y))));
}

}  // namespace

bool moves_outlines(const WallSettings& settings, const WallSettings& above) {
  return settings.xy_offset != 0 || settings.hole_xy_offset != 0 || above.xy_offset > settings.xy_offset;
}

Regions outlines_of(const WallSettings& settings, const WallInput& input) {
  const Um foot = input.settings_above != nullptr ? input.settings_above->xy_offset - settings.xy_offset : 0;
  if (foot <= 0) return offset_outlines(settings, input.layer.regions);
  const Widths widths = widths_of(settings, input.nozzle_diameter, input.layer.height, input.index);
  return drawn_in(settings, input.layer.regions, foot, rounded(2 * widths.outer) + 2 * widths.bulge);
}

WallLayer build(const WallSettings& settings, const WallInput& input) {
  WallLayer out = lay(settings, input);
  finish(settings, input, out);
  return out;
}

WallLayer lay(const WallSettings& settings, const WallInput& input) {
  WallLayer out;
  Widths widths = widths_of(settings, input.nozzle_diameter, input.layer.height, input.index);
  if (widths.walls > 1 && single_wall(settings, input)) widths.walls = 1;
  const Regions regions = outlines_of(settings, input);
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
  const bool looks_up = settings.top_one_wall == OneWall::top && input.above != nullptr;  // parts alike differ in that
  const auto like = looks_up ? std::vector<std::size_t>{} : first_alike(regions);
  std::vector<Laid> laid;
  for (std::uint32_t i = 0; i < regions.size(); ++i) {
    stop_if_asked();
    Widths own = widths;
    own.walls += extra[i];
    const bool again = !looks_up && like[i] < i && extra[i] == extra[like[i]];
    laid.push_back({out.beads.size(), out.inside.size(), {}, true});
    Part part = again ? moved(out, laid, like[i], regions[i].outer.front() - regions[like[i]].outer.front(), i)
                      : part_seen(settings, own, regions[i], input, i);
    if (!again) put_in_order(part.beads, settings.wall_order);
    laid.back().left_out = part.left_out, laid.back().valid = part.valid;
    if (!part.valid)
      out.notices.push_back(notice_of("walls_without_medial_axis", input, box_of(regions[i].outer).centre(),
                                      "no medial axis of the outline; its walls are concentric and thin places stay "
                                      "empty"));
    tell_left_out(input, regions[i], part, out.notices);
    std::move(part.beads.begin(), part.beads.end(), std::back_inserter(out.beads));
    std::move(part.inside.begin(), part.inside.end(), std::back_inserter(out.inside));
  }
  return out;
}

void finish(const WallSettings& settings, const WallInput& input, WallLayer& laid) {
  if (input.over_air != nullptr)
    steady_over_air(*input.over_air, widths_of(settings, input.nozzle_diameter, input.layer.height, input.index),
                    laid.beads);
  spread_out(settings, input.layer.height, laid.beads);
  make_fuzzy(settings, input, laid.beads);
}

}  // namespace weft::walls
