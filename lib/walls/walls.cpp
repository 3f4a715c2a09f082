#include "walls/walls.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/medial_axis.h"
#include "geometry/offset.h"
#include "model/flow.h"
#include "walls/finish.h"
#include "walls/fit_ends.h"
#include "walls/keep_inside.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <iterator>
#include <new>
#include <numbers>
#include <optional>

#include <fmt/format.h>

namespace weft::walls {
namespace {

constexpr double corner_deg = 45;      // walls are led into the tip of a sharper corner
constexpr Um single_gain = 4;          // so much a single bead may gain: it has the outline on both sides
constexpr double dab_share = 2.0 / 3;  // of the square of a bead's width: a smaller part is a dab
constexpr double chord_um = 4;         // how far a chord may stand off a bead that bends around a corner

void add_rings(const Regions& at, Um width, std::uint16_t inset, std::uint32_t part, Beads& out) {
  auto add = [&](const Ring& ring) {
    if (ring.size() < 3) return;
    Bead bead;
    bead.role = inset == 0 ? Role::outer_wall : Role::inner_wall;
    bead.closed = true;
    bead.inset = inset;
    bead.part = part;
    for (const Point p : ring) bead.path.push_back({p, width});
    out.push_back(std::move(bead));
  };
  for (const Region& region : at) {
    add(region.outer);
    for (const Ring& hole : region.holes) add(hole);
  }
}

/// Concentric walls of nominal width: when there is no medial axis to go by.
Regions plain(const Widths& widths, const Regions& whole, std::uint32_t part, Beads& out) {
  Um edge = 0;
  for (int i = 0; i < widths.walls; ++i) {
    const Um width = rounded(i == 0 ? widths.outer : widths.inner);
    const Regions at = geometry::offset(whole, {.by = -(edge + width / 2)});
    if (at.empty()) break;
    add_rings(at, width, static_cast<std::uint16_t>(i), part, out);
    edge += width;
  }
  return edge == 0 ? whole : geometry::offset(whole, {.by = -edge});
}

Regions rest_of(const Skeleton& skeleton, const Laying& laying, Point origin) {
  std::vector<Ring> rings;
  for (const auto& places : trace_rest(skeleton, laying)) {
    Ring ring;
    for (const Place p : places) {
      const Point q{origin.x + rounded(p.x), origin.y + rounded(p.y)};
      if (ring.empty() || ring.back() != q) ring.push_back(q);
    }
    if (ring.size() >= 3) rings.push_back(std::move(ring));
  }
  return rings.empty() ? Regions{} : geometry::regions_from_rings(rings);
}

struct Part {
  Beads beads;
  Regions inside;
  double dropped_mm = 0;
  bool valid = true;
};

/// What turns, tips and branches lay too much or too little is taken from all beads of the part: its volume is right.
/// `single_wider`: so much wider a single bead may get, µm, which has the outline on both sides.
void keep_volume(const Region& region, Um widest, Um single_wider, Part& part) {
  constexpr double most = 0.05;  // beyond, something was left out on purpose
  // So much stays where it is. Walls side by side are worth more when even; a bead alone has none beside it.
  const auto single = [](const Bead& bead) { return bead.inset == 0 && !bead.closed; };
  const bool alone = std::all_of(part.beads.begin(), part.beads.end(), single);
  const double tolerated = alone ? 0.002 : 0.003;
  const double wanted = area_mm2(region) - area_mm2(part.inside);
  std::vector<Um> widest_of;                 // each junction, once any is to be wider
  for (int round = 0; round < 4; ++round) {  // again, for beads that are as wide as they may be do not take their share
    double laid = 0;
    for (const Bead& bead : part.beads) laid += volume_mm3(bead, 1_mm);
    if (laid <= 0 || std::abs(wanted / laid - 1) <= tolerated) return;
    const double ratio = wanted / laid;
    const double scale = std::clamp(ratio > 1 ? ratio - tolerated : ratio + tolerated, 1 - most, 1 + most);
    if (widest_of.empty())
      for (const Bead& bead : part.beads)
        for (const Junction& j : bead.path)
          widest_of.push_back(single(bead) ? std::min(widest, j.width + single_wider) : widest);
    std::size_t i = 0;
    for (Bead& bead : part.beads)
      for (Junction& j : bead.path) {
        const Um widest_here = widest_of[i++];
        if (j.flow < 1.F)
          j.flow = std::min(1.F, static_cast<float>(j.flow * scale));
        else
          j.width = std::min(widest_here, rounded(j.width * scale));
      }
  }
}

/// Not valid, too, when the library underneath gives up: concentric walls are better than no part.
geometry::MedialAxis axis_of(const Region& region) {
  try {
    return geometry::medial_axis(region);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    return {};
  }
}

Part build_part(const WallSettings& settings, const Widths& widths, const Region& region, Um nozzle,
                std::uint32_t index) {
  Part out;
  const auto axis = axis_of(region);
  if (!axis.valid) {
    out.valid = false;
    out.inside = plain(widths, {region}, index, out.beads);
    return out;
  }
  Skeleton skeleton = skeleton_of(axis, chord_um);
  LayingOptions options;
  options.steep = std::sin(settings.wall_transition_angle / 2 * std::numbers::pi / 180);
  options.corner = std::max(options.steep, std::sin(corner_deg / 2 * std::numbers::pi / 180));
  options.ramp = settings.wall_transition_length.of(nozzle);
  options.filter = settings.wall_transition_filter_distance;
  const Laying laying = lay(skeleton, widths, options);
  FinishOptions finishing;
  finishing.origin = axis.origin;
  finishing.part = index;
  finishing.least_feature = 0.8 * widths.least_feature;  // what is thinner was not laid; widths may give a little
  finishing.least_length = settings.min_wall_length;
  finishing.compensate = settings.flow_compensation;
  finishing.stable_outer = std::max<double>(settings.min_output_width, widths.outer / 4);
  finishing.stable_inner = std::max<double>(settings.min_output_width, widths.inner / 4);
  finishing.most_width = widths.most;
  // So small a part gets an even bead: what pieces of it would gain they would swell over each other.
  const bool dab = 1e6 * area_mm2(region) < dab_share * widths.outer * widths.outer;
  if (dab) finishing.even_taper = 1e9;
  finishing.least_flow = settings.min_flow_ratio / 100;
  finishing.most_flow = settings.max_flow_ratio / 100;
  auto pairs = trace_pairs(skeleton, laying), middles = trace_middles(skeleton, laying);
  fit_ends(middles, pairs);
  std::vector<Line> finished;
  for (auto* lines : {&pairs, &middles})
    for (Line& line : *lines) {
      stop_if_asked();
      finish(std::move(line), finishing, finished, out.dropped_mm);
    }
  out.inside = rest_of(skeleton, laying, axis.origin);
  if (!dab) keep_inside(region, finishing, finished);
  for (const Line& line : finished) append_bead(line, finishing, out.beads);
  keep_volume(region, rounded(widths.most), dab ? rounded(widths.outer) : single_gain, out);
  return out;
}

/// The regions with their outlines moved by the xy offsets.
Regions offset_outlines(const WallSettings& settings, const Regions& regions, std::size_t layer) {
  const Um by = settings.xy_offset + (layer == 0 ? settings.xy_offset_layer_0 : 0);
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

/// The last parts of a layer that differed by more than their place: a plate of pins has one kind of them, and walls
/// move with their region by whole microns.
class KindsOfParts {
 public:
  /// What `region`, the part of that number, gets if one of them is like it.
  std::optional<Part> again(const Region& region, std::uint32_t part) const {
    for (const Kind& kind : kinds_) {
      if (!alike(*kind.region, region)) continue;
      const Point by = region.outer.front() - kind.region->outer.front();
      Part out = kind.made;
      for (Bead& bead : out.beads) {
        bead.part = part;
        for (Junction& j : bead.path) j.at = j.at + by;
      }
      out.inside = moved(std::move(out.inside), by);
      return out;
    }
    return {};
  }
  /// Remembers a part, unless it is large. `region` must stay where it is.
  void add(const Region& region, const Part& made) {
    if (region.outer.size() > most_corners || !region.holes.empty()) return;
    if (kinds_.size() < most_kinds) kinds_.emplace_back();
    kinds_[next_++ % most_kinds] = {&region, made};
  }

 private:
  struct Kind {
    const Region* region = nullptr;
    Part made;
  };
  static constexpr std::size_t most_kinds = 8;
  static constexpr std::size_t most_corners = 200;  // a copy of what is larger would take memory

  static bool alike(const Region& a, const Region& b) {
    if (a.outer.size() != b.outer.size() || !b.holes.empty()) return false;
    const Point by = b.outer.front() - a.outer.front();
    return std::equal(a.outer.begin(), a.outer.end(), b.outer.begin(), [&](Point p, Point q) { return p + by == q; });
  }

  std::vector<Kind> kinds_;
  std::size_t next_ = 0;
};

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
  const Regions regions = offset_outlines(settings, input.layer.regions, input.index);
  if (widths.walls == 0) {
    out.inside = regions;
    return out;
  }
  KindsOfParts kinds;
  for (std::uint32_t i = 0; i < regions.size(); ++i) {
    stop_if_asked();
    auto again = kinds.again(regions[i], i);
    Part part = again ? *std::move(again) : build_part(settings, widths, regions[i], input.nozzle_diameter, i);
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
